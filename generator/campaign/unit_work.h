// Working off units: on the threads of this process, and on those of the other ranks.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "generator/campaign/campaign.h"
#include "generator/campaign/unit.h"
#include "generator/ranks/ranks.h"

namespace albtpu {

// Takes a sealed unit; `from` names the rank that computed it, "rank 0", for messages.
using UnitSink = std::function<absl::Status(UnitId unit, const std::string& bytes, const std::string& from)>;

// Works off `units`, as many at a time as there are threads; what threads have nothing else to do help with
// the surfaces of others' sea cases. Other ranks, which are in FollowRankZero, get units one by one as they
// ask for more. `sink` is called by one thread at a time, once for each unit, in no order; its first failure
// ends the work and is returned. For rank 0.
absl::Status WorkOff(const Campaign& campaign, const std::vector<UnitId>& units, Ranks& ranks,
                     const UnitSink& sink);

// Lets the other ranks return, when the table is written. For rank 0.
void Dismiss(Ranks& ranks);

// Works off what rank 0 hands out until that dismisses. For all ranks but 0. The error is that of a campaign
// that this rank cannot read.
absl::Status FollowRankZero(Ranks& ranks);

}  // namespace albtpu
