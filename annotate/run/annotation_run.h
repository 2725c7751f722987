// One run of a command over its files, one file after the other.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "annotate/answers/run_verdict.h"
#include "annotate/run/file_jobs.h"
#include "annotate/run/file_progress.h"
#include "formats/files/file_access.h"
#include "service/client/uncertainty_source.h"

namespace albtpu::annotate {

// A complete output without its final name.
struct AnnotatedFile {
  OutputFile file;
  Findings findings;
  std::string text;                    // For the user; printed after the name of the output.
  std::optional<OutputFile> csv = {};  // Of Job::csv.
};

struct AnnotationRun {
  std::string command;                            // "las"
  std::string records, record;                    // What the files contain, for the user: "points", "chosen point".
  JsonBox parameters;                             // Everything that determines the output, apart from input and table.
  std::vector<std::filesystem::path> files = {};  // Read beside the inputs.
  bool resume = false;                            // Keep outputs that are already complete.
  Existing existing = Existing::kKeep;
  bool json = false;  // Print the summary of each output that is written or kept, a line each, on standard output.
  std::function<absl::StatusOr<AnnotatedFile>(const Job&, FileProgress&)> annotate;
  CauseContext cause = {};  // The inputs of the coordinates, for the verdict.
};

// Annotates every file with `table`, the table of the source, and writes a summary beside each output. When one file
// fails, the others are still annotated. When the source fails, no further file can be annotated: the run ends, and
// the message says how many files are done. Afterwards the run fails by its RunVerdict, and prints its notes.
absl::Status AnnotateFiles(const std::vector<Job>& jobs, const AnnotationRun& run, const client::TableSummary& table);

}  // namespace albtpu::annotate
