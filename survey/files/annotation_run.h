// The files of one run of a command, one after the other.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "service/client/uncertainty_source.h"
#include "survey/files/file_jobs.h"
#include "survey/files/output_file.h"
#include "survey/files/progress.h"
#include "survey/files/summary_file.h"

namespace albtpu::client {

// A file that is done but for its name.
struct AnnotatedFile {
  OutputFile file;
  Findings findings;
  std::string text;  // For people; behind the name of the output.
};

struct AnnotationRun {
  std::string command;                // "las"
  std::string records;                // What its files hold, for people: "points".
  nlohmann::ordered_json parameters;  // All that decides what is written, beside input and table.
  bool resume = false;                // Leave outputs that are made already.
  Existing existing = Existing::kKeep;
  std::function<absl::StatusOr<AnnotatedFile>(const Job&, Progress&)> annotate;
};

// Annotates every file and writes a summary beside each output; `table` is the one that answers. A file that
// fails does not keep the others from being annotated, unless the source fails: then nothing more can be
// answered, and the message says how many are done.
absl::Status AnnotateFiles(const std::vector<Job>& jobs, const AnnotationRun& run, const TableSummary& table);

}  // namespace albtpu::client
