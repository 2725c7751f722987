#include "service/printable_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "absl/strings/ascii.h"

namespace albtpu {
namespace {

// Replaces U+0080 to U+009F: some terminals treat U+009B as Escape [.
void ReplaceC1Controls(std::string& text) {
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    const bool is_c1 = text[i] == '\xc2' && static_cast<unsigned char>(text[i + 1]) <= 0x9f;
    if (is_c1) text.replace(i, 2, " ");
  }
}

}  // namespace

std::string PrintableText(std::string_view text) {
  std::string printable(text);
  const auto is_control = [](char c) { return absl::ascii_iscntrl(static_cast<unsigned char>(c)); };
  std::replace_if(printable.begin(), printable.end(), is_control, ' ');
  using Json = nlohmann::json;  // Its serializer replaces bytes that are not UTF-8.
  printable = Json::parse(Json(printable).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
  ReplaceC1Controls(printable);
  return printable;
}

std::string PrintableLines(std::string_view text) {
  std::string lines;
  for (std::size_t end; (end = text.find('\n')) != std::string_view::npos; text.remove_prefix(end + 1))
    lines += PrintableText(text.substr(0, end)) + '\n';
  return lines + PrintableText(text);
}

}  // namespace albtpu
