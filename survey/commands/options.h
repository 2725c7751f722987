// The options that several commands of albtpu-query have. A value that an option does not take throws
// CLI::ValidationError while arguments are parsed: bad usage, exit 2.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "command_line/cli_fwd.h"
#include "survey/answers/batch.h"
#include "survey/commands/source_options.h"
#include "survey/csv/pulse_inputs.h"
#include "survey/files/file_jobs.h"
#include "tables/file/table_io.h"

namespace albtpu::client {

// The headings under which --help lists options.
namespace group {
inline constexpr char kPulse[] = "The pulse";
inline constexpr char kBeam[] =
    "Where each beam went: by a trajectory, the returns, the scanner or one incidence";
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

// --coverage, --s44-order and --standard-errors.
void AddStyleOptions(CLI::App& command, AnswerStyle& style);

// Input and output files of an `extension`, such as ".las", --output-dir, --recursive, --resume and --overwrite.
void AddFileOptions(CLI::App& command, const std::string& extension, FileOptions& options,
                    Existing& existing);

// The style as a summary states it.
nlohmann::ordered_json Parameters(const AnswerStyle& style);

// `--wind-speed` and the like, one value for all pulses.
void AddCoordinate(CLI::App& command, AxisId axis, FixedCoordinates& fixed);

// --beam-azimuth, --wind-from, --altitude and --divergence, one value for all pulses.
void AddBeamInputs(CLI::App& command, FixedInputs& fixed);

// --wind-from alone.
void AddWindFrom(CLI::App& command, FixedInputs& fixed);

// Whether numbers below zero make sense.
enum class Sign { kAny, kNotNegative };

// A finite number. Only AddCoordinate(--fetch) takes `inf` as well.
CLI::Option* AddNumber(CLI::App& command, const std::string& flag, Sign sign, const std::string& description,
                       std::optional<double>& value);

}  // namespace albtpu::client
