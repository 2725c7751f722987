// albtpu-serve: answers from the tables of a folder until it is told to stop.
#include <pthread.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/mutex.h"
#include "service/kept_memory.h"
#include "service/server/listen_address.h"
#include "service/server/server.h"
#include "service/server/table_catalog.h"
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
  bool insecure = false;
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
  app.add_flag("--insecure", options.insecure, "Allow plain text beyond this machine");
}

// Signals that ask to stop are waited for, in every thread that is started from here on.
sigset_t BlockStopSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

std::string Summary(const TableCatalog& catalog) {
  const std::size_t count = catalog.entries().size();
  const absl::StatusOr<const TableCatalog::Entry*> default_entry = catalog.Find("");
  return absl::StrCat(
      count, count == 1 ? " table" : " tables", ", ",
      default_entry.ok() ? absl::StrCat("default '", (*default_entry)->name, "'") : "no default");
}

int Run(const Options& options) {
  const absl::StatusOr<ListenAddress> address = ListenAddress::Parse(options.listen);
  if (!address.ok()) {
    spdlog::error("--listen: {}", std::string(address.status().message()));
    return kExitUsage;
  }
  if (!address->IsLoopback() && !options.insecure) {
    spdlog::error(
        "--listen: {} can be reached from other machines, in plain text: listen on 127.0.0.1, or give "
        "--insecure",
        address->ToString());
    return kExitUsage;
  }
  const std::filesystem::path folder =
      options.tables.has_value() ? *options.tables : DefaultTablesDirectory();
  const absl::StatusOr<TableCatalog> catalog = TableCatalog::Load(folder, options.default_table);
  if (!catalog.ok()) {
    spdlog::error("{}: {}", options.tables.has_value() ? "--tables" : "no --tables is given",
                  std::string(catalog.status().message()));
    return kExitFailure;
  }
  const sigset_t stop_signals = BlockStopSignals();
  const absl::StatusOr<std::unique_ptr<Server>> server = Server::Start(*catalog, *address);
  if (!server.ok()) {
    spdlog::error("{}", std::string(server.status().message()));
    return kExitFailure;
  }
  spdlog::info("ready on {}, {}", (*server)->address(), Summary(*catalog));
  int signal = 0;
  sigwait(&stop_signals, &signal);
  spdlog::info("draining after {}", signal == SIGINT ? "SIGINT" : "SIGTERM");
  (*server)->Drain();
  spdlog::info("stopped");
  return 0;
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
  return Run(options);
}

}  // namespace
}  // namespace albtpu::server

int main(int argc, char** argv) try {
  albtpu::KeepFreedMemory();
  // Debian's Abseil looks for cycles of locks at every lock that gRPC takes, some percent of a short call.
  absl::SetMutexDeadlockDetectionMode(absl::OnDeadlockCycle::kIgnore);
  spdlog::set_default_logger(spdlog::stderr_logger_mt("albtpu-serve"));
  spdlog::set_pattern("%n: %v");
  std::signal(SIGPIPE, SIG_IGN);  // A log that nobody reads any more does not end the server.
  return albtpu::server::ParseAndRun(argc, argv);
} catch (const std::exception& error) {
  std::fprintf(stderr, "albtpu-serve: %s\n", error.what());
  return 1;
}
