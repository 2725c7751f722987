#include "generator/campaign/unit_work.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <future>
#include <iterator>
#include <mutex>
#include <optional>
#include <set>
#include <system_error>
#include <thread>

#include "absl/strings/str_cat.h"
#include "generator/campaign/provenance.h"
#include "generator/campaign/water_cases.h"
#include "status/status_macros.h"
#include "tables/file/atomic_file.h"

namespace albtpu {
namespace {

enum Tag {
  kCampaign,   // from rank 0, first: the text of the campaign
  kAsk,        // to rank 0: asks for a unit
  kAssign,     // from rank 0, in reply: a unit, or nothing when there are no more
  kUnit,       // to rank 0: a computed unit and its bytes
  kNoMore,     // to rank 0: all computed units have been sent
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
      return SealUnit(
          unit, origin,
          EncodeResult(Simulate(SeaCaseOf(campaign, unit.index), campaign.effort, campaign.seed, kCellOfTables)));
    case UnitKind::kWaterCase:
      return SealUnit(unit, origin, EncodeEstimates(ComputeWaterCase(campaign, unit.index)));
    case UnitKind::kPulse:
      return SealUnit(unit, origin,
                      EncodeEstimates(campaign.water ? ComputeDirectly(campaign, CheckedBeamOf(campaign, unit.index))
                                                     : ComputeDirectly(campaign, CheckedPulse(campaign, unit.index))));
  }
  std::abort();  // not reached: the switch has all kinds
}

// On each thread, gets a unit from `next`, computes it and passes it to `done`, until there are no more. Both functions
// are called by many threads at once.
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
          // Isolated: while a thread waits for the last surface of its unit, it must not start another loop.
          std::string bytes = tbb::this_task_arena::isolate([&] { return Compute(campaign, origin, *unit); });
          done(*unit, std::move(bytes));
        }
      } catch (...) {  // out of memory; the other threads stop too
        failed = true;
        throw;
      }
    });
  }
  loops.wait();
}

// Hands out units and passes finished ones to the sink.
class Ledger {
 public:
  Ledger(const std::vector<UnitId>& units, const UnitSink& sink) : units_(units), sink_(sink) {}

  std::optional<UnitId> Next() {
    const std::lock_guard lock(mutex_);
    if (next_ == units_.size() || !status_.ok()) return std::nullopt;
    return units_[next_++];
  }

