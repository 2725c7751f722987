// Computes units on the threads of this process and of the other ranks.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "generator/campaign/campaign.h"
#include "generator/campaign/unit.h"
#include "generator/ranks/ranks.h"

namespace albtpu {

// Receives a sealed unit. `from` names the rank that computed it, such as "rank 0", for messages.
using UnitSink = std::function<absl::Status(UnitId unit, const std::string& bytes, const std::string& from)>;

// Computes `units` on rank 0, one on each thread; idle threads help with the surfaces of other threads' sea cases. The
// other ranks, which must be in FollowRankZero, get units one by one as they ask for them. `sink` is called by one
// thread at a time, once for each unit, in no particular order. Its first failure ends the work and is returned.
absl::Status ComputeUnits(const Campaign& campaign, const std::vector<UnitId>& units, Ranks& ranks,
                          const UnitSink& sink);

// On rank 0, lets the other ranks return from FollowRankZero. Call it when the table is written.
void Dismiss(Ranks& ranks);

// On all ranks but 0, computes the units that rank 0 hands out, until rank 0 calls Dismiss. Fails when this rank cannot
// read the campaign.
absl::Status FollowRankZero(Ranks& ranks);

}  // namespace albtpu
