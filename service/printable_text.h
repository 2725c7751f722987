// Makes text from other programs and files safe for a terminal or a log.
#pragma once

#include <string>
#include <string_view>

namespace albtpu {

// `text` on one line and in UTF-8. Control characters, which a terminal might execute, become blanks; bytes that are
// not UTF-8 become U+FFFD.
std::string PrintableText(std::string_view text);

// The same of each line of `text`.
std::string PrintableLines(std::string_view text);

}  // namespace albtpu
