#include "service/client/local_source.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "budget/query/query_check.h"
#include "sea/table/sea_table.h"
#include "sea/table/table_at_index.h"
#include "service/client/sea_sources.h"
#include "service/seas/sea_summary.h"
#include "status/status_macros.h"

namespace albtpu::client {
namespace {

struct AsText {
  std::string operator()(const std::string& text) const { return text; }
  std::string operator()(const std::vector<double>& numbers) const { return absl::StrJoin(numbers, ", "); }
  template <typename Number>
  std::string operator()(Number number) const {
    return absl::StrCat(number);
  }
};

class LocalSeaSources final : public SeaSources {
 public:
  explicit LocalSeaSources(double index) : index_(index) {}

  absl::StatusOr<std::unique_ptr<UncertaintySource>> Open(const KnownSea& sea) override {
    ASSIGN_OR_RETURN(const UncertaintyTable table, CompileSea(compiler_, sea, index_));
    return std::make_unique<LocalSource>("", table, index_);
  }

 private:
  const double index_;
  const SeaCompiler compiler_;
};

}  // namespace

absl::Status UncertaintySource::AnswerBudgetInWater(const BudgetOptions& /*options*/, const KnownWater& /*water*/,
                                                    const BudgetPulses& /*pulses*/, const BudgetAnswers& /*answers*/,
                                                    WaterSummary* /*summary*/) {
  return absl::UnimplementedError(
      "this source compiles no water; compile it, and give its columns in the pulses (water_columns.h)");
}

std::unique_ptr<SeaSources> LocalSeas(double index) { return std::make_unique<LocalSeaSources>(index); }

TableSummary Summarize(std::string name, const UncertaintyTable& table, double index) {
  const Provenance& provenance = table.provenance();
  TableSummary summary;
  summary.name = std::move(name);
  summary.id = provenance.id;
  summary.version = provenance.version;
  summary.title = provenance.title;
  summary.digest = table.digest();
  summary.refractive_index = index;
  summary.sea = SummaryOfSea(table);
  for (const Axis& axis : table.axes())
    summary.axes[Index(axis.id())] = {axis.nodes().front(), axis.nodes().back(), axis.size()};
  for (const auto& [key, value] : provenance.attributes) summary.attributes[key] = std::visit(AsText(), value);
  return summary;
}

absl::Status CheckIndex(const BudgetOptions& options, const TableSummary& table) {
  if (options.index == table.refractive_index) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("the index of the water is ", options.index, " in the options of the budget and ",
                   table.refractive_index, " in the source of the sea's share; open the source at the same index"));
}

LocalSource::LocalSource(std::string name, UncertaintyTable table, double index)
    : summary_(Summarize(std::move(name), table, index)), interpolator_(AtIndex(std::move(table), index)) {}

absl::Status LocalSource::Answer(const Query& query, const PulseColumns& pulses, const AnswerColumns& answers) {
  const PulseColumns used = summary_.sea ? OnOneSea(pulses) : pulses;
  RETURN_IF_ERROR(CheckLengths(summary_.sea ? kOneSea : kSeaSurface, used));
  InterpolateOnAllCores(interpolator_, query, used, answers);
  return absl::OkStatus();
}

absl::Status LocalSource::AnswerBudget(const BudgetOptions& options, const BudgetPulses& pulses,
                                       const BudgetAnswers& answers) {
  BudgetPulses used = pulses;
  if (summary_.sea) {
    used.pulses = OnOneSea(pulses.pulses);
    used.sea_axis = summary_.sea->x_azimuth;
  }
  RETURN_IF_ERROR(CheckQuery(summary_.sea ? kOneSea : kSeaSurface, used, options));
  RETURN_IF_ERROR(CheckIndex(options, summary_));
  QueryBudgetOnAllCores(interpolator_, used, options, answers);
  return absl::OkStatus();
}

}  // namespace albtpu::client
