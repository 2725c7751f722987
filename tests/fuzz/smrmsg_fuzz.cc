// Arbitrary bytes as an SMRMSG are rejected with a reason; or its times increase, its sigmas are finite and not
// negative, and those between two records lie between theirs.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "formats/trajectories/sbet_file.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/trajectory_promises.h"

namespace {

using namespace albtpu;
using namespace albtpu::formats;

constexpr double TrajectorySigma::*kFields[] = {
    &TrajectorySigma::north,          &TrajectorySigma::east,          &TrajectorySigma::down,
    &TrajectorySigma::velocity_north, &TrajectorySigma::velocity_east, &TrajectorySigma::velocity_down,
    &TrajectorySigma::roll,           &TrajectorySigma::pitch,         &TrajectorySigma::heading};

// a + w (b - a) may leave [a, b] by its roundings, at most two units in the last place of the larger.
bool IsBetween(double value, double a, double b) {
  const double slack = 4 * std::numeric_limits<double>::epsilon() * std::max(a, b);
  return value >= std::min(a, b) - slack && value <= std::max(a, b) + slack;
}

void CheckBetween(const SmrmsgFile& file, std::size_t record) {
  const double before = file.TimeAt(record - 1), after = file.TimeAt(record);
  const double time = before + (after - before) / 3;
  const std::optional<TrajectorySigma> sigma = file.SigmaAt(time);
  if (time > before && time < after) ALBTPU_MUST(sigma.has_value() == (after - before <= SmrmsgFile::kLongestGap));
  if (!sigma.has_value()) return;
  const TrajectorySigma a = file.SigmaOf(record - 1), b = file.SigmaOf(record);
  for (const auto field : kFields) ALBTPU_MUST(IsBetween((*sigma).*field, a.*field, b.*field));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data),
                          size);  // A copy: sanitizers detect reads beyond it.
  const bool recognized = SmrmsgFile::Recognizes(bytes);
  const absl::StatusOr<SmrmsgFile> file = SmrmsgFile::Parse("file", bytes);
  if (!file.ok()) {
    fuzz::MustExplain(file.status(), "file");
    return 0;
  }
  ALBTPU_MUST(recognized && file->size() * SmrmsgFile::kRecordSize == size);
  for (std::size_t i = 0; i < file->size(); ++i) {
    const std::optional<TrajectorySigma> sigma = file->SigmaAt(file->TimeAt(i));
    ALBTPU_MUST(sigma.has_value());
    for (const auto field : kFields) {
      ALBTPU_MUST((*sigma).*field >= 0 && std::isfinite((*sigma).*field));
      ALBTPU_MUST((*sigma).*field == file->SigmaOf(i).*field);
    }
    if (i == 0) continue;
    ALBTPU_MUST(file->TimeAt(i) > file->TimeAt(i - 1));
    CheckBetween(*file, i);
  }
  const double start = file->TimeAt(0), end = file->TimeAt(file->size() - 1);
  ALBTPU_MUST(!file->SigmaAt(std::nextafter(start, -INFINITY)).has_value());
  ALBTPU_MUST(!file->SigmaAt(std::nextafter(end, INFINITY)).has_value());
  return 0;
}
