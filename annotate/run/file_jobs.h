// The files that a command reads, the place of each output, and the summary beside it.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "annotate/answers/answer_counts.h"
#include "annotate/answers/json_box.h"
#include "formats/files/file_access.h"
#include "service/client/uncertainty_source.h"

namespace albtpu::annotate {

// The flags that choose files; all commands that work on files share them.
struct FileOptions {
  std::vector<std::string> files;  // IN OUT, or input files and folders.
  std::string output_folder;       // --output-dir
  bool recursive = false;          // --recursive
  bool resume = false;             // --resume
  bool json = false;               // --json
  std::string output_extension;    // Of the outputs in the folder; empty: that of each input.
};

// One file to annotate.
struct Job {
  std::filesystem::path input, output;
  bool in_subfolder = false;       // Of the output folder; the subfolder may not exist yet.
  std::filesystem::path csv = {};  // A second output, the same as CSV; empty: none.
};

// Whether neither OUT nor --output-dir says where outputs go; a folder has no OUT.
bool IsOutputMissing(const FileOptions& options);
// "give IN.las OUT.las, or ..."
std::string OutputAdvice(const std::string& extension);

// The first file; of a folder its first by name, as FindJobs takes them.
absl::StatusOr<std::string> FirstInput(const std::vector<std::string>& extensions, const FileOptions& options);

// Whether the name ends in this extension (".las"), in any case.
bool HasExtension(const std::filesystem::path& path, const std::string& extension);

// IN OUT, or every input into the output folder. A folder stands for all files in it with one of the `extensions`
// (".las"), ordered by name; with --recursive also for those in its subfolders, which are recreated in the output
// folder. Files inside the output folder are never inputs. Fails with IsUsageError when the arguments are neither of
// the two, or when two outputs would have the same name.
absl::StatusOr<std::vector<Job>> FindJobs(const std::string& command, const std::vector<std::string>& extensions,
                                          const FileOptions& options);

// 0 where it is not known.
std::uint64_t SizeOf(const std::filesystem::path& path);

// The summary beside each output, OUT.json: what was read, the parameters of the run and a summary of the answers. A
// later run reads it to decide whether the output is complete and the same as it would write itself.

// OUT.las.json
std::filesystem::path SummaryPath(const std::filesystem::path& output);

// Of files that are read beside the input, such as trajectories: the one that was modified last, or that cannot be
// found.
struct NewestFile {
  std::filesystem::path path;
  std::filesystem::file_time_type time;
};
std::optional<NewestFile> NewestOf(const std::vector<std::filesystem::path>& files);

// Everything that determines the output, apart from the input.
struct OutputSettings {
  std::string command;  // "las"
  JsonBox parameters;   // The flags, including defaults.
  client::TableSummary table;
  std::optional<NewestFile> newest = {};
};

// The results of a run over one file.
struct Findings {
  std::uint64_t input_bytes = 0, csv_bytes = 0;
  JsonBox input;                       // Further properties: points, classes.
  JsonBox output = JsonBox::Object();  // Further properties: format.
  JsonBox answers;                     // UncertaintySummary::Json().
  AnswerTally tally = {};              // The same, for the verdict.
};

// The text of a summary. It states no time, host or path, so that equal runs give equal bytes.
std::string SummaryText(const OutputSettings& settings, const Job& job, const Findings& findings,
                        std::uint64_t output_bytes);

// OK when the output of `job` exists, has the size that its summary states, was made with these settings from an input
// of this name and size, and neither the input nor a file of the settings has been modified since. Otherwise the error
// says what differs.
absl::Status CheckComplete(const OutputSettings& settings, const Job& job);

// A summary; an empty object if there is no readable one. Values that are nested more deeply than in any summary of
// ours are dropped.
nlohmann::ordered_json ReadSummary(const std::filesystem::path& path);

// The answers that the summary of the output of `job` states; null if there are none.
nlohmann::ordered_json ReadAnswers(const Job& job);

// AlreadyExists when a file that is to be kept has the name of the output or of its summary.
absl::Status CheckSummaryCanBeWritten(const Job& job, Existing existing);

// The same before the output is made, and removes a summary that a killed run left without its output.
absl::Status MakeRoomForSummary(const Job& job, Existing existing);

// Gives the output and the summary their names, both or neither: a summary never lies beside an output that it does
// not describe. `existing` applies to both.
// `csv` gets its name before them.
absl::Status CommitWithSummary(OutputFile output, const Job& job, const std::string& summary, Existing existing,
                               std::optional<OutputFile> csv = std::nullopt);

}  // namespace albtpu::annotate
