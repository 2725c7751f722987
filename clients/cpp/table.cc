// Interpolates a table in process: the uncertainty of one pulse and of a flight line.
//
//   table /usr/share/albtpu/tables/survey.h5
#include <albtpu/tables/column_query.h>
#include <albtpu/tables/interpolation.h>
#include <albtpu/tables/table_io.h>

#include <cstdio>
#include <span>
#include <vector>

using albtpu::Quantity;

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: table TABLE.h5\n"), 2;
  const absl::StatusOr<albtpu::UncertaintyTable> table = albtpu::ReadTable(argv[1]);
  if (!table.ok()) return std::fprintf(stderr, "table: %s\n", table.status().ToString().c_str()), 1;

  // One pulse. Outside the domain of the table it has no numbers, and the outcome names the axis.
  const albtpu::PulseUncertainty one =
      albtpu::Interpolate(*table, {.wind_speed = 7, .incidence = 12, .azimuth = 30, .footprint = 0.6f, .depth = 8});
  std::printf("# %s: THU %.9g m, TVU %.9g m, 2 sigma\n", albtpu::OutcomeText(one).c_str(), one[Quantity::kThu],
              one[Quantity::kTvu]);

  // Many pulses, as columns with one number per pulse, one number for all, or none (fully developed sea; no azimuth).
  std::vector<float> incidence, depth;
  for (int i = 0; i <= 20; ++i) {
    incidence.push_back(static_cast<float>(i));
    depth.push_back(1 + 0.75f * static_cast<float>(i));
  }
  const float wind_speed = 7, footprint = 0.6f;
  const albtpu::PulseColumns pulses = {
      .size = depth.size(), .axis = {std::span(&wind_speed, 1), {}, incidence, {}, std::span(&footprint, 1), depth}};

  std::vector<float> thu(pulses.size), tvu(pulses.size);
  albtpu::AnswerColumns answers;
  answers.values[albtpu::Index(Quantity::kThu)] = thu.data();
  answers.values[albtpu::Index(Quantity::kTvu)] = tvu.data();
  const albtpu::ColumnInterpolator interpolator(*table);
  albtpu::InterpolateOnAllCores(interpolator, {.coverage = albtpu::Coverage::kP95}, pulses, answers);

  std::printf("incidence,depth,thu,tvu\n");
  for (std::size_t i = 0; i < pulses.size; ++i)
    std::printf("%.9g,%.9g,%.9g,%.9g\n", incidence[i], depth[i], thu[i], tvu[i]);
}
