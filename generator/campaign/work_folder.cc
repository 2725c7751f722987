#include "generator/campaign/work_folder.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>

#include "absl/strings/str_cat.h"
#include "tables/file/atomic_file.h"

namespace albtpu {
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
  if (!file.is_open() || file.bad()) {
    return SystemError(std::error_code(errno != 0 ? errno : EIO, std::generic_category()), "read", path);
  }
  return bytes;
}

// Writes a file that never changes. Succeeds when the file exists with the same bytes.
absl::Status WriteOnce(const fs::path& path, const std::string& bytes) {
  const absl::Status written = WriteFileAtomically(path, bytes, Existing::kKeep);
  if (!absl::IsAlreadyExists(written)) return written;
  const absl::StatusOr<std::string> there = ReadFile(path);
  if (!there.ok()) return there.status();
  return *there == bytes ? absl::OkStatus() : written;
}

// Calls `visit` with the name of each file of a folder.
template <typename Visit>
absl::Status ForEachName(const fs::path& folder, const Visit& visit) {
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    visit(entry->path().filename().string());
  }
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
        absl::StrCat(path.string(), ": is another campaign (or another text of it) than '", campaign.id,
                     "' version ", campaign.version, "; give each campaign its own work folder"));
  }
  if (!written.ok()) return written;
  return WorkFolder(folder);
}

absl::StatusOr<WorkFolder> WorkFolder::OpenExisting(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / kCampaignName, error)) {
    return absl::NotFoundError(absl::StrCat(folder.string(), ": has no ", kCampaignName,
                                            "; give a folder that `table --work` has filled"));
  }
  return WorkFolder(folder);
}

absl::StatusOr<Campaign> WorkFolder::ReadCampaign() const {
  return albtpu::ReadCampaign(folder_ / kCampaignName);
}

absl::StatusOr<std::vector<UnitId>> WorkFolder::Finished(const std::vector<UnitId>& units) const {
  std::set<std::string> names;
  const absl::Status listed = ForEachName(folder_, [&](const std::string& name) { names.insert(name); });
  if (!listed.ok()) return listed;
  std::vector<UnitId> finished;
  std::copy_if(units.begin(), units.end(), std::back_inserter(finished),
               [&](UnitId unit) { return names.contains(PathOf(unit).filename().string()); });
  return finished;
}

absl::Status WorkFolder::Read(const std::vector<UnitId>& units, const Sink& sink) const {
  for (const UnitId unit : units) {
    const absl::StatusOr<std::string> bytes = ReadFile(PathOf(unit));
    if (!bytes.ok()) return bytes.status();
    const absl::Status taken = sink(unit, *bytes);
    if (!taken.ok()) {
      return absl::Status(taken.code(),
                          absl::StrCat(PathOf(unit).string(), ": ", std::string(taken.message())));
    }
  }
  return absl::OkStatus();
}

absl::Status WorkFolder::Store(UnitId unit, const std::string& bytes) const {
  const absl::Status stored = WriteOnce(PathOf(unit), bytes);
  if (absl::IsAlreadyExists(stored)) {
    return absl::AlreadyExistsError(absl::StrCat(
        PathOf(unit).string(),
        ": exists with other bytes than were just computed (another program or machine writes into this "
        "folder); give each its own work folder"));
  }
  if (stored.ok()) return stored;
  return absl::Status(stored.code(),
                      absl::StrCat(std::string(stored.message()),
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
