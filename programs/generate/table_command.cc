#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "formats/text/text.h"
#include "generator/campaign/provenance.h"
#include "generator/campaign/table_maker.h"
#include "generator/campaign/unit_work.h"
#include "generator/campaign/water_cases.h"
#include "generator/ranks/ranks.h"
#include "programs/generate/commands.h"
#include "status/status_macros.h"
#include "tables/file/table_io.h"
#include "tables/table.h"

namespace albtpu::programs {
namespace {

// The progress of a long computation and the time left, on standard error. On a terminal a bar, which is redrawn in
// place and erased at the end; elsewhere a line every ten seconds.
class Progress {
 public:
  Progress(std::string label, std::size_t total)
      : label_(std::move(label)),
        total_(total),
        terminal_(isatty(STDERR_FILENO) == 1),
        start_(Clock::now()),
        last_shown_(start_) {}
  ~Progress() {
    if (terminal_) std::fprintf(stderr, "\r\033[K");
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Reach(std::size_t done) {
    constexpr std::chrono::milliseconds kRedraw(100);
    constexpr std::chrono::seconds kPlainLine(10);
    constexpr std::size_t kBarWidth = 30;
    const Clock::time_point now = Clock::now();
    if (done == 0 || now - last_shown_ < (terminal_ ? Clock::duration(kRedraw) : Clock::duration(kPlainLine))) return;
    last_shown_ = now;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const double left = elapsed * static_cast<double>(total_ - done) / static_cast<double>(done);
    if (terminal_) {
      const std::string bar(kBarWidth * done / total_, '#');
      std::fprintf(stderr, "\r%s [%-*s] %zu of %zu, %.0f s left\033[K", label_.c_str(), static_cast<int>(kBarWidth),
                   bar.c_str(), done, total_, left);
    } else {
      std::fprintf(stderr, "%s: %zu of %zu, %.0f s left\n", label_.c_str(), done, total_, left);
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::string label_;
  std::size_t total_;
  bool terminal_;
  Clock::time_point start_, last_shown_;
};

// Checks, before the computation, that the table can be written.
absl::Status CheckOutput(const std::filesystem::path& output, bool overwrite) {
  const std::string name = output.string();
  std::error_code error;
  const std::filesystem::file_status there = std::filesystem::status(output, error);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there))
    return absl::InvalidArgumentError(absl::StrCat(name, ": is not a regular file; name a file to write"));
  if (std::filesystem::exists(there) && !overwrite)
    return absl::AlreadyExistsError(absl::StrCat(name, ": exists already; --overwrite replaces it"));
  const std::filesystem::path folder = output.has_parent_path() ? output.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder, error)) {
    return absl::NotFoundError(
        absl::StrCat(name, ": there is no folder ", folder.string(), "; create it, or name another file"));
  }
  std::string probe = (folder / ".albtpu-probe-XXXXXX").string();
  const int file = mkstemp(probe.data());
  if (file < 0) {
    return absl::PermissionDeniedError(
        absl::StrCat(name, ": the folder ", folder.string(), " is not writable: ", std::strerror(errno)));
  }
  close(file);
  unlink(probe.c_str());
  return absl::OkStatus();
}

// A table with a larger interpolation error (rms, relative) is coarse compared with the approximations of the model.
constexpr double kCoarse = 0.02;
constexpr double kMostWithin = 0.99;

// The attribute interpolation_error_NAME: rms, 99th percentile, maximum, noise, number of pulses.
void PrintInterpolationErrors(const Provenance& provenance) {
  std::string coarse;
  for (const Quantity quantity : kChecked) {
    const std::string quantity_name(Describe(quantity).name);
    const auto attribute = provenance.attributes.find("interpolation_error_" + quantity_name);
    if (attribute == provenance.attributes.end()) continue;
    const auto& numbers = std::get<std::vector<double>>(attribute->second);
    const double rms = numbers[0], percentile_99 = numbers[1], pulses = numbers[4];
    std::cout << attribute->first << ' ';
    if (pulses == 0) {
      std::cout << "not known (no checked pulse has at least 0.01 degrees or 5 mm)\n";
      continue;
    }
    std::cout << formats::PercentText(rms) << " rms, " << formats::PercentText(percentile_99)
              << " at the 99th percentile of " << pulses << " pulses\n";
    if (rms > kCoarse)
      absl::StrAppend(&coarse, coarse.empty() ? "" : ", ", quantity_name, " ", formats::PercentText(rms));
  }
  if (coarse.empty()) return;
  std::cerr << "albtpu-generate: warning: the table is coarse (its values between nodes are off by more than "
            << formats::PercentText(kCoarse) << " rms: " << coarse << "); give its axes more nodes\n";
}

// The same for the water column: rms, fraction within 3 mm or 4 %, maximum, noise, number of beams.
void PrintErrorsOfWater(const Provenance& provenance) {
  bool coarse = false;
  for (std::size_t bias = 0; bias < kCheckedBiases; ++bias) {
    const std::string name = "interpolation_error_" + std::string(kWaterColumn.quantities[bias].name);
    const auto& numbers = std::get<std::vector<double>>(provenance.attributes.at(name));
    std::cout << name << ' '
              << absl::StrFormat("%.1f mm rms, %.1f mm greatest, %.1f %% of %.0f beams within 3 mm or 4 %%\n",
                                 1000 * numbers[0], 1000 * numbers[2], 100 * numbers[1], numbers[4]);
    coarse = coarse || numbers[1] < kMostWithin;
  }
  if (!coarse) return;
  std::cerr << "albtpu-generate: warning: the table is coarse (its values between nodes are off by more than "
               "3 mm and "
               "4 % at more than one beam in a hundred); give its axes more nodes\n";
}

// Writes the table. Prints its id, version, digest and interpolation errors on standard output, and a warning on
// standard error if they are large.
absl::Status Publish(const Table& table, const std::filesystem::path& output, bool overwrite) {
  RETURN_IF_ERROR(WriteTable(table, output, overwrite ? Existing::kReplace : Existing::kKeep));
  std::cout << "id " << table.provenance().id << "\nversion " << table.provenance().version << "\ndigest "
            << table.digest() << '\n';
  if (&table.schema() == &kWaterColumn)
    PrintErrorsOfWater(table.provenance());
  else
    PrintInterpolationErrors(table.provenance());
  return absl::OkStatus();
}

// The units that this shard computes; all without a shard.
std::vector<UnitId> Share(const std::vector<UnitId>& units, const std::optional<Shard>& shard) {
  if (!shard) return units;
  std::vector<UnitId> share;
  for (std::size_t i = 0; i < units.size(); ++i)
    if (i % shard->count == static_cast<std::size_t>(shard->index)) share.push_back(units[i]);
  return share;
}

// Adds the units that the folder has to `builder`, which needs --resume, and removes them from `units`.
absl::Status AddFinished(const WorkFolder& work, bool resume, std::vector<UnitId>& units, TableBuilder& builder) {
  ASSIGN_OR_RETURN(const std::vector<UnitId> finished, work.Finished(units));
  if (!finished.empty() && !resume) {
    return absl::AlreadyExistsError(
        absl::StrCat(work.PathOf(finished.front()).parent_path().string(), ": has ", finished.size(), " of these ",
                     units.size(), " units already; give --resume to use them, or another folder to start anew"));
  }
  std::erase_if(units, [&](UnitId unit) { return std::binary_search(finished.begin(), finished.end(), unit); });
  return work.Read(finished, [&](UnitId unit, const std::string& bytes) { return builder.Add(unit, bytes); });
}

std::string Label(const Campaign& campaign, const std::optional<Shard>& shard, std::size_t taken) {
  std::string label = absl::StrCat("albtpu-generate: units of '", campaign.id, "'");
  if (shard) absl::StrAppend(&label, ", shard ", shard->index, "/", shard->count);
  if (taken > 0) absl::StrAppend(&label, ", ", taken, " more were finished before");
  return label;
}

// The work of rank 0, which may be the only one.
absl::Status Lead(const TableOptions& options, Ranks& ranks) {
  ASSIGN_OR_RETURN(const Campaign campaign, ReadCampaign(options.campaign));
  if (!options.shard) {
    if (const absl::Status status = CheckOutput(options.output, options.overwrite); !status.ok()) return status;
  }
  TableBuilder builder(campaign);
  const std::vector<UnitId> share = Share(UnitsOf(campaign), options.shard);
  std::vector<UnitId> units = share;
  std::optional<WorkFolder> work;
  if (!options.work.empty()) {
    ASSIGN_OR_RETURN(work, WorkFolder::Open(options.work, campaign));
    if (const absl::Status status = AddFinished(*work, options.resume, units, builder); !status.ok()) return status;
    // With shards, other processes may be writing temporary files.
    if (!options.shard) {
      if (const absl::Status status = work->RemoveTemporaries(); !status.ok()) return status;
    }
  }

  absl::Status computed;
  {
    Progress progress(Label(campaign, options.shard, share.size() - units.size()), units.size());
    std::size_t done = 0;
    computed =
        ComputeUnits(campaign, units, ranks, [&](UnitId unit, const std::string& bytes, const std::string& from) {
          const absl::Status added = builder.Add(unit, bytes);
          if (!added.ok())
            return absl::Status(added.code(),
                                absl::StrCat(Name(unit), ", computed by ", from, ": ", std::string(added.message())));
          const absl::Status stored = work ? work->Store(unit, bytes) : absl::OkStatus();
          progress.Reach(++done);
          return stored;
        });
  }
  if (!computed.ok()) return computed;
  if (options.shard) {
    std::cout << "units " << share.size() << '\n';
    return absl::OkStatus();
  }
  ASSIGN_OR_RETURN(const Table table, builder.Build());
  if (const absl::Status status = Publish(table, options.output, options.overwrite); !status.ok()) return status;
  Dismiss(ranks);
  return absl::OkStatus();
}

}  // namespace

