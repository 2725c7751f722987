// albtpu-serve: serves the tables of a folder over gRPC until a signal stops it.
#include <pthread.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/mutex.h"
#include "formats/text/text.h"
#include "programs/command_line/command_line.h"
#include "programs/command_line/manual.h"
#include "service/server/access/credentials.h"
#include "service/server/ground/limits.h"
#include "service/server/ground/listening_sockets.h"
#include "service/server/observe/log.h"
#include "service/server/observe/metric_collectors.h"
#include "service/server/observe/metrics.h"
#include "service/server/server.h"
#include "service/server/tables/table_catalog.h"
#include "status/status_macros.h"
#include "tables/default_tables.h"
#include "tables/file/table_folder.h"
#include "tables/version.h"

namespace albtpu::programs {
namespace {

struct Options {
  std::optional<std::filesystem::path> tables;
  std::string default_table;
  std::optional<std::filesystem::path> water_table;
  std::string listen = "127.0.0.1:50051";
  std::optional<std::string> metrics;
  long long max_stream_idle = server::kMaxStreamIdle.count();
  bool log_json = false;
  server::CredentialFiles credentials = {};
  bool insecure = false;
};

// --tls-cert, --tls-key, --tls-client-ca, --token-file and --insecure.
void AddCredentialFlags(CLI::App& app, Options& options) {
  server::CertificateFiles& certificates = options.credentials.certificates;
  const auto add_file = [&app](const char* flag, std::filesystem::path& path, const char* description) {
    return app.add_option(flag, path, description)->type_name("FILE")->check(NotEmpty("file"));
  };
  CLI::Option* certificate =
      add_file("--tls-cert", certificates.certificate,
               "Use TLS with this certificate and its intermediate certificates (PEM); read again when it changes");
  CLI::Option* key = add_file("--tls-key", certificates.key, "Key of the certificate (PEM, no passphrase)");
  certificate->needs(key);
  key->needs(certificate);
  add_file("--tls-client-ca", certificates.client_ca, "Refuse clients without a certificate of these authorities (PEM)")
      ->needs(certificate);
  add_file("--token-file", options.credentials.tokens, "Refuse calls without one of these tokens, one per line")
      ->needs(certificate);
  app.add_flag("--insecure", options.insecure,
               "Allow plain text beyond this machine, for the service without TLS and for --metrics");
  Group(app, "Access to the server", {"--tls-cert", "--tls-key", "--tls-client-ca", "--token-file", "--insecure"});
}

void AddFlags(CLI::App& app, Options& options) {
  SetUpProgram(app, Version(), Commit(), [] { return DigestsText(DefaultTablesDirectory()); });
  AddManualFlags(app, std::string(Version()));
  app.add_option("--tables", options.tables,
                 "Folder of tables, NAME.h5 and NAME/VERSION.h5 (default: $ALBTPU_TABLES, else the installed tables)")
      ->type_name("DIR");
  app.add_option("--default-table", options.default_table,
                 "Table for requests that name none (default: survey, else the only one)")
      ->type_name("NAME");
  app.add_option(
         "--water-table", options.water_table,
         "Table of the water column, for requests with a water (default: $ALBTPU_WATER_TABLE, else the installed "
         "table; without one, such requests fail)")
      ->type_name("FILE")
      ->check(NotEmpty("file"));
  app.add_option("--listen", options.listen, "Address to listen on; port 0 takes any free port")
      ->type_name("HOST:PORT")
      ->capture_default_str();
  app.add_option("--metrics", options.metrics,
                 "Address on which to serve metrics to Prometheus, http://HOST:PORT/metrics")
      ->type_name("HOST:PORT");
  app.add_option("--max-stream-idle", options.max_stream_idle,
                 "End a stream after this time in which its caller neither sends nor reads")
      ->type_name("SECONDS")
      ->check(WholeIn(1, 3600))
      ->capture_default_str();
  app.add_flag("--log-json", options.log_json, "Log one JSON object per line");
  AddCredentialFlags(app, options);
  Group(app, "Tables", {"--tables", "--default-table", "--water-table"});
  Group(app, "Addresses", {"--listen", "--metrics"});
  Group(app, "Limits", {"--max-stream-idle"});
  Group(app, "Log", {"--log-json"});
  EndHelp(app,
          "SIGHUP reloads the tables; SIGTERM and SIGINT finish the calls under way and stop.\n"
          "Exit code: 0 after a signal to stop, 2 for bad usage, 1 for a failure.",
          "--tables tables --metrics 127.0.0.1:9464",
          "--tables tables --listen 0.0.0.0:50051 --tls-cert server.pem --tls-key server.key --token-file "
          "tokens");
}

// Blocks the signals of the server in all threads started from here on; WaitForStop() receives them.
sigset_t BlockSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

// Waits for SIGTERM or SIGINT and returns it. Until then each SIGHUP reloads the tables.
int WaitForStop(const sigset_t& signals, server::LiveTables& tables) {
  while (true) {
    const int signal = sigwaitinfo(&signals, nullptr);
    if (signal == SIGHUP)
      tables.Reload([](const server::LiveTables::ReloadResult&) {});
    else if (signal > 0)
      return signal;
  }
}

std::string Summary(const server::TableCatalog& catalog) {
  const std::size_t count = catalog.entries().size();
  const absl::StatusOr<const server::TableCatalog::Entry*> default_entry = catalog.Find("");
  return absl::StrCat(count, count == 1 ? " table" : " tables", ", ",
                      default_entry.ok() ? absl::StrCat("default '", (*default_entry)->name, "'") : "no default");
}

int Fail(int exit_code, const absl::Status& status) {
  spdlog::error("{}", std::string(status.message()));
  return exit_code;
}

// The same status with the flag before its message.
absl::Status WithFlag(const char* flag, const absl::Status& status) {
  return status.ok() ? status : absl::Status(status.code(), absl::StrCat(flag, ": ", status.message()));
}

// The addresses given by flags.
struct Addresses {
  server::ListenAddress service;
  std::optional<server::ListenAddress> metrics;
};

// The address that a flag gives. InvalidArgument if other machines could reach it in `plain_text` and --insecure is not
// given; `remedy` is another way out.
absl::StatusOr<server::ListenAddress> ReadAddress(const char* flag, const std::string& text, bool plain_text,
                                                  bool insecure, const char* remedy) {
  absl::StatusOr<server::ListenAddress> address = server::ListenAddress::Parse(text);
  if (!address.ok()) return WithFlag(flag, address.status());
  if (!plain_text || address->IsLoopback() || insecure) return address;
  return absl::InvalidArgumentError(absl::StrCat(flag, ": ", address->ToString(),
                                                 " can be reached from other machines in plain text; ", remedy,
                                                 "listen on 127.0.0.1, or give --insecure"));
}

absl::StatusOr<Addresses> ReadAddresses(const Options& options) {
  ASSIGN_OR_RETURN(const server::ListenAddress service,
                   ReadAddress("--listen", options.listen, !options.credentials.HasTls(), options.insecure,
                               "give --tls-cert and --tls-key, "));
  if (!options.metrics.has_value()) return Addresses{service, std::nullopt};
  // Metrics are always in plain text.
  ASSIGN_OR_RETURN(const server::ListenAddress metrics,
                   ReadAddress("--metrics", *options.metrics, true, options.insecure, ""));
  return Addresses{service, metrics};
}

server::Access MakeAccess(const server::CredentialFiles& files, std::shared_ptr<grpc::ServerCredentials> credentials) {
  const bool callers_are_authenticated = !files.tokens.empty() || !files.certificates.client_ca.empty();
  return {std::move(credentials),
          callers_are_authenticated ? server::AdminCallers::kAll : server::AdminCallers::kLocal};
}

// Serves until a signal stops it; returns the exit code.
int Serve(server::TableCatalog catalog, const Addresses& addresses, server::Access access,
          std::chrono::seconds max_stream_idle, server::ServerMetrics& metrics, const server::Recorders& recorders,
          const sigset_t& signals) {
  server::LiveTables tables(std::move(catalog), [&metrics](const server::LiveTables::ReloadResult& result) {
    metrics.reloads.Count(result);
    server::LogReload(result);
  });
  const auto table_metrics = std::make_shared<server::TableMetrics>(tables);
  std::unique_ptr<server::MetricsEndpoint> endpoint;
  if (addresses.metrics.has_value()) {
    absl::StatusOr<std::unique_ptr<server::MetricsEndpoint>> started =
        server::MetricsEndpoint::Start(*addresses.metrics, {metrics.registry, table_metrics, metrics.process});
    if (!started.ok()) return Fail(formats::kExitFailure, WithFlag("--metrics", started.status()));
    endpoint = *std::move(started);
  }
  const absl::StatusOr<std::unique_ptr<server::Server>> server =
      server::Server::Start(tables, recorders, addresses.service, std::move(access), max_stream_idle);
  if (!server.ok()) return Fail(formats::kExitFailure, server.status());
  spdlog::info("ready on {}, {}", (*server)->address(), Summary(*tables.current()));
  if (tables.current()->water() == nullptr)
    spdlog::info("no table of the water column: requests with a water will fail");
  if (endpoint != nullptr) spdlog::info("metrics on http://{}/metrics", endpoint->address());
  const int signal = WaitForStop(signals, tables);
  spdlog::info("draining after {}", signal == SIGINT ? "SIGINT" : "SIGTERM");
  (*server)->Drain();
  spdlog::info("stopped");
  return 0;
}

// Adds the table of the water column that the flag or the environment names, or the installed one; none if nothing
// names one and none is installed.
absl::Status AddWater(const Options& options, server::TableCatalog& catalog) {
  const std::filesystem::path path = options.water_table.has_value() ? *options.water_table : WaterTablePath();
  if (path == InstalledWaterTable() && !std::filesystem::exists(path)) return absl::OkStatus();
  return WithFlag(options.water_table.has_value() ? "--water-table" : "no --water-table given", catalog.AddWater(path));
}

int Run(const Options& options) {
  const absl::StatusOr<Addresses> addresses = ReadAddresses(options);
  if (!addresses.ok()) return Fail(formats::kExitUsage, addresses.status());
  const sigset_t signals = BlockSignals();
  server::ServerMetrics metrics;
  server::CallLog call_log;
  const server::Recorders recorders = {metrics.calls, metrics.access, metrics.seas, metrics.waters, call_log};
  // After BlockSignals(): this starts threads of gRPC, which must not receive the signals.
  const absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> credentials =
      server::MakeCredentials(options.credentials, recorders);
  if (!credentials.ok()) return Fail(formats::kExitFailure, credentials.status());
  const std::filesystem::path folder = options.tables.has_value() ? *options.tables : DefaultTablesDirectory();
  absl::StatusOr<server::TableCatalog> catalog = server::TableCatalog::Load(folder, options.default_table);
  if (!catalog.ok()) {
    return Fail(formats::kExitFailure,
                WithFlag(options.tables.has_value() ? "--tables" : "no --tables given", catalog.status()));
  }
  const absl::Status water = AddWater(options, *catalog);
  if (!water.ok()) return Fail(formats::kExitFailure, water);
  return Serve(*std::move(catalog), *addresses, MakeAccess(options.credentials, *credentials),
               std::chrono::seconds(options.max_stream_idle), metrics, recorders, signals);
}

int ParseAndRun(int argc, char** argv) {
  Options options;
  CLI::App app("Serves the uncertainty of lidar pulses from tables over gRPC (albtpu.v1).", "albtpu-serve");
  AddFlags(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    spdlog::error("{}", UsageMessage(app, error));
    return formats::kExitUsage;
  }
  if (options.log_json) spdlog::set_formatter(server::MakeLogFormatter(server::LogStyle::kJson));
  return Run(options);
}

}  // namespace
}  // namespace albtpu::programs

int main(int argc, char** argv) try {
  // Debian's Abseil checks for deadlocks whenever gRPC takes a lock, which costs a few percent of a short call.
  absl::SetMutexDeadlockDetectionMode(absl::OnDeadlockCycle::kIgnore);
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("albtpu-serve", albtpu::server::MakeLogSink(STDERR_FILENO)));
  spdlog::set_formatter(albtpu::server::MakeLogFormatter(albtpu::server::LogStyle::kText));
  // A closed log, or one that has reached its maximum size, must not stop the server.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  return albtpu::programs::ParseAndRun(argc, argv);
} catch (const std::exception& error) {
  std::fprintf(stderr, "albtpu-serve: %s\n", error.what());
  return 1;
}
