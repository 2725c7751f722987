#include "validation/published/paper_monte_carlo.h"

#include <numbers>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"

namespace albtpu {

PaperMonteCarloSize SizeOfPaperMonteCarlo(bool quick) {
  if (quick) return {{150, std::nullopt, Estimator::kPlain}, {200, std::nullopt, Estimator::kControlVariate}};
  return {{500, 10'000, Estimator::kPlain}, {2000, std::nullopt, Estimator::kControlVariate}};
}

PaperMonteCarlo RunPaperMonteCarlo(PublishedAngles table_3, const PaperMonteCarloSize& size,
                                   std::uint64_t seed) {
  // A seed of its own keeps the surfaces of the plain run apart from those of the fine run.
  const std::uint64_t another_seed = seed + 1;
  GridOptions grid{table_3.wind_speeds, table_3.incidences};
  PaperMonteCarlo runs{
      std::move(table_3), ClosedFormGrid(grid), SimulateGrid(grid, size.fine, seed), {}, {}, {}, {}};
  grid.height_scale = std::numbers::sqrt2;
  runs.fine_sqrt2 = SimulateGrid(grid, size.fine, seed);
  grid.height_scale = 1;
  runs.plain_name = absl::StrCat("plain Monte Carlo, ", size.plain.surfaces, " surfaces");
  for (const double diameter : kPaperDiameters) {
    grid.footprint = diameter;
    runs.by_diameter.push_back(SimulateGrid(grid, size.plain, another_seed));
    runs.closed_form_by_diameter.push_back(ClosedFormGrid(grid));
  }
  return runs;
}

}  // namespace albtpu
