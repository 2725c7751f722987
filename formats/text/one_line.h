// Texts of files in messages, which are one line.
#pragma once

#include <string>

namespace albtpu::formats {

// Control characters become question marks. TOML allows them in keys and texts, and its parser quotes them.
std::string OneLine(std::string text);

}  // namespace albtpu::formats
