// The answer to a command that lacks much of what it needs: all of it at once, beside what its file says, what would be
// assumed, and a line that works.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "config/survey_draft.h"
#include "programs/command_line/cli_fwd.h"
#include "programs/query/las_options.h"

namespace albtpu::programs {

struct FirstContact {
  std::string command;                              // "las"
  std::vector<std::string> found = {};              // Lines about the file.
  std::vector<config::OpenDecision> open = {};      // What must be decided.
  std::vector<config::OpenDecision> of_total = {};  // What a total needs as well, where no sensor is named.
  std::vector<std::string> assumed = {};            // A line each.
  std::vector<std::string> example = {};            // Arguments of albtpu-query.
  std::vector<std::string> remedy = {};  // Arguments of albtpu-query that begin a survey file; empty: none do.
};

// Prints it to standard error; the UsageError is the end of it.
absl::Status Refuse(const FirstContact& contact);

// The arguments that `command` was given, as its flags and words.
std::vector<std::string> GivenArguments(const CLI::App& command);

// IN_tpu.las, in the current folder, for IN.las: the name of an output in examples.
std::string ExampleOutput(const std::string& input);

// What `las` with these options leaves open; found, assumed and example by its first file. Requires that something is.
FirstContact ContactOf(const LasOptions& options, const config::SurveySettings& settings,
                       std::vector<config::OpenDecision> open, const std::vector<std::string>& given);

// Where only one file is named and no folder for outputs.
bool IsOutputMissing(const annotate::FileOptions& files);
config::OpenDecision MissingOutput(const std::string& extension);

}  // namespace albtpu::programs
