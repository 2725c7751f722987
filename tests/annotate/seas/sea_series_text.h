// Series of the sea as CSV, for tests.
#pragma once

#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "sea/sea_time.h"

namespace albtpu::testing {

inline constexpr double kHour = 3600, kStart = 1591588800;  // s; 2020-06-08T04:00Z

struct SeaAtTime {
  double time;          // s since 1970
  double energy;        // of the peak, m^2/Hz
  double alpha2 = 230;  // degree
  double r2 = 0.4;
};

// Spectra with a peak at 0.2 Hz, up to 0.5 Hz.
inline std::string SeaCsv(const std::vector<SeaAtTime>& seas) {
  std::string text = "time,f,E,r2,alpha2\n";
  for (const SeaAtTime& sea : seas) {
    for (int i = 1; i <= 10; ++i) {
      const double f = 0.05 * i, energy = sea.energy * (f < 0.2 ? f / 0.2 : 1 / (f / 0.2) / (f / 0.2));
      absl::StrAppend(&text, SeaTimeText(sea.time), ",", f, ",", energy, ",", sea.r2, ",", sea.alpha2, "\n");
    }
  }
  return text;
}

}  // namespace albtpu::testing
