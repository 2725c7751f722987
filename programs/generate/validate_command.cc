#include <iostream>

#include "absl/strings/str_cat.h"
#include "programs/generate/commands.h"
#include "tables/default_tables.h"
#include "tables/version.h"
#include "validation/laboratory/laboratory_studies.h"
#include "validation/published/published_table.h"
#include "validation/report/report.h"
#include "validation/report/study.h"
#include "validation/studies/studies.h"

namespace albtpu::programs {
namespace {

struct NamedStudy {
  const char* name;
  StudyFunction run;
};

// In the order of the paper, followed by studies of our own.
constexpr NamedStudy kStudies[] = {
    {"Figures 2 and 3, the spectrum", SpectrumStudy},
    {"Table 2, the wave staff", WaveStaffStudy},
    {"Table 3, the Monte Carlo", PaperMonteCarloStudy},
    {"Table 4, the laboratory", LaboratoryStudy},
    {"Table 5, the angle method", AngleMethodStudy},
    {"the closed form", ClosedFormMapStudy},
    {"the real sea", RealSeaStudy},
    {"waves that are corrected away", CorrectedWavesStudy},
    {"the response theory", ResponseTheoryStudy},
    {"the water column", WaterColumnStudy},
};

// Checks the published tables before the studies start, which read them one by one.
absl::Status CheckPublished(const std::filesystem::path& folder) {
  for (const char* table : {"table2_wave_staff", "table3_simulated", "table4_empirical", "table5_thu_tvu"}) {
    const auto read = PublishedTable::Read(folder / (std::string(table) + ".csv"));
    if (!read.ok()) return read.status();
  }
  return absl::OkStatus();
}

// The remedy for missing figures; empty if it is not known.
std::string Remedy(const std::string& why_figures_are_missing) {
  const bool no_library = why_figures_are_missing.find("ModuleNotFoundError") != std::string::npos ||
                          why_figures_are_missing.find("No such file or directory") == 0;
  return no_library ? "; install python3-matplotlib for them" : "";
}

std::string MadeBy(const ValidateOptions& options) {
  return absl::StrCat("Made by albtpu-generate validate", options.quick ? " --quick" : "", ", version ",
                      std::string(Version()), " (", std::string(Commit()), "), seed ", options.seed, ".");
}

}  // namespace

absl::Status RunValidate(const ValidateOptions& options) {
  const std::filesystem::path data = InstalledDataDirectory() / "validation";
  const ReportOptions report{options.output, data / "plots", MadeBy(options), options.overwrite};
  if (const absl::Status status = CheckPublished(data / "paper"); !status.ok()) return status;
  if (const absl::Status status = PrepareReport(report); !status.ok()) return status;

  std::vector<Study> studies;
  for (const NamedStudy& study : kStudies) {
    std::cerr << "albtpu-generate: study " << studies.size() + 1 << " of " << std::size(kStudies) << ": "
              << study.name << '\n';
    absl::StatusOr<Study> found = study.run({data / "paper", options.quick, options.seed});
    if (!found.ok()) return found.status();
    studies.push_back(*std::move(found));
  }
  const absl::StatusOr<std::string> why_figures_are_missing = WriteReport(studies, report);
  if (!why_figures_are_missing.ok()) return why_figures_are_missing.status();
  if (!why_figures_are_missing->empty()) {
    std::cerr << "albtpu-generate: figures are missing (" << *why_figures_are_missing << ")"
              << Remedy(*why_figures_are_missing) << '\n';
  }

  for (const Verdict verdict : {Verdict::kAgrees, Verdict::kDiffers, Verdict::kReported}) {
    std::cout << Name(verdict) << ' ' << Count(studies, verdict) << '\n';
  }
  return absl::OkStatus();
}

}  // namespace albtpu::programs