  void Accept(UnitId unit, const std::string& bytes, const std::string& from) {
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

absl::Status ComputeUnits(const Campaign& campaign, const std::vector<UnitId>& units, Ranks& ranks,
                          const UnitSink& sink) {
  for (int rank = 1; rank < ranks.size(); ++rank) ranks.Send(rank, kCampaign, campaign.text);
  Ledger ledger(units, sink);
  const auto compute = [&] {
    ComputeAll(
        campaign, [&] { return ledger.Next(); },
        [&](UnitId unit, const std::string& bytes) { ledger.Accept(unit, bytes, "rank 0"); });
  };
  if (ranks.size() == 1) {
    compute();
    return ledger.status();
  }

  // This thread only answers the other ranks, so that they never wait for a computation here. After a failure the
  // caller ends all ranks, so only this process's own threads are waited for.
  std::future<void> computed = std::async(std::launch::async, compute);
  for (int working = ranks.size() - 1; working > 0 && ledger.status().ok();) {
    if (computed.valid() && computed.wait_for(std::chrono::seconds(0)) == std::future_status::ready) computed.get();
    const std::optional<Ranks::Message> message = ranks.Poll();
    if (!message) {
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    } else if (message->tag == kAsk) {
      const std::optional<UnitId> unit = ledger.Next();
      ranks.Send(message->rank, kAssign, unit ? UnitMessage(*unit, {}) : "");
    } else if (message->tag == kUnit) {
      std::string_view bytes;
      const UnitId unit = ReadUnitMessage(message->bytes, bytes);
      ledger.Accept(unit, std::string(bytes), absl::StrCat("rank ", message->rank));
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
  ASSIGN_OR_RETURN(const Campaign campaign, ParseCampaign(ranks.Receive().bytes));
  std::mutex messages;  // held while messages are exchanged
  ComputeAll(
      campaign,
      [&]() -> std::optional<UnitId> {
        const std::lock_guard lock(messages);
        ranks.Send(0, kAsk, "");
        const Ranks::Message reply = ranks.Receive();
        std::string_view no_bytes;
        return reply.bytes.empty() ? std::nullopt : std::optional(ReadUnitMessage(reply.bytes, no_bytes));
      },
      [&](UnitId unit, const std::string& bytes) {
        const std::lock_guard lock(messages);
        ranks.Send(0, kUnit, UnitMessage(unit, bytes));
      });
  ranks.Send(0, kNoMore, "");
  ranks.Receive();  // kDismissed
  return absl::OkStatus();
}

namespace {

namespace fs = std::filesystem;

constexpr const char* kCampaignName = "campaign.toml";
constexpr const char* kUnitSuffix = ".unit";

absl::Status SystemError(const std::error_code& error, const char* verb, const fs::path& path) {
  return absl::ErrnoToStatus(error.value(), absl::StrCat("cannot ", verb, " '", path.string(), "'"));
}

absl::StatusOr<std::string> ReadFile(const fs::path& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file.is_open() || file.bad())
    return SystemError(std::error_code(errno != 0 ? errno : EIO, std::generic_category()), "read", path);
  return bytes;
}

// Writes a file that never changes. Succeeds when the file exists with the same bytes.
absl::Status WriteOnce(const fs::path& path, const std::string& bytes) {
  const absl::Status written = WriteFileAtomically(path, bytes, Existing::kKeep);
  if (!absl::IsAlreadyExists(written)) return written;
  ASSIGN_OR_RETURN(const std::string there, ReadFile(path));
  return there == bytes ? absl::OkStatus() : written;
}

// Calls `visit` with the name of each file of a folder.
template <typename Visit>
absl::Status ForEachName(const fs::path& folder, const Visit& visit) {
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) visit(entry->path().filename().string());
  return error ? SystemError(error, "read folder", folder) : absl::OkStatus();
}

}  // namespace

absl::StatusOr<WorkFolder> WorkFolder::Open(const fs::path& folder, const Campaign& campaign) {
  std::error_code error;
  fs::create_directory(folder, error);
  if (std::error_code ignored; !fs::is_directory(folder, ignored)) {
    if (!error) error = std::make_error_code(std::errc::not_a_directory);
    return SystemError(error, "make the work folder", folder);
  }
  const fs::path path = folder / kCampaignName;
  const absl::Status written = WriteOnce(path, campaign.text);
  if (absl::IsAlreadyExists(written)) {
    return absl::FailedPreconditionError(
        absl::StrCat(path.string(), ": is another campaign (or another text of it) than '", campaign.id, "' version ",
                     campaign.version, "; give each campaign its own work folder"));
  }
  if (!written.ok()) return written;
  return WorkFolder(folder);
}

absl::StatusOr<WorkFolder> WorkFolder::OpenExisting(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / kCampaignName, error)) {
    return absl::NotFoundError(
        absl::StrCat(folder.string(), ": has no ", kCampaignName, "; give a folder that `table --work` has filled"));
  }
  return WorkFolder(folder);
}

absl::StatusOr<Campaign> WorkFolder::ReadCampaign() const { return albtpu::ReadCampaign(folder_ / kCampaignName); }

absl::StatusOr<std::vector<UnitId>> WorkFolder::Finished(const std::vector<UnitId>& units) const {
  std::set<std::string> names;
  RETURN_IF_ERROR(ForEachName(folder_, [&](const std::string& name) { names.insert(name); }));
  std::vector<UnitId> finished;
  std::copy_if(units.begin(), units.end(), std::back_inserter(finished),
               [&](UnitId unit) { return names.contains(PathOf(unit).filename().string()); });
  return finished;
}

absl::Status WorkFolder::Read(const std::vector<UnitId>& units, const Sink& sink) const {
  for (const UnitId unit : units) {
    ASSIGN_OR_RETURN(const std::string bytes, ReadFile(PathOf(unit)));
    const absl::Status taken = sink(unit, bytes);
    if (!taken.ok())
      return absl::Status(taken.code(), absl::StrCat(PathOf(unit).string(), ": ", std::string(taken.message())));
  }
  return absl::OkStatus();
}

absl::Status WorkFolder::Store(UnitId unit, const std::string& bytes) const {
  const absl::Status stored = WriteOnce(PathOf(unit), bytes);
  if (absl::IsAlreadyExists(stored)) {
    return absl::AlreadyExistsError(
        absl::StrCat(PathOf(unit).string(),
                     ": exists with other bytes than were just computed (another program or machine writes into this "
                     "folder); give each its own work folder"));
  }
  if (stored.ok()) return stored;
  return absl::Status(stored.code(), absl::StrCat(std::string(stored.message()),
                                                  "; earlier units are complete, continue from them with --resume"));
}

absl::Status WorkFolder::RemoveTemporaries() const {
  std::vector<fs::path> left;
  const absl::Status listed = ForEachName(folder_, [&](const std::string& name) {
    if (IsTemporaryName(name)) left.push_back(folder_ / name);
  });
  for (const fs::path& path : left) {
    std::error_code error;
    if (!fs::remove(path, error) && error) return SystemError(error, "remove", path);
  }
  return listed;
}

fs::path WorkFolder::PathOf(UnitId unit) const { return folder_ / (Name(unit) + kUnitSuffix); }

}  // namespace albtpu
