// Queries a server for the uncertainty of a flight line.
//
//   ask 127.0.0.1:50051
#include <albtpu/service/client/server_source.h>

#include <cstdio>
#include <span>
#include <vector>

using albtpu::Quantity;

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: ask HOST:PORT\n"), 2;
  const auto server = albtpu::client::OpenServer(argv[1], "");
  if (!server.ok()) return std::fprintf(stderr, "ask: %s\n", server.status().ToString().c_str()), 1;
  const albtpu::client::TableSummary& table = (*server)->table();
  std::printf("# %s, version %s, digest %s\n", table.id.c_str(), table.version.c_str(), table.digest.c_str());

  // Columns with one number per pulse, one number for all pulses, or none (a fully developed sea; no azimuth).
  std::vector<float> incidence, depth;
  for (int i = 0; i <= 20; ++i) {
    incidence.push_back(static_cast<float>(i));
    depth.push_back(1 + 0.75f * static_cast<float>(i));
  }
  const float wind_speed = 7, footprint = 0.6f;
  const albtpu::PulseColumns pulses = {
      .size = depth.size(), .axis = {std::span(&wind_speed, 1), {}, incidence, {}, std::span(&footprint, 1), depth}};

  // Any number of pulses; millions are sent as a stream of messages. Quantities that are not requested stay null.
  std::vector<float> thu(pulses.size), tvu(pulses.size);
  albtpu::AnswerColumns answers;
  answers.values[albtpu::Index(Quantity::kThu)] = thu.data();
  answers.values[albtpu::Index(Quantity::kTvu)] = tvu.data();
  const absl::Status status = (*server)->Answer({.coverage = albtpu::Coverage::kP95}, pulses, answers);
  if (!status.ok()) return std::fprintf(stderr, "ask: %s\n", status.ToString().c_str()), 1;

  std::printf("incidence,depth,thu,tvu\n");
  for (std::size_t i = 0; i < pulses.size; ++i)
    std::printf("%.9g,%.9g,%.9g,%.9g\n", incidence[i], depth[i], thu[i], tvu[i]);
}
