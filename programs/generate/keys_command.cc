#include <iostream>

#include "generator/campaign/campaign_keys.h"
#include "programs/generate/commands.h"

namespace albtpu::programs {

absl::Status RunKeys() {
  std::cout << CampaignReference();
  return absl::OkStatus();
}

}  // namespace albtpu::programs
