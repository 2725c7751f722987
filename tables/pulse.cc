#include "tables/pulse.h"

namespace albtpu {

std::string_view Name(Side side) { return side == Side::kBelow ? "below" : "above"; }

std::optional<Side> SideOf(const AxisSchema& axis, double last, double coordinate) {
  if (axis.fold != Fold::kNone) return std::nullopt;
  return coordinate > last ? Side::kAbove : Side::kBelow;
}

std::string OutcomeText(const PulseUncertainty& uncertainty) {
  switch (uncertainty.outcome) {
    case Outcome::kInterpolated:
      return "INTERPOLATED";
    case Outcome::kOutOfDomain: {
      std::string text = "OUT_OF_DOMAIN";
      if (uncertainty.axis.has_value()) text.append(":").append(Describe(*uncertainty.axis).name);
      if (uncertainty.side.has_value()) text.append(":").append(Name(*uncertainty.side));
      return text;
    }
    case Outcome::kInvalid:
      break;
  }
  return "INVALID";
}

}  // namespace albtpu
