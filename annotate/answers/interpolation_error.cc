#include "annotate/answers/interpolation_error.h"

#include <cmath>
#include <optional>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "formats/text/percent_text.h"

namespace albtpu::annotate {
namespace {

// Of an attribute: rms, 99th percentile, maximum, noise, number of pulses. nullopt if no pulse was compared, or if a
// server sends something else.
std::optional<InterpolationError> Parse(Quantity quantity, const std::string& attribute) {
  std::vector<double> numbers;
  for (const absl::string_view text : absl::StrSplit(attribute, ", ")) {
    double number = 0;
    if (!absl::SimpleAtod(text, &number) || !std::isfinite(number)) return std::nullopt;
    numbers.push_back(number);
  }
  if (numbers.size() != 5 || numbers[4] <= 0) return std::nullopt;
  return InterpolationError{quantity, numbers[0], numbers[1]};
}

}  // namespace

std::vector<InterpolationError> InterpolationErrors(const client::TableSummary& table) {
  std::vector<InterpolationError> errors;
  for (const Quantity quantity : kQuantities) {
    const auto attribute =
        table.attributes.find("interpolation_error_" + std::string(Describe(quantity).name));
    if (attribute == table.attributes.end()) continue;
    const std::optional<InterpolationError> error = Parse(quantity, attribute->second);
    if (error.has_value()) errors.push_back(*error);
  }
  return errors;
}

std::string Text(const InterpolationError& error) {
  return absl::StrCat(formats::PercentText(error.rms), " rms, ", formats::PercentText(error.percentile_99),
                      " at the 99th percentile");
}

std::string InterpolationErrorNote(const client::TableSummary& table) {
  const std::vector<InterpolationError> errors = InterpolationErrors(table);
  if (errors.empty()) return "interpolation error: not known (the table does not state it)";
  std::string note = "interpolation error, relative, at random pulses all over the table: ";
  for (std::size_t i = 0; i < errors.size(); ++i) {
    absl::StrAppend(&note, i > 0 ? "; " : "", std::string(Describe(errors[i].quantity).name), " ",
                    Text(errors[i]));
  }
  return note;
}

}  // namespace albtpu::annotate
