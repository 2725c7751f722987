#include <iostream>

#include "generator/campaign/campaign_keys.h"
#include "generator/commands/commands.h"

namespace albtpu {

absl::Status RunKeys() {
  std::cout << CampaignReference();
  return absl::OkStatus();
}

}  // namespace albtpu
