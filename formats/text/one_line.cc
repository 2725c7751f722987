#include "formats/text/one_line.h"

namespace albtpu::formats {

std::string OneLine(std::string text) {
  for (char& c : text)
    if ((c >= '\0' && c < ' ') || c == '\x7f') c = '?';
  return text;
}

}  // namespace albtpu::formats
