// Text from elsewhere, for a terminal or a log.
#pragma once

#include <string>
#include <string_view>

namespace albtpu {

// `text` on one line and in UTF-8: control characters, with which a terminal could be told to do things, are
// blanks, and what is no UTF-8 is U+FFFD.
std::string PrintableText(std::string_view text);

}  // namespace albtpu
