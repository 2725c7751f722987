// albtpu-serve: answers from the tables of a folder until it is told to stop.
#include <pthread.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
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
#include "service/server/access/credential_flags.h"
#include "service/server/ground/limits.h"
#include "service/server/ground/listen_address.h"
#include "service/server/observe/call_log.h"
#include "service/server/observe/log.h"
#include "service/server/observe/metrics_endpoint.h"
#include "service/server/observe/reload_log.h"
#include "service/server/observe/server_metrics.h"
#include "service/server/observe/table_metrics.h"
#include "service/server/server.h"
#include "service/server/tables/live_tables.h"
#include "service/server/tables/table_catalog.h"
#include "tables/default_tables.h"
#include "tables/version.h"

namespace albtpu::server {
namespace {

constexpr int kExitFailure = 1;
constexpr int kExitUsage = 2;

struct Options {
  std::optional<std::filesystem::path> tables;
  std::string default_table;
  std::string listen = "127.0.0.1:50051";
  std::optional<std::string> metrics;
  bool log_json = false;
  CredentialFlags credentials;
};

void AddFlags(CLI::App& app, Options& options) {
  app.set_version_flag(
      "--version", absl::StrCat("albtpu-serve ", std::string(Version()), " (", std::string(Commit()), ")"));
  app.add_option(
         "--tables", options.tables,
         "Folder of tables, NAME.h5 and NAME/VERSION.h5 (default: $ALBTPU_TABLES, else those installed)")
      ->type_name("DIR");
  app.add_option("--default-table", options.default_table,
                 "Table for requests that name none (default: survey, else the only one)")
      ->type_name("NAME");
  app.add_option("--listen", options.listen, "Address to listen on; port 0 takes any free port")
      ->type_name("HOST:PORT")
      ->capture_default_str();
  app.add_option("--metrics", options.metrics, "Address of metrics for Prometheus, http://HOST:PORT/metrics")
      ->type_name("HOST:PORT");
  app.add_flag("--log-json", options.log_json, "Log one JSON object a line");
  AddCredentialFlags(app, options.credentials);
}

// Signals that tell the server something are waited for, in every thread that is started from here on.
sigset_t BlockSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

// Returns the signal that asks to stop; meanwhile each SIGHUP reloads the tables.
int WaitForStop(const sigset_t& signals, LiveTables& tables) {
  while (true) {
    const int signal = sigwaitinfo(&signals, nullptr);
    if (signal == SIGHUP) {
      tables.Reload([](const LiveTables::Outcome&) {});
    } else if (signal > 0) {
      return signal;
    }
  }
}

std::string Summary(const TableCatalog& catalog) {
  const std::size_t count = catalog.entries().size();
  const absl::StatusOr<const TableCatalog::Entry*> default_entry = catalog.Find("");
  return absl::StrCat(
      count, count == 1 ? " table" : " tables", ", ",
      default_entry.ok() ? absl::StrCat("default '", (*default_entry)->name, "'") : "no default");
}

int Fail(int exit_code, const absl::Status& status) {
  spdlog::error("{}", std::string(status.message()));
  return exit_code;
}

absl::Status About(const char* flag, const absl::Status& status) {
  return status.ok() ? status : absl::Status(status.code(), absl::StrCat(flag, ": ", status.message()));
}

// Where to listen, as flags say it.
struct Addresses {
  ListenAddress service;
  std::optional<ListenAddress> metrics;
};

absl::StatusOr<Addresses> ReadAddresses(const Options& options) {
  const absl::StatusOr<ListenAddress> service = ListenAddress::Parse(options.listen);
  if (!service.ok()) return About("--listen", service.status());
  const absl::Status reach = CheckReach(*service, options.credentials);
  if (!reach.ok()) return reach;
  if (!options.metrics.has_value()) return Addresses{*service, std::nullopt};
  const absl::StatusOr<ListenAddress> metrics = ListenAddress::Parse(*options.metrics);
  if (!metrics.ok()) return About("--metrics", metrics.status());
  const absl::Status metrics_reach = CheckReachOfMetrics(*metrics, options.credentials);
  if (!metrics_reach.ok()) return metrics_reach;
  return Addresses{*service, *metrics};
}

Access AccessBy(const CredentialFiles& files, std::shared_ptr<grpc::ServerCredentials> credentials) {
  const bool callers_are_known = !files.tokens.empty() || !files.certificates.client_ca.empty();
  return {std::move(credentials), callers_are_known ? AdminCallers::kAll : AdminCallers::kOfThisMachine};
}

// Until a signal asks to stop.
int Serve(TableCatalog catalog, const Addresses& addresses, Access access, ServerMetrics& metrics,
          const CallRecords& records, const sigset_t& signals) {
  LiveTables tables(std::move(catalog), [&metrics](const LiveTables::Outcome& outcome) {
    metrics.reloads.Count(outcome);
    LogReload(outcome);
  });
  const auto table_metrics = std::make_shared<TableMetrics>(tables);
  std::unique_ptr<MetricsEndpoint> endpoint;
  if (addresses.metrics.has_value()) {
    absl::StatusOr<std::unique_ptr<MetricsEndpoint>> started =
        MetricsEndpoint::Start(*addresses.metrics, {metrics.registry, table_metrics, metrics.process});
    if (!started.ok()) return Fail(kExitFailure, About("--metrics", started.status()));
    endpoint = *std::move(started);
  }
  const absl::StatusOr<std::unique_ptr<Server>> server =
      Server::Start(tables, records, addresses.service, std::move(access));
  if (!server.ok()) return Fail(kExitFailure, server.status());
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
  if (!addresses.ok()) return Fail(kExitUsage, addresses.status());
  const sigset_t signals = BlockSignals();
  ServerMetrics metrics;
  CallLog call_log;
  const CallRecords records = {metrics.calls, metrics.access, call_log};
  const CredentialFiles& files = options.credentials.files;
  // Starts threads of gRPC, which must not take the signals.
  const absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> credentials =
      MakeCredentials(files, records);
  if (!credentials.ok()) return Fail(kExitFailure, credentials.status());
  const std::filesystem::path folder =
      options.tables.has_value() ? *options.tables : DefaultTablesDirectory();
  absl::StatusOr<TableCatalog> catalog = TableCatalog::Load(folder, options.default_table);
  if (!catalog.ok()) {
    return Fail(kExitFailure,
                About(options.tables.has_value() ? "--tables" : "no --tables is given", catalog.status()));
  }
  return Serve(*std::move(catalog), *addresses, AccessBy(files, *credentials), metrics, records, signals);
}

int ParseAndRun(int argc, char** argv) {
  Options options;
  CLI::App app("Answers with the uncertainty of lidar pulses from tables, over gRPC (albtpu.v1).",
               "albtpu-serve");
  AddFlags(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    spdlog::error("{}: --help lists the flags", error.what());
    return kExitUsage;
  }
  if (options.log_json) spdlog::set_formatter(MakeLogFormatter(LogStyle::kJson));
  return Run(options);
}

}  // namespace
}  // namespace albtpu::server

int main(int argc, char** argv) try {
  // Debian's Abseil looks for cycles of locks at every lock that gRPC takes, some percent of a short call.
  absl::SetMutexDeadlockDetectionMode(absl::OnDeadlockCycle::kIgnore);
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("albtpu-serve", albtpu::server::MakeLogSink(STDERR_FILENO)));
  spdlog::set_formatter(albtpu::server::MakeLogFormatter(albtpu::server::LogStyle::kText));
  // Neither a log that nobody reads any more nor one that may not grow ends the server.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  return albtpu::server::ParseAndRun(argc, argv);
} catch (const std::exception& error) {
  std::fprintf(stderr, "albtpu-serve: %s\n", error.what());
  return 1;
}
