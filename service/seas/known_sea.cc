#include "service/seas/known_sea.h"

#include "sea/table/sea_table.h"

namespace albtpu {
namespace {

SeaDescription Told(const KnownSea& sea) {
  return {.wind_speed_10m = sea.wind_speed_10m,
          .wind_from = sea.wind_from,
          .water_depth = sea.water_depth,
          .tail = sea.tail,
          .tail_from = sea.tail_from};
}

}  // namespace

KnownSea KnownSeaOf(const SeaRecord& record, const SeaDescription& told, double record_length) {
  KnownSea sea{.wind_speed_10m = told.wind_speed_10m ? told.wind_speed_10m : record.wind_speed_10m,
               .wind_from = told.wind_from ? told.wind_from : record.wind_from,
               .water_depth = told.water_depth ? told.water_depth : record.water_depth,
               .tail = told.tail,
               .tail_from = told.tail_from,
               .record_length = record_length};
  std::visit([&sea](const auto& waves) { sea.waves = waves; }, record.waves);
  return sea;
}

absl::StatusOr<UncertaintyTable> CompileSea(const SeaCompiler& compiler, const KnownSea& sea) {
  SeaRecord record;
  if (const auto* const whole = std::get_if<WholeSea>(&sea.waves)) {
    record.waves = *whole;
    return compiler.Compile(Describe(record, Told(sea)));
  }
  if (std::holds_alternative<std::monostate>(sea.waves))
    return compiler.Compile(Told(sea), sea.record_length);
  if (const auto* const bins = std::get_if<BinnedWaves>(&sea.waves)) record.waves = *bins;
  if (const auto* const components = std::get_if<WaveComponents>(&sea.waves)) record.waves = *components;
  return compiler.Compile(DescriptionOf(record, Told(sea)), sea.record_length);
}

}  // namespace albtpu
