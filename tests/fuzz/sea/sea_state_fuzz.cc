// Arbitrary bytes as the sea of a query are refused with the paths of wrong fields, or are a sea that has a table, or
// whose numbers no table can hold.

#include "albtpu/v1/sea.pb.h"
#include "sea/table/sea_table.h"
#include "service/client/wire.h"
#include "service/seas/sea_summary.h"
#include "service/server/calls/sea_request.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/sea/sea_promises.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace albtpu;
  // A few beams: a sea is refused or not whatever the nodes of its table.
  static const SeaCompiler compiler(
      {.nodes = {.incidences = {0, 20}, .azimuths = {0, 90, 180}, .footprints = {0.5}, .depths = {0, 10}}});
  v1::SeaState state;
  if (!state.ParseFromArray(data, static_cast<int>(size))) return 0;
  const absl::StatusOr<KnownSea> sea = server::ReadSea(state);
  if (!sea.ok()) {
    ALBTPU_MUST(absl::IsInvalidArgument(sea.status()) && !sea.status().message().empty());
    ALBTPU_MUST(sea.status().GetPayload("type.googleapis.com/google.rpc.BadRequest").has_value());
    return 0;
  }
  const absl::StatusOr<KnownSea> same = server::ReadSea(client::ToWire(*sea));
  ALBTPU_MUST(same.ok());
  ALBTPU_MUST(client::ToWire(*same).SerializeAsString() == client::ToWire(*sea).SerializeAsString());
  // A table takes a thousand times as long as the rest.
  if (!fuzz::IsDescribed({reinterpret_cast<const char*>(data), size})) return 0;
  const absl::StatusOr<UncertaintyTable> table = CompileSea(compiler, *sea);
  ALBTPU_MUST(table.ok() || absl::IsInvalidArgument(table.status()));
  if (!table.ok()) return 0;
  const SeaSummary summary = SummaryOfSea(*table).value();
  ALBTPU_MUST(summary.x_azimuth >= 0 && summary.x_azimuth <= 360);
  ALBTPU_MUST(summary.significant_wave_height >= 0);
  ALBTPU_MUST(summary.share_measured >= 0 && summary.share_measured <= 1 + 1e-9);
  return 0;
}