absl::Status RunTable(const TableOptions& options) {
  // A shard is a process of its own, even if it was started by an MPI launcher.
  if (options.shard) return Lead(options, *OneRank());
  ASSIGN_OR_RETURN(std::unique_ptr<Ranks> joined, Ranks::Join());
  Ranks& ranks = *joined;
  if (ranks.size() == 1) return Lead(options, ranks);

  absl::Status status;
  try {
    status = ranks.rank() == 0 ? Lead(options, ranks) : FollowRankZero(ranks);
  } catch (const std::exception& error) {  // out of memory or threads
    status = absl::InternalError(error.what());
  }
  if (!status.ok()) {
    std::cerr << "albtpu-generate: rank " << ranks.rank() << ": " << std::string(status.message()) << std::endl;
    ranks.EndAll();
  }
  return status;
}

absl::Status RunMerge(const MergeOptions& options) {
  ASSIGN_OR_RETURN(const WorkFolder work, WorkFolder::OpenExisting(options.work));
  ASSIGN_OR_RETURN(const Campaign campaign, work.ReadCampaign());
  if (const absl::Status status = CheckOutput(options.output, options.overwrite); !status.ok()) return status;

  const std::vector<UnitId> units = UnitsOf(campaign);
  ASSIGN_OR_RETURN(const std::vector<UnitId> finished, work.Finished(units));
  if (finished.size() < units.size()) {
    const auto missing = std::mismatch(units.begin(), units.end(), finished.begin(), finished.end()).first;
    return absl::FailedPreconditionError(
        absl::StrCat(options.work.string(), ": has ", finished.size(), " of ", units.size(), " units, ", Name(*missing),
                     " is the first that is missing; compute it with `table --work --resume`, or with its shard"));
  }
  TableBuilder builder(campaign);
  {
    Progress progress(absl::StrCat("albtpu-generate: reading units of '", campaign.id, "'"), units.size());
    std::size_t done = 0;
    RETURN_IF_ERROR(work.Read(units, [&](UnitId unit, const std::string& bytes) {
      progress.Reach(++done);
      return builder.Add(unit, bytes);
    }));
  }
  ASSIGN_OR_RETURN(const Table table, builder.Build());
  return Publish(table, options.output, options.overwrite);
}

}  // namespace albtpu::programs
