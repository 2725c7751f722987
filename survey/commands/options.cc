#include "survey/commands/options.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "survey/number_text.h"

namespace albtpu::client {
namespace {

template <typename Number>
void CheckNumber(const std::string& flag, const std::string& text, std::optional<Number> value, Sign sign,
                 bool infinity_allowed) {
  const bool number =
      value.has_value() && (std::isfinite(*value) || (infinity_allowed && std::isinf(*value) && *value > 0));
  const std::string right =
      absl::StrCat(sign == Sign::kNotNegative ? "a number from 0 up" : "a finite number",
                   infinity_allowed ? ", or inf," : "", " is right");
  if (!number) throw CLI::ValidationError(flag, absl::StrCat("'", text, "': ", right));
  if (sign == Sign::kNotNegative && *value < 0) {
    throw CLI::ValidationError(flag, absl::StrCat(text, " is negative: ", right));
  }
}

// Validators of CLI11 answer with what is wrong, or with nothing.
std::string CheckNotEmpty(const std::string& text) { return text.empty() ? "is empty: a name is right" : ""; }

std::string CheckHostAndPort(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  int port = 0;
  const bool number = colon != std::string::npos && colon > 0 &&
                      absl::SimpleAtoi(absl::string_view(text).substr(colon + 1), &port);
  if (number && port > 0 && port <= 65535) return "";
  return absl::StrCat("'", text, "': HOST:PORT is right, such as 127.0.0.1:50051");
}

const char* DescribeFlag(AxisId axis) {
  switch (axis) {
    case AxisId::kWindSpeed:
      return "Wind speed at 10 m [m/s]";
    case AxisId::kFetch:
      return "Fetch [m], or inf; left out: fully developed";
    case AxisId::kIncidence:
      return "Angle of the beam from the vertical, in air [degree]";
    case AxisId::kAzimuth:
      return "Horizontal direction of the beam from downwind [degree]; left out: the worse of along and "
             "across";
    case AxisId::kFootprint:
      return "Diameter of the beam at the mean surface, across its axis [m]";
    case AxisId::kDepth:
      return "Depth below the surface [m]";
  }
  return "";
}

// Each of them means TLS.
void AddCredentialOptions(CLI::App& command, CLI::Option* server, Credentials& credentials) {
  const auto add = [&](const char* flag, std::string& path, const char* description) {
    return command.add_option(flag, path, description)
        ->type_name("FILE")
        ->check(CheckNotEmpty)
        ->needs(server);
  };
  add("--tls-ca", credentials.ca, "Talk TLS; these authorities vouch for the server (PEM)");
  CLI::Option* certificate =
      add("--tls-cert", credentials.certificate, "Talk TLS; show this certificate (PEM)");
  CLI::Option* key = add("--tls-key", credentials.key, "Its key (PEM)");
  certificate->needs(key);
  key->needs(certificate);
  add("--token-file", credentials.token, "Talk TLS; send the token in this file with every call");
}

void AddTableOptions(CLI::App& command, CLI::Option* server, SourceOptions& options) {
  command.add_option("--table", options.file, "Answer from this table file, without a server")
      ->type_name("FILE.h5")
      ->check(CheckNotEmpty)
      ->excludes(server);
  command
      .add_option("--table-name", options.name,
                  "Which of the tables, by name or NAME/VERSION; left out: the default")
      ->type_name("NAME")
      ->check(CheckNotEmpty);
}

void AddStyleOptions(CLI::App& command, AnswerStyle& style) {
  command
      .add_option_function<std::string>(
          "--coverage",
          [&style](const std::string& text) {
            if (text != "2sigma" && text != "p95") {
              throw CLI::ValidationError("--coverage", "'" + text + "': 2sigma or p95 is right");
            }
            style.coverage = text == "p95" ? Coverage::kP95 : Coverage::kTwoSigma;
          },
          "2sigma (twice the standard deviation, default) or p95 (95 %)")
      ->type_name("2sigma|p95");
  command
      .add_option_function<std::string>(
          "--s44-order",
          [&style](const std::string& text) {
            style.s44_order = FindS44Order(text);
            if (style.s44_order.has_value()) return;
            throw CLI::ValidationError("--s44-order",
                                       "'" + text + "': exclusive, special, 1a, 1b or 2 is right");
          },
          "Compare with this order of IHO S-44")
      ->type_name("ORDER");
}

void AddOverwrite(CLI::App& command, Existing& existing) {
  command.add_flag_callback(
      "--overwrite", [&existing] { existing = Existing::kReplace; }, "Replace an output that exists");
}

}  // namespace

CLI::Option* AddServerOptions(CLI::App& command, SourceOptions& options) {
  CLI::Option* server =
      command
          .add_option("--server", options.server,
                      "Ask the service at HOST:PORT, or at dns:///NAME:PORT all servers of a name in turn")
          ->type_name("HOST:PORT")
          ->check(CheckHostAndPort);
  AddCredentialOptions(command, server, options.credentials);
  return server;
}

void AddSharedOptions(CLI::App& command, SharedOptions& options) {
  AddTableOptions(command, AddServerOptions(command, options.source), options.source);
  AddStyleOptions(command, options.style);
  command.add_flag_callback(
      "--standard-errors", [&options] { options.style.standard_errors = true; },
      "Give the standard error of each value too");
  AddOverwrite(command, options.existing);
}

void AddFileOptions(CLI::App& command, const std::string& extension, FileOptions& options) {
  command
      .add_option("files", options.files,
                  absl::StrCat("IN", extension, " OUT", extension,
                               ", or with --output-dir any number of inputs and folders of them"))
      ->required()
      ->type_name("FILE" + extension);
  command
      .add_option("--output-dir", options.output_folder, "Write each output here, by the name of its input")
      ->type_name("DIR");
  command.add_flag("--recursive", options.recursive,
                   "With a folder, also the files of its subfolders, which --output-dir repeats");
  command.add_flag("--resume", options.resume,
                   "Leave outputs that are whole and were made of the same input, parameters and table, by "
                   "the summaries beside them");
}

nlohmann::ordered_json Parameters(const AnswerStyle& style) {
  nlohmann::ordered_json json;
  json["coverage"] = CoverageText(style.coverage);
  json["s44_order"] = nullptr;
  if (style.s44_order.has_value()) json["s44_order"] = std::string(Name(*style.s44_order));
  json["standard_errors"] = style.standard_errors;
  return json;
}

void AddCoordinate(CLI::App& command, AxisId axis, FixedCoordinates& fixed) {
  const Sign sign = axis == AxisId::kAzimuth ? Sign::kAny : Sign::kNotNegative;
  command
      .add_option_function<std::string>(
          FlagName(axis),
          [axis, sign, &fixed](const std::string& text) {
            const std::optional<float> value = ParseFloat(text);
            CheckNumber(FlagName(axis), text, value, sign, axis == AxisId::kFetch);
            fixed[Index(axis)] = value;
          },
          DescribeFlag(axis))
      ->type_name("NUMBER");
}

CLI::Option* AddNumber(CLI::App& command, const std::string& flag, Sign sign, const std::string& description,
                       std::optional<double>& value) {
  return command
      .add_option_function<std::string>(
          flag,
          [flag, sign, &value](const std::string& text) {
            const std::optional<double> parsed = ParseDouble(text);
            CheckNumber(flag, text, parsed, sign, false);
            value = parsed;
          },
          description)
      ->type_name("NUMBER");
}

}  // namespace albtpu::client
