// The flags that the commands of albtpu-query share. A wrong value throws CLI::ValidationError while flags
// are parsed: bad usage, exit 2.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "survey/answers/batch.h"
#include "survey/commands/source_options.h"
#include "survey/csv/csv_pulses.h"
#include "survey/files/file_jobs.h"
#include "tables/file/table_io.h"

namespace albtpu::client {

// What every command takes. Those that write no file ignore --overwrite; `tables` ignores how answers are
// given.
struct SharedOptions {
  SourceOptions source;                 // --server, --table, --table-name, --tls-ca and the like
  AnswerStyle style;                    // --coverage, --s44-order, --standard-errors
  Existing existing = Existing::kKeep;  // --overwrite
};
void AddSharedOptions(CLI::App& command, SharedOptions& options);

// --server, which is given back, --tls-ca and the like alone.
CLI::Option* AddServerOptions(CLI::App& command, SourceOptions& options);

// Input and output files of an `extension`, such as ".las".
void AddFileOptions(CLI::App& command, const std::string& extension, FileOptions& options);

// The style for a summary.
nlohmann::ordered_json Parameters(const AnswerStyle& style);

// `--wind-speed` and the like, one value for all pulses.
void AddCoordinate(CLI::App& command, AxisId axis, FixedCoordinates& fixed);

// Whether numbers below zero make sense.
enum class Sign { kAny, kNotNegative };

// A finite number; `inf` counts as one only for --fetch, by AddCoordinate.
CLI::Option* AddNumber(CLI::App& command, const std::string& flag, Sign sign, const std::string& description,
                       std::optional<double>& value);

}  // namespace albtpu::client
