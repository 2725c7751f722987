// Finds the known word that a misspelt one probably stands for.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace albtpu::formats {

// The number of edits that turn `a` into `b`: a character inserted, deleted or replaced, or two neighbours swapped
// (the optimal string alignment distance, which edits no substring twice).
std::size_t EditDistance(std::string_view a, std::string_view b);

// The candidate nearest to `word`, the first of several that are equally near. None if even the nearest takes more than
// two edits for every five characters of the longer word, or more than three in all.
std::optional<std::string> NearMatch(std::string_view word, const std::vector<std::string>& candidates);

// "; did you mean X?" if X is a near match, otherwise "; " and `otherwise`.
std::string Suggestion(std::string_view word, const std::vector<std::string>& candidates,
                       std::string_view otherwise);

}  // namespace albtpu::formats
