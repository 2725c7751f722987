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
#include "programs/serve/credential_flags.h"
#include "service/server/ground/limits.h"
#include "service/server/ground/listening_sockets.h"
#include "service/server/observe/log.h"
#include "service/server/observe/metric_collectors.h"
#include "service/server/observe/metrics.h"
#include "service/server/server.h"
#include "service/server/tables/table_catalog.h"
#include "tables/default_tables.h"
#include "tables/version.h"

namespace albtpu::programs {
namespace {

struct Options {
  std::optional<std::filesystem::path> tables;
  std::string default_table;
  std::string listen = "127.0.0.1:50051";
  std::optional<std::string> metrics;
  long long max_stream_idle = server::kMaxStreamIdle.count();
  bool log_json = false;
  CredentialFlags credentials;
};

void AddFlags(CLI::App& app, Options& options) {
  SetUpProgram(app, Version(), Commit());
  app.add_option("--tables", options.tables,
                 "Folder of tables, NAME.h5 and NAME/VERSION.h5 (default: $ALBTPU_TABLES, else the installed tables)")
      ->type_name("DIR");
  app.add_option("--default-table", options.default_table,
                 "Table for requests that name none (default: survey, else the only one)")
      ->type_name("NAME");
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
  AddCredentialFlags(app, options.credentials);
  Group(app, "Tables", {"--tables", "--default-table"});
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

absl::StatusOr<Addresses> ReadAddresses(const Options& options) {
  const absl::StatusOr<server::ListenAddress> service = server::ListenAddress::Parse(options.listen);
  if (!service.ok()) return WithFlag("--listen", service.status());
  const absl::Status service_status = CheckServiceAddress(*service, options.credentials);
  if (!service_status.ok()) return service_status;
  if (!options.metrics.has_value()) return Addresses{*service, std::nullopt};
  const absl::StatusOr<server::ListenAddress> metrics = server::ListenAddress::Parse(*options.metrics);
  if (!metrics.ok()) return WithFlag("--metrics", metrics.status());
  const absl::Status metrics_status = CheckMetricsAddress(*metrics, options.credentials);
  if (!metrics_status.ok()) return metrics_status;
  return Addresses{*service, *metrics};
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
  if (endpoint != nullptr) spdlog::info("metrics on http://{}/metrics", endpoint->address());
  const int signal = WaitForStop(signals, tables);
  spdlog::info("draining after {}", signal == SIGINT ? "SIGINT" : "SIGTERM");
  (*server)->Drain();
  spdlog::info("stopped");
  return 0;
}

int Run(const Options& options) {
  const absl::StatusOr<Addresses> addresses = ReadAddresses(options);
  if (!addresses.ok()) return Fail(formats::kExitUsage, addresses.status());
  const sigset_t signals = BlockSignals();
  server::ServerMetrics metrics;
  server::CallLog call_log;
  const server::Recorders recorders = {metrics.calls, metrics.access, metrics.seas, call_log};
  const server::CredentialFiles& files = options.credentials.files;
  // After BlockSignals(): this starts threads of gRPC, which must not receive the signals.
  const absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> credentials =
      server::MakeCredentials(files, recorders);
  if (!credentials.ok()) return Fail(formats::kExitFailure, credentials.status());
  const std::filesystem::path folder = options.tables.has_value() ? *options.tables : DefaultTablesDirectory();
  absl::StatusOr<server::TableCatalog> catalog = server::TableCatalog::Load(folder, options.default_table);
  if (!catalog.ok()) {
    return Fail(formats::kExitFailure,
                WithFlag(options.tables.has_value() ? "--tables" : "no --tables given", catalog.status()));
  }
  return Serve(*std::move(catalog), *addresses, MakeAccess(files, *credentials),
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
