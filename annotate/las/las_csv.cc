#include "annotate/las/las_csv.h"

#include <charconv>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "formats/text/text.h"
#include "laz/coding/little_endian.h"

namespace albtpu::annotate {
namespace {

constexpr int kMostDecimals = 9;

// The decimals that every multiple of `scale` beyond `offset` has; -1 if they are none or too many.
int DecimalsOf(double scale, double offset) {
  double power = 1;
  for (int decimals = 0; decimals <= kMostDecimals; ++decimals, power *= 10) {
    const auto is_whole = [&](double number) {
      const double shifted = number * power;
      return std::abs(shifted - std::round(shifted)) <= 1e-9 * std::max(1.0, std::abs(shifted) * 1e-6);
    };
    if (is_whole(scale) && is_whole(offset)) return decimals;
  }
  return -1;
}

std::string UnitText(double metres) {
  const auto is = [&](double unit) { return std::abs(metres / unit - 1) < 1e-9; };
  return is(1) ? "m" : is(0.3048) ? "ft" : is(1200.0 / 3937) ? "us-ft" : absl::StrCat(metres, " m");
}

void AppendDouble(double value, std::string& text) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void AppendCoordinate(double value, int decimals, std::string& text) {
  if (decimals < 0) return AppendDouble(value, text);
  char digits[400];  // The greatest double has 309 digits before the point.
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, decimals).ptr);
}

}  // namespace

LasCsv::LasCsv(const formats::LasHeader& header, const LasPlace& place, const formats::Appended& appended)
    : fields_(header) {
  for (std::size_t axis = 0; axis < decimals_.size(); ++axis)
    decimals_[axis] = DecimalsOf(header.scale[axis], header.offset[axis]);
  const std::string z = UnitText(place.frame.metres_per_z);
  const std::string x = place.map == nullptr ? z : place.map->is_geographic() ? "degree" : UnitText(place.map->unit());
  const std::string at = appended.coverage == Coverage::kTwoSigma   ? "2 sigma"
                         : appended.coverage == Coverage::kOneSigma ? "1 sigma"
                                                                    : "95 %";
  const std::string name = appended.total ? "total" : "sea";
  head_ = absl::StrCat("gps_time [s],x [", x, "],y [", x, "],z [", z, "],", name, "_thu [m; ", at, "],", name,
                       "_tvu [m; ", at, "],class\n");
}

void LasCsv::Append(std::string_view annotated, std::size_t count, std::size_t record_length,
                    std::size_t annotated_length, std::string& text) const {
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view record = annotated.substr(i * annotated_length, annotated_length);
    if (fields_.has_gps_time()) AppendDouble(fields_.GpsTime(record), text);
    const double place[] = {fields_.X(record), fields_.Y(record), fields_.Z(record)};
    for (std::size_t axis = 0; axis < decimals_.size(); ++axis)
      AppendCoordinate(place[axis], decimals_[axis], text += ',');
    for (std::size_t k = 0; k < formats::kUncertaintyCount; ++k) {
      const auto number = laz::Load<float>(record, record_length + k * sizeof(float));
      text += ',';
      if (number != formats::kNoNumber) formats::AppendFloat(number, text);
    }
    absl::StrAppend(&text, ",", fields_.Class(record), "\n");
  }
}

}  // namespace albtpu::annotate
