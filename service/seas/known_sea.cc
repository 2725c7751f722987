#include "service/seas/known_sea.h"

#include "sea/table/sea_table.h"

namespace albtpu {
namespace {

SeaDescription GivenBy(const KnownSea& sea) {
  return {.wind_speed_10m = sea.wind_speed_10m,
          .wind_from = sea.wind_from,
          .water_depth = sea.water_depth,
          .tail = sea.tail,
          .tail_from = sea.tail_from};
}

// Of a sea that is not complete.
SeaDescription WithWaves(const KnownSea& sea) {
  SeaRecord record;
  if (std::holds_alternative<std::monostate>(sea.waves)) return GivenBy(sea);
  if (const auto* const bins = std::get_if<BinnedWaves>(&sea.waves)) record.waves = *bins;
  if (const auto* const components = std::get_if<WaveComponents>(&sea.waves)) record.waves = *components;
  return DescriptionOf(record, GivenBy(sea));
}

}  // namespace

KnownSea KnownSeaOf(const SeaRecord& record, const SeaDescription& given, double record_length) {
  KnownSea sea{.wind_speed_10m = given.wind_speed_10m ? given.wind_speed_10m : record.wind_speed_10m,
               .wind_from = given.wind_from ? given.wind_from : record.wind_from,
               .water_depth = given.water_depth ? given.water_depth : record.water_depth,
               .tail = given.tail,
               .tail_from = given.tail_from,
               .record_length = record_length};
  std::visit([&sea](const auto& waves) { sea.waves = waves; }, record.waves);
  return sea;
}

DescribedSea Describe(const KnownSea& sea) {
  if (const auto* const whole = std::get_if<WholeSea>(&sea.waves)) {
    SeaRecord record;
    record.waves = *whole;
    return Describe(record, GivenBy(sea));
  }
  return Describe(WithWaves(sea));
}

absl::StatusOr<UncertaintyTable> CompileSea(const SeaCompiler& compiler, const KnownSea& sea, double index) {
  if (std::holds_alternative<WholeSea>(sea.waves)) return compiler.Compile(Describe(sea), index);
  return compiler.Compile(WithWaves(sea), sea.record_length, index);
}

}  // namespace albtpu
