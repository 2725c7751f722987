#include "tables/provenance.h"

#include <algorithm>
#include <string_view>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "tables/format.h"

namespace albtpu {
namespace {

absl::Status Invalid(std::string_view attribute, std::string_view problem) {
  return absl::InvalidArgumentError(absl::StrFormat("attribute '%s' %s", std::string(attribute), std::string(problem)));
}

// The length in bytes of the UTF-8 character at the beginning of `text`; 0 if there is no valid character (Unicode
// 15, table 3-7).
std::size_t CharacterLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const auto in = [&](std::size_t i, int low, int high) {
    return i < text.size() && byte(i) >= low && byte(i) <= high;
  };
  const auto continues = [&](std::size_t i) { return in(i, 0x80, 0xBF); };
  if (in(0, 0x00, 0x7F)) return 1;
  if (in(0, 0xC2, 0xDF) && continues(1)) return 2;
  const bool three = (in(0, 0xE0, 0xE0) && in(1, 0xA0, 0xBF)) || (in(0, 0xE1, 0xEC) && continues(1)) ||
                     (in(0, 0xED, 0xED) && in(1, 0x80, 0x9F)) || (in(0, 0xEE, 0xEF) && continues(1));
  if (three && continues(2)) return 3;
  const bool four = (in(0, 0xF0, 0xF0) && in(1, 0x90, 0xBF)) || (in(0, 0xF1, 0xF3) && continues(1)) ||
                    (in(0, 0xF4, 0xF4) && in(1, 0x80, 0x8F));
  return four && continues(2) && continues(3) ? 4 : 0;
}

absl::Status CheckText(std::string_view attribute, std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '\0')
      return Invalid(attribute, absl::StrCat("has a NUL at byte ", i, ": text must not contain NUL"));
    const std::size_t length = CharacterLength(text.substr(i));
    if (length == 0) return Invalid(attribute, absl::StrCat("is not UTF-8 at byte ", i));
    i += length;
  }
  return absl::OkStatus();
}

bool IsId(std::string_view id) {
  const auto is_alphanumeric = [](char c) { return absl::ascii_islower(c) || absl::ascii_isdigit(c); };
  return !id.empty() && is_alphanumeric(id[0]) &&
         std::all_of(id.begin(), id.end(), [&](char c) { return is_alphanumeric(c) || c == '_' || c == '-'; });
}

bool IsAttributeName(std::string_view name) {
  return !name.empty() && !absl::ascii_isdigit(name[0]) &&
         std::all_of(name.begin(), name.end(), [](char c) { return absl::ascii_isalnum(c) || c == '_'; });
}

absl::Status CheckAttribute(std::string_view name, const AttributeValue& value) {
  if (!IsAttributeName(name))
    return Invalid(name, "has an invalid name: use letters, digits and underscores, and do not begin with a digit");
  for (std::string_view reserved : format::kReservedAttributes)
    if (name == reserved) return Invalid(name, "is reserved: it is written from the contents of the table");
  if (name == format::kRefractiveIndex) {
    const double* const index = std::get_if<double>(&value);
    if (index == nullptr || !(*index >= 1 && *index <= 2)) return Invalid(name, "should be a real number from 1 to 2");
  }
  const std::string* text = std::get_if<std::string>(&value);
  return text == nullptr ? absl::OkStatus() : CheckText(name, *text);
}

}  // namespace

absl::Status CheckProvenance(const Provenance& provenance) {
  if (!IsId(provenance.id)) {
    return Invalid(format::kId,
                   absl::StrCat("is '", provenance.id,
                                "': use lowercase letters, digits, '-' and '_', and begin with a letter or a "
                                "digit"));
  }
  if (provenance.version.empty()) return Invalid(format::kVersion, "is empty: name this edition of the table");
  if (provenance.title.find('\n') != std::string::npos)
    return Invalid(format::kTitle, "has several lines: it must be one line");
  absl::Status status = CheckText(format::kVersion, provenance.version);
  if (status.ok()) status = CheckText(format::kTitle, provenance.title);
  if (status.ok()) status = CheckText(format::kCampaign, provenance.campaign);
  for (const auto& [name, value] : provenance.attributes)
    if (status.ok()) status = CheckAttribute(name, value);
  return status;
}

}  // namespace albtpu
