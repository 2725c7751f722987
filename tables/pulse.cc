#include "tables/pulse.h"

namespace albtpu {

std::string OutcomeText(const PulseUncertainty& uncertainty) {
  switch (uncertainty.outcome) {
    case Outcome::kInterpolated:
      return "INTERPOLATED";
    case Outcome::kOutOfDomain: {
      std::string text = "OUT_OF_DOMAIN";
      if (uncertainty.axis.has_value()) text.append(":").append(Describe(*uncertainty.axis).name);
      return text;
    }
    case Outcome::kInvalid:
      break;
  }
  return "INVALID";
}

}  // namespace albtpu
