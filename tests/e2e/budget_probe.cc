// For compare_surveys.py: asks a server for the totals of pulses, as a program that uses the installed library.
//
//   probe HOST:PORT PULSES ANSWERS
//
// PULSES holds columns of floats, one after another, in the order of `columns` below; ANSWERS gets THU and TVU.
#include <albtpu/service/client/server_source.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <span>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 4) return std::fprintf(stderr, "usage: probe HOST:PORT PULSES ANSWERS\n"), 2;
  const auto server = albtpu::client::OpenServer(argv[1], "");
  if (!server.ok()) return std::fprintf(stderr, "probe: %s\n", server.status().ToString().c_str()), 1;

  std::ifstream input(argv[2], std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(input), {}};
  const std::span numbers(reinterpret_cast<const float*>(bytes.data()), bytes.size() / sizeof(float));
  using enum albtpu::BudgetInput;
  constexpr std::array columns = {kAltitude,
                                  kBeamAzimuth,
                                  kRoll,
                                  kPitch,
                                  kHeading,
                                  kVelocityNorth,
                                  kVelocityEast,
                                  kVelocityDown,
                                  kPositionSigmaNorth,
                                  kPositionSigmaDown,
                                  kHeadingSigma};
  constexpr std::size_t axes = 5;
  const std::size_t count = numbers.size() / (axes + columns.size());
  const auto column = [&](std::size_t i) { return numbers.subspan(i * count, count); };

  albtpu::BudgetPulses pulses;
  pulses.pulses = {.size = count, .axis = {column(0), {}, column(1), column(2), column(3), column(4)}};
  pulses.aircraft.size = count;
  for (std::size_t i = 0; i < columns.size(); ++i) pulses.aircraft[columns[i]] = column(axes + i);
  pulses.sea_axis = 250;

  albtpu::BudgetOptions options;
  options.located = albtpu::SurfaceLocation::kLocal;
  options.datum = 0.08;

  std::vector<float> thu(count), tvu(count);
  albtpu::BudgetAnswers answers;
  answers.columns[FirstColumn(albtpu::BudgetQuantity::kTotalThu)] = thu.data();
  answers.columns[FirstColumn(albtpu::BudgetQuantity::kTotalTvu)] = tvu.data();
  const absl::Status status = (*server)->AnswerBudget(options, pulses, answers);
  if (!status.ok()) return std::fprintf(stderr, "probe: %s\n", status.ToString().c_str()), 1;

  std::ofstream output(argv[3], std::ios::binary);
  for (const std::vector<float>& values : {thu, tvu})
    output.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(count * sizeof(float)));
}
