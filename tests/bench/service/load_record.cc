#include "tests/bench/service/load_record.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iostream>

namespace albtpu::bench {

double OwnProcessorTime() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// The fields utime and stime of proc(5), which are in clock ticks.
double ProcessorTimeOf(int pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string word;
  std::getline(file, word, ')');
  for (int field = 3; field < 14; ++field) file >> word;
  double user = 0, system = 0;
  file >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

void Check(bool good, const std::string& what) {
  if (good) return;
  std::cerr << "service_bench: " << what << "\n";
  std::exit(1);
}

}  // namespace albtpu::bench
