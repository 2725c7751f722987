// The paper's tables: a reader of their CSV files, and the angle method, which makes THU and TVU of their angles.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "generator/math/random_stream.h"

namespace albtpu {

// A reader of the paper's tables as CSV files: lines of attribution that begin with `#`, a line of column names, rows
// of numbers and words.
class PublishedTable {
 public:
  // NotFound if there is no such file; InvalidArgument, with file and line, if a row does not match the column names.
  static absl::StatusOr<PublishedTable> Read(const std::filesystem::path& file);

  std::size_t size() const { return rows_.size(); }  // rows

  // InvalidArgument, with file, line and column, if there is no such column or if a number is expected and a word
  // found.
  absl::StatusOr<std::vector<double>> Numbers(std::string_view column) const;
  // Of several columns, in the order of their names.
  absl::StatusOr<std::vector<std::vector<double>>> Numbers(std::initializer_list<std::string_view> columns) const;
  absl::StatusOr<std::vector<std::string>> Words(std::string_view column) const;

 private:
  struct Row {
    int line;
    std::vector<std::string> cells;
  };

  absl::StatusOr<std::size_t> Find(std::string_view column) const;

  std::filesystem::path file_;
  std::vector<std::string> columns_;
  std::vector<Row> rows_;
};

// Table 2: the waves of the tank by fetch [m]. Peak frequency in Hz, peak wavelength and significant wave height in m.
struct Table2 {
  std::vector<double> fetch, peak_frequency, peak_wavelength, significant_wave_height;
};
absl::StatusOr<Table2> ReadTable2(const std::filesystem::path& published);

// The angle method of the paper: THU and TVU from the 2 sigma of a refraction angle. See the section "From an angle
// to THU and TVU" of docs/physics.md.
//
// It converts the tables of published angles to uncertainties of position. The tables made by this program do not
// need it: they take the errors of position from the traced beams themselves.

// 2 sigma, m per m of depth.
struct AngleMethodUncertainty {
  double thu_per_depth, tvu_per_depth;
};

// Birkebak et al. (2018), Eq. 24-26 at a depth of 1 m: 2 std(tan(theta + delta)) and 2 std(cos(theta) / cos(theta +
// delta)), with delta normal and `two_sigma_angle` [rad] twice its standard deviation. theta is `refracted`, the
// angle of the ray in still water; the paper says only "incidence", but this angle reproduces Table 5 and the
// incidence in air does not.
//
// A normal delta has a tiny probability (1e-150 in Table 5) of reaching the horizontal, where tangent and secant have
// no variance. It is therefore cut at eight standard deviations, beyond which 1e-15 of it lies, and the ray must
// still go down there: refracted + 4 two_sigma_angle < pi/2. The moments are computed by the trapezoidal rule in
// delta, which is exact to rounding for a smooth function under a normal density.
AngleMethodUncertainty AngleMethod(double refracted, double two_sigma_angle);

// The same as the paper computes it: from the sample standard deviations over `draws` (at least 2) random values of
// delta. Both have a relative standard error of about 1 / sqrt(2 draws).
AngleMethodUncertainty AngleMethodByDraws(double refracted, double two_sigma_angle, int draws, NormalStream stream);

}  // namespace albtpu
