// The options that several commands of albtpu-query have. A value that an option does not take throws
// CLI::ValidationError while arguments are parsed: bad usage, exit 2.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "annotate/answers/batch.h"
#include "annotate/csv/pulse_inputs.h"
#include "annotate/run/file_jobs.h"
#include "programs/command_line/cli_fwd.h"
#include "programs/query/source_options.h"
#include "tables/file/table_io.h"

namespace albtpu::programs {

// The headings under which --help lists options.
namespace group {
inline constexpr char kPulse[] = "The pulse";
inline constexpr char kBeam[] = "Where each beam went: by a trajectory, the returns, the scanner or one incidence";
inline constexpr char kSea[] = "The sea";
inline constexpr char kTotal[] = "The total";
inline constexpr char kPoints[] = "The points";
inline constexpr char kFiles[] = "Files";
inline constexpr char kOutput[] = "Output";
inline constexpr char kSource[] = "Where answers come from";
inline constexpr char kAccess[] = "Access to the server";
}  // namespace group

// --server, which is returned, and --tls-ca and the like, which need it.
CLI::Option* AddServerOptions(CLI::App& command, SourceOptions& options);

// The same, --table and --table-name.
void AddSourceOptions(CLI::App& command, SourceOptions& options);

// Input and output files of an `extension`, such as ".las", --output-dir, --recursive, --resume and --overwrite.
void AddFileOptions(CLI::App& command, const std::string& extension, annotate::FileOptions& options,
                    Existing& existing);

// The style as a summary states it.
nlohmann::ordered_json Parameters(const annotate::AnswerStyle& style);

// `--incidence` and the like, one value for all pulses. Those of the sea have keys (survey_flags.h).
void AddInput(CLI::App& command, annotate::PulseInput input, annotate::FixedInputs& fixed);
// Of all inputs but those of the sea.
void AddInputs(CLI::App& command, annotate::FixedInputs& fixed);

// Three numbers, of the motion of the aircraft at one pulse.
void AddTriple(CLI::App& command, const std::string& flag, const std::string& type, const std::string& description,
               std::optional<std::array<double, 3>>& value);

// Whether numbers below zero make sense.
enum class Sign { kAny, kNotNegative, kPositive };

// A finite number.
CLI::Option* AddNumber(CLI::App& command, const std::string& flag, Sign sign, const std::string& description,
                       std::optional<double>& value);

}  // namespace albtpu::programs
