// The standard deviations of the air side as a message, whose fields are those of kErrorSources.
#pragma once

#include "albtpu/v1/budget.pb.h"
#include "budget/air/air_errors.h"

namespace albtpu {

v1::AirErrors ToMessage(const AirErrors& errors);
AirErrors FromMessage(v1::AirErrors message);

}  // namespace albtpu
