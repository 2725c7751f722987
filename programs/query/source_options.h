// What answers: a table of a file, of a server or of those that are installed beside the program, or the sea.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "annotate/answers/batch.h"
#include "annotate/seas/sea_answers.h"
#include "config/sea_settings.h"
#include "sea/water_index.h"
#include "service/client/credentials.h"
#include "service/client/sea_sources.h"
#include "service/client/uncertainty_source.h"

namespace albtpu::programs {

// At most one of `server` and `file` is set; without them an installed table answers in this process.
struct SourceOptions {
  std::string server = {};               // HOST:PORT
  client::Credentials credentials = {};  // for the server
  std::string file = {};                 // FILE.h5
  std::string name = {};                 // NAME or NAME/VERSION; empty for the default table
};

absl::StatusOr<std::unique_ptr<client::UncertaintySource>> OpenSource(const SourceOptions& options,
                                                                      double index = kSeaWaterIndex);

// Where seas are compiled: in this process, or on the server. UsageError if a table is named, too.
absl::StatusOr<std::unique_ptr<client::SeaSources>> OpenSeaSources(const SourceOptions& options, double index);

// All tables of the source, or those that `options.name` names.
absl::StatusOr<std::vector<client::TableSummary>> ListTables(const SourceOptions& options);

// What answers the pulses of a command: a table, or the sea.
class Answerer {
 public:
  // Opens a table, unless `sea` has waves, in water of the index. UsageError if both are given.
  static absl::StatusOr<Answerer> Open(const config::SeaSettings& sea, const SourceOptions& options, double index);

  annotate::AnswerSource source() { return seas_ != nullptr ? seas_->source() : annotate::AnswerSource(*table_); }
  // Null where a table answers.
  std::shared_ptr<const annotate::SeaTimeline> timeline() const { return timeline_; }
  annotate::SeaAnswers* seas() { return seas_.get(); }

  // What the errors of its numbers are, for the user.
  std::string ErrorNote() const;

  // Which sea it is, for a summary ({"sea": ...} or {}) and for the user, lines indented by two blanks. Of a sea for
  // all pulses.
  nlohmann::ordered_json SeaJson() const;
  std::string SeaText() const;

  // UsageError if the sea goes by times that the pulses of `command` do not have.
  absl::Status CheckOneTime(const std::string& command) const;

 private:
  std::unique_ptr<client::UncertaintySource> table_;
  std::shared_ptr<const annotate::SeaTimeline> timeline_;
  std::unique_ptr<annotate::SeaAnswers> seas_;
};

}  // namespace albtpu::programs
