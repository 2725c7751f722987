#include "programs/query/source_options.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "absl/strings/str_cat.h"
#include "annotate/answers/uncertainty_summary.h"
#include "annotate/run/file_progress.h"
#include "annotate/seas/sea_facts.h"
#include "sea/sea_time.h"
#include "service/client/local_source.h"
#include "service/client/server_source.h"
#include "status/status_macros.h"
#include "tables/default_tables.h"
#include "tables/file/table_folder.h"
#include "tables/file/table_io.h"

namespace albtpu::programs {
namespace {

absl::Status CheckName(const SourceOptions& options) {
  if (options.file.empty() || options.name.empty()) return absl::OkStatus();
  return formats::UsageError("--table-name cannot be used with --table (a file holds one table); leave it out");
}

absl::StatusOr<std::unique_ptr<client::UncertaintySource>> OpenFile(std::string name, const std::filesystem::path& path,
                                                                    double index) {
  ASSIGN_OR_RETURN(UncertaintyTable table, ReadTable(path));
  return std::unique_ptr<client::UncertaintySource>(new client::LocalSource(std::move(name), std::move(table), index));
}

// Adds the other ways to choose a table, for when no installed table answers.
absl::Status Advised(const absl::Status& status) {
  return absl::Status(status.code(),
                      absl::StrCat(status.message(),
                                   "; choose one with --table-name, a file with --table, a service with --server, or "
                                   "a folder of tables with $ALBTPU_TABLES"));
}

absl::StatusOr<std::vector<TableFile>> InstalledTables() {
  absl::StatusOr<std::vector<TableFile>> tables = FindTables(DefaultTablesDirectory());
  if (!tables.ok()) return Advised(tables.status());
  return tables;
}

// Without a name, the only table that is not a published one is chosen; this takes reading them.
absl::StatusOr<std::size_t> ChooseTable(std::vector<TableFile> tables, const std::string& name) {
  absl::StatusOr<std::size_t> chosen = FindTable(tables, name);
  if (chosen.ok() || !name.empty()) return chosen;
  for (TableFile& file : tables) {
    const absl::StatusOr<UncertaintyTable> table = ReadTable(file.path);
    file.published = table.ok() && table->is_published();
  }
  return FindTable(tables, name);
}

absl::StatusOr<std::vector<client::TableSummary>> ListInstalledTables() {
  ASSIGN_OR_RETURN(const std::vector<TableFile> files, InstalledTables());
  const absl::StatusOr<std::size_t> standard = ChooseTable(files, "");
  std::vector<client::TableSummary> tables;
  for (std::size_t i = 0; i < files.size(); ++i) {
    ASSIGN_OR_RETURN(const UncertaintyTable table, ReadTable(files[i].path));
    tables.push_back(client::Summarize(files[i].FullName(), table));
    tables.back().is_default = standard.ok() && *standard == i;
  }
  return tables;
}

bool HasName(const client::TableSummary& table, const std::string& name) {
  return table.name == name || table.name.substr(0, table.name.find('/')) == name;
}

}  // namespace

absl::StatusOr<std::unique_ptr<client::UncertaintySource>> OpenSource(const SourceOptions& options, double index) {
  RETURN_IF_ERROR(CheckName(options));
  if (!options.file.empty()) return OpenFile("", options.file, index);
  if (!options.server.empty()) return client::OpenServer(options.server, options.name, {}, options.credentials, index);
  ASSIGN_OR_RETURN(const std::vector<TableFile> tables, InstalledTables());
  const absl::StatusOr<std::size_t> chosen = ChooseTable(tables, options.name);
  if (!chosen.ok()) return Advised(chosen.status());
  return OpenFile(tables[*chosen].FullName(), tables[*chosen].path, index);
}

absl::StatusOr<std::unique_ptr<client::SeaSources>> OpenSeaSources(const SourceOptions& options, double index) {
  for (const auto& [flag, value] : {std::pair("--table", &options.file), {"--table-name", &options.name}}) {
    if (value->empty()) continue;
    return formats::UsageError(absl::StrCat(flag,
                                            " cannot be used with a sea (its table is compiled from its waves); leave "
                                            "out one of them"));
  }
  if (options.server.empty()) return client::LocalSeas(index);
  return client::ServerSeas(options.server, {}, options.credentials, index);
}

absl::StatusOr<std::vector<client::TableSummary>> ListTables(const SourceOptions& options) {
  RETURN_IF_ERROR(CheckName(options));
  std::vector<client::TableSummary> tables;
  if (!options.server.empty()) {
    ASSIGN_OR_RETURN(tables, client::ListServerTables(options.server, options.credentials));
  } else if (!options.file.empty()) {
    ASSIGN_OR_RETURN(const std::unique_ptr<client::UncertaintySource> source, OpenSource(options));
    tables.push_back(source->table());
  } else {
    ASSIGN_OR_RETURN(tables, ListInstalledTables());
  }
  if (options.name.empty()) return tables;
  std::erase_if(tables, [&](const client::TableSummary& table) { return !HasName(table, options.name); });
  if (tables.empty())
    return absl::NotFoundError(absl::StrCat("there is no table '", options.name, "'; `albtpu-query tables` lists all"));
  return tables;
}

absl::StatusOr<Answerer> Answerer::Open(const config::SeaSettings& sea, const SourceOptions& options, double index) {
  Answerer answerer;
  if (!sea.has_waves()) {
    ASSIGN_OR_RETURN(answerer.table_, OpenSource(options, index));
    return answerer;
  }
  ASSIGN_OR_RETURN(std::unique_ptr<client::SeaSources> sources, OpenSeaSources(options, index));
  ASSIGN_OR_RETURN(annotate::SeaTimeline timeline, annotate::SeaTimeline::Open(sea));
  answerer.timeline_ = std::make_shared<const annotate::SeaTimeline>(std::move(timeline));
  ASSIGN_OR_RETURN(answerer.seas_, annotate::SeaAnswers::Open(answerer.timeline_, std::move(sources)));
  return answerer;
}

std::string Answerer::ErrorNote() const {
  if (seas_ == nullptr) return annotate::InterpolationErrorNote(table_->table());
  return "standard errors are the sea's own: the sampling of its spectrum, and half the difference between "
         "the tail "
         "rules wind and level";
}

nlohmann::ordered_json Answerer::SeaJson() const {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  if (seas_ != nullptr)
    json["sea"] = annotate::SeasJson(*timeline_, timeline_->fixed().first, timeline_->fixed().second);
  return json;
}

std::string Answerer::SeaText() const {
  std::string text;
  if (seas_ == nullptr) return text;
  for (const std::string& note : annotate::SeasNotes(*timeline_, timeline_->fixed().first, timeline_->fixed().second))
    absl::StrAppend(&text, "\n  ", note);
  return text;
}

absl::Status Answerer::CheckOneTime(const std::string& command) const {
  if (timeline_ == nullptr || !timeline_->by_time()) return absl::OkStatus();
  return formats::UsageError(absl::StrCat(command, ": ", *timeline_->settings().file, " has ", timeline_->size(),
                                          " records ", annotate::SpanText(*timeline_),
                                          " (pulses have no time here); choose one by --sea-time, such as ",
                                          SeaTimeText(timeline_->end())));
}

}  // namespace albtpu::programs
