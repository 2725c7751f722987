#include "programs/generate/table_output.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <iostream>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "formats/text/percent_text.h"
#include "generator/campaign/interpolation_check.h"
#include "generator/campaign/water_cases.h"
#include "tables/file/table_io.h"

namespace albtpu::programs {
namespace {

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

}  // namespace

absl::Status CheckOutput(const std::filesystem::path& output, bool overwrite) {
  const std::string name = output.string();
  std::error_code error;
  const std::filesystem::file_status there = std::filesystem::status(output, error);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there)) {
    return absl::InvalidArgumentError(absl::StrCat(name, ": is not a regular file; name a file to write"));
  }
  if (std::filesystem::exists(there) && !overwrite) {
    return absl::AlreadyExistsError(absl::StrCat(name, ": exists already; --overwrite replaces it"));
  }
  const std::filesystem::path folder =
      output.has_parent_path() ? output.parent_path() : std::filesystem::path(".");
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

absl::Status Publish(const Table& table, const std::filesystem::path& output, bool overwrite) {
  const absl::Status written = WriteTable(table, output, overwrite ? Existing::kReplace : Existing::kKeep);
  if (!written.ok()) return written;
  std::cout << "id " << table.provenance().id << "\nversion " << table.provenance().version << "\ndigest "
            << table.digest() << '\n';
  if (&table.schema() == &kWaterColumn) {
    PrintErrorsOfWater(table.provenance());
  } else {
    PrintInterpolationErrors(table.provenance());
  }
  return absl::OkStatus();
}

}  // namespace albtpu::programs
