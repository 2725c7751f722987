#include "generator/campaign/unit_work.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <atomic>
#include <cassert>
#include <chrono>
#include <cstdlib>
#include <future>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "absl/strings/str_cat.h"
#include "generator/campaign/byte_stream.h"
#include "generator/campaign/interpolation_check.h"
#include "generator/campaign/unit_content.h"

namespace albtpu {
namespace {

enum Tag {
  kCampaign,   // from rank 0, first: the text
  kAsk,        // to rank 0: for a unit
  kAssign,     // from rank 0, the answer: a unit, or nothing: there are no more
  kUnit,       // to rank 0: a unit and its bytes
  kNoMore,     // to rank 0: all that was computed has been sent
  kDismissed,  // from rank 0, last
};

std::string UnitMessage(UnitId unit, std::string_view bytes) {
  ByteWriter writer;
  writer(static_cast<int>(unit.kind), unit.index, bytes);
  return std::move(writer).Take();
}

UnitId ReadUnitMessage(const std::string& message, std::string_view& bytes) {
  ByteReader reader(message);
  int kind = 0;
  std::size_t index = 0;
  reader(kind, index, bytes);
  assert(reader.ReadAll());
  return {static_cast<UnitKind>(kind), index};
}

std::string Compute(const Campaign& campaign, const UnitOrigin& origin, UnitId unit) {
  switch (unit.kind) {
    case UnitKind::kSeaCase:
      return SealUnit(unit, origin,
                      EncodeResult(Simulate(SeaCaseOf(campaign, unit.index), campaign.effort, campaign.seed,
                                            kCellOfTables)));
    case UnitKind::kPulse:
      return SealUnit(unit, origin,
                      EncodeAnswers(AnswerDirectly(campaign, CheckedPulse(campaign, unit.index))));
  }
  std::abort();  // every kind has its case
}

// Each thread asks `next` for a unit, computes it, and gives it to `done`, until there is none. Both are
// called by many threads at once.
void ComputeAll(const Campaign& campaign, const std::function<std::optional<UnitId>()>& next,
                const std::function<void(UnitId, std::string)>& done) {
  const UnitOrigin origin = OriginOf(campaign);
  std::atomic<bool> failed = false;
  tbb::task_group loops;
  const std::size_t threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  for (std::size_t i = 0; i < threads; ++i) {
    loops.run([&] {
      try {
        while (const std::optional<UnitId> unit = failed ? std::nullopt : next()) {
          // A thread that waits for the last surface of its unit does not begin another loop meanwhile.
          std::string bytes = tbb::this_task_arena::isolate([&] { return Compute(campaign, origin, *unit); });
          done(*unit, std::move(bytes));
        }
      } catch (...) {  // no memory: the other threads end too
        failed = true;
        throw;
      }
    });
  }
  loops.wait();
}

// The units that are still to be handed out, and what became of those that came back.
class Ledger {
 public:
  Ledger(const std::vector<UnitId>& units, const UnitSink& sink) : units_(units), sink_(sink) {}

  std::optional<UnitId> Next() {
    const std::lock_guard lock(mutex_);
    if (next_ == units_.size() || !status_.ok()) return std::nullopt;
    return units_[next_++];
  }

  void Done(UnitId unit, const std::string& bytes, const std::string& from) {
    const std::lock_guard lock(mutex_);
    if (status_.ok()) status_ = sink_(unit, bytes, from);
  }

  absl::Status status() {
    const std::lock_guard lock(mutex_);
    return status_;
  }

 private:
  std::mutex mutex_;
  const std::vector<UnitId>& units_;
  const UnitSink& sink_;
  std::size_t next_ = 0;
  absl::Status status_;
};

}  // namespace

absl::Status WorkOff(const Campaign& campaign, const std::vector<UnitId>& units, Ranks& ranks,
                     const UnitSink& sink) {
  for (int rank = 1; rank < ranks.size(); ++rank) ranks.Send(rank, kCampaign, campaign.text);
  Ledger ledger(units, sink);
  const auto compute = [&] {
    ComputeAll(
        campaign, [&] { return ledger.Next(); },
        [&](UnitId unit, const std::string& bytes) { ledger.Done(unit, bytes, "rank 0"); });
  };
  if (ranks.size() == 1) {
    compute();
    return ledger.status();
  }

  // This thread alone answers the other ranks, so that none waits for a computation here. A failure ends all
  // ranks, by the caller: then nobody is waited for, this process's own threads aside.
  std::future<void> computed = std::async(std::launch::async, compute);
  for (int working = ranks.size() - 1; working > 0 && ledger.status().ok();) {
    if (computed.valid() && computed.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
      computed.get();
    const std::optional<Ranks::Message> message = ranks.Poll();
    if (!message) {
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    } else if (message->tag == kAsk) {
      const std::optional<UnitId> unit = ledger.Next();
      ranks.Send(message->rank, kAssign, unit ? UnitMessage(*unit, {}) : "");
    } else if (message->tag == kUnit) {
      std::string_view bytes;
      const UnitId unit = ReadUnitMessage(message->bytes, bytes);
      ledger.Done(unit, std::string(bytes), absl::StrCat("rank ", message->rank));
    } else {
      assert(message->tag == kNoMore);
      --working;
    }
  }
  if (computed.valid()) computed.get();
  return ledger.status();
}

void Dismiss(Ranks& ranks) {
  for (int rank = 1; rank < ranks.size(); ++rank) ranks.Send(rank, kDismissed, "");
}

absl::Status FollowRankZero(Ranks& ranks) {
  const absl::StatusOr<Campaign> campaign = ParseCampaign(ranks.Receive().bytes);
  if (!campaign.ok()) return campaign.status();
  std::mutex talking;
  ComputeAll(
      *campaign,
      [&]() -> std::optional<UnitId> {
        const std::lock_guard lock(talking);
        ranks.Send(0, kAsk, "");
        const Ranks::Message answer = ranks.Receive();
        std::string_view none;
        return answer.bytes.empty() ? std::nullopt : std::optional(ReadUnitMessage(answer.bytes, none));
      },
      [&](UnitId unit, const std::string& bytes) {
        const std::lock_guard lock(talking);
        ranks.Send(0, kUnit, UnitMessage(unit, bytes));
      });
  ranks.Send(0, kNoMore, "");
  ranks.Receive();  // kDismissed
  return absl::OkStatus();
}

}  // namespace albtpu
