#include "programs/command_line/checks.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <optional>
#include <system_error>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "formats/text/near_match.h"

namespace albtpu::programs {

CLI::Validator NotEmpty(const std::string& what) {
  return CLI::Validator(
      [what](const std::string& text) { return text.empty() ? "is empty; name a " + what : std::string(); },
      "");
}

CLI::Validator WholeIn(long long least, long long most) {
  return CLI::Validator(
      [least, most](const std::string& text) -> std::string {
        long long number = 0;
        const char* last = text.data() + text.size();
        const auto [end, error] = std::from_chars(text.data(), last, number);
        if (error == std::errc() && end == last && number >= least && number <= most) return {};
        return absl::StrCat("'", text, "' is not a number in the range; give a whole number from ", least,
                            " to ", most);
      },
      "");
}

CLI::Validator NumberIn(double least, double most, const std::string& unit) {
  return CLI::Validator(
      [least, most, unit](const std::string& text) -> std::string {
        double number = 0;
        if (absl::SimpleAtod(text, &number) && number >= least && number <= most) return {};
        return absl::StrCat("'", text, "' is not a number in the range; give one from ", least, " to ", most,
                            " ", unit);
      },
      "");
}

CLI::Validator OneOf(const std::vector<std::string>& words) {
  return CLI::Validator(
      [words](const std::string& text) -> std::string {
        if (std::find(words.begin(), words.end(), text) != words.end()) return {};
        const std::string choices = absl::StrJoin(words, ", ");
        const std::optional<std::string> near = formats::NearMatch(text, words);
        return near ? absl::StrCat("'", text, "' is unknown (there are ", choices, "); did you mean ", *near,
                                   "?")
                    : absl::StrCat("'", text, "' is unknown; give one of ", choices);
      },
      "");
}

}  // namespace albtpu::programs
