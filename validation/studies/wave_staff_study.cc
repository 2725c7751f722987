#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "generator/math/statistics.h"
#include "sea/sea_state.h"
#include "sea/spectra/wave_spectrum.h"
#include "status/status_macros.h"
#include "validation/laboratory/wave_staff.h"
#include "validation/published/published_table.h"
#include "validation/studies/studies.h"

namespace albtpu {
namespace {

constexpr double kWindOfTable2 = 5.25;                  // m/s; Table 2 does not state its wind
constexpr double kWinds[] = {2, 2.5, 3, 3.5, 4, 5.25};  // m/s, Table 1
constexpr double kModelFetch = 30;                      // m, of the spectrum fitted in Fig. 7

// Section 2.2: 30 Hz for five minutes. The paper does not say how the spectrum was estimated; segments of 8.5 s
// resolve 0.12 Hz, about the precision of Table 2.
constexpr double kRate = 30;  // Hz
constexpr int kSamples = 5 * 60 * 30;
constexpr int kSegment = 256;

// Computed from the spectrum.
struct Waves {
  double peak_wavelength;          // m, 2 pi / k_p
  double peak_frequency;           // Hz, of the spectrum over frequency
  double significant_wave_height;  // m
};

Waves WavesOf(const SeaState& sea) {
  return {2 * std::numbers::pi / sea.spectrum().peak_wavenumber(), PeakFrequency(sea),
          4 * std::sqrt(ElevationVariance(sea))};
}

// Measured by a staff in the same sea: means over records.
struct StaffReading {
  Estimate peak_frequency, significant_wave_height, highest_third;
  RecordSpectrum spectrum;
};

StaffReading Measure(const SeaState& sea, int records, std::uint64_t seed, std::uint32_t cell) {
  Eigen::ArrayXd peak(records), height(records), highest_third(records);
  std::vector<RecordSpectrum> spectra(records);
  const WaveStaff staff(sea, kSamples, kRate);
  tbb::parallel_for(0, records, [&](int r) {
    const std::vector<double> record = staff.Draw(NormalStream(seed, cell, static_cast<std::uint32_t>(r)));
    spectra[r] = WelchSpectrum(record, kRate, kSegment);
    peak[r] = spectra[r].PeakFrequency();
    height[r] = spectra[r].SignificantWaveHeight();
    highest_third[r] = HighestThird(record);
  });
  RecordSpectrum mean = spectra.front();
  for (std::size_t m = 0; m < mean.density.size(); ++m) {
    double sum = 0;
    for (const RecordSpectrum& spectrum : spectra) sum += spectrum.density[m];
    mean.density[m] = sum / records;
  }
  return {Mean(peak), Mean(height), Mean(highest_third), mean};
}

DataTable TableOfFetches(const Table2& published, const std::vector<Waves>& ours) {
  DataTable table{"table_2",
                  "Waves by fetch: published, and by Apel's spectrum at 5.25 m/s",
                  {"fetch_m", "published_peak_wavelength_m", "peak_wavelength_m", "published_peak_frequency_hz",
                   "peak_frequency_hz", "published_significant_wave_height_m", "significant_wave_height_m"}};
  for (std::size_t i = 0; i < ours.size(); ++i) {
    table.Add(published.fetch[i], published.peak_wavelength[i], ours[i].peak_wavelength, published.peak_frequency[i],
              ours[i].peak_frequency, published.significant_wave_height[i], ours[i].significant_wave_height);
  }
  return table;
}

DataTable TableOfWinds(const Table2& published) {
  DataTable table{
      "table_2_winds",
      "Apel's spectrum at the winds of the paper, for the fetches of Table 2 and for the 30 m that the paper "
      "fitted",
      {"wind_speed_m_s", "fetch_m", "peak_wavelength_m", "peak_frequency_hz", "significant_wave_height_m"}};
  std::vector<double> fetches = published.fetch;
  fetches.push_back(kModelFetch);
  for (const double wind : kWinds) {
    for (const double fetch : fetches) {
      const Waves waves = WavesOf(SeaState(wind, fetch));
      table.Add(wind, fetch, waves.peak_wavelength, waves.peak_frequency, waves.significant_wave_height);
    }
  }
  return table;
}

// The wavelength [m] at a frequency with gravity alone, g / (2 pi f^2).
double GravityWavelength(double frequency) { return kGravity / (2 * std::numbers::pi * frequency * frequency); }

double CapillaryGravityWavelength(double frequency) {
  return 2 * std::numbers::pi / Wavenumber(2 * std::numbers::pi * frequency);
}

DataTable TableOfDispersion(const Table2& published) {
  DataTable table{"table_2_dispersion",
                  "The wavelength at the published peak frequency, with gravity alone and with surface tension",
                  {"fetch_m", "published_peak_frequency_hz", "published_peak_wavelength_m", "gravity_alone_m",
                   "with_surface_tension_m"}};
  for (std::size_t i = 0; i < published.fetch.size(); ++i) {
    const double f = published.peak_frequency[i];
    table.Add(published.fetch[i], f, published.peak_wavelength[i], GravityWavelength(f), CapillaryGravityWavelength(f));
  }
  return table;
}

DataTable TableOfStaff(const Table2& published, const std::vector<Waves>& ours,
                       const std::vector<StaffReading>& staffs) {
  DataTable table{"table_2_staff",
                  "A virtual staff in the sea of 5.25 m/s, beside the spectrum from which the sea was made",
                  {"fetch_m", "spectrum_peak_frequency_hz", "staff_peak_frequency_hz",
                   "staff_peak_frequency_standard_error_hz", "spectrum_significant_wave_height_m",
                   "staff_significant_wave_height_m", "staff_significant_wave_height_standard_error_m",
                   "staff_highest_third_m", "staff_highest_third_standard_error_m"}};
  for (std::size_t i = 0; i < ours.size(); ++i) {
    table.Add(published.fetch[i], ours[i].peak_frequency, staffs[i].peak_frequency, ours[i].significant_wave_height,
              staffs[i].significant_wave_height, staffs[i].highest_third);
  }
  return table;
}

DataTable TableOfSpectra(const Table2& published, const std::vector<StaffReading>& staffs) {
  DataTable table{"table_2_spectrum",
                  "The spectrum of elevation over frequency at 5.25 m/s, and as measured by the virtual staff",
                  {"fetch_m", "frequency_hz", "spectrum_m2_per_hz", "staff_m2_per_hz"},
                  {},
                  false};
  for (std::size_t i = 0; i < staffs.size(); ++i) {
    const SeaState sea(kWindOfTable2, published.fetch[i]);
    const RecordSpectrum& spectrum = staffs[i].spectrum;
    for (std::size_t m = 1; m < spectrum.density.size(); ++m) {
      const double f = static_cast<double>(m) * spectrum.resolution;
      table.Add(published.fetch[i], f, FrequencySpectrum(sea, f), spectrum.density[m]);
    }
  }
  return table;
}

std::vector<Comparison> Comparisons(const Table2& published, const std::vector<Waves>& ours) {
  const std::string basis = "ours at 5.25 m/s; no verdict, because Table 2 does not state its wind";
  std::vector<Comparison> comparisons;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const auto compare = [&](const char* quantity, const char* unit, double theirs, double own) {
      comparisons.push_back({.quantity = absl::StrFormat("%s, fetch %g m", quantity, published.fetch[i]),
                             .unit = unit,
                             .published = theirs,
                             .ours = own,
                             .basis = basis});
    };
    compare("peak wavelength", "m", published.peak_wavelength[i], ours[i].peak_wavelength);
    compare("peak frequency", "Hz", published.peak_frequency[i], ours[i].peak_frequency);
    compare("significant wave height", "m", published.significant_wave_height[i], ours[i].significant_wave_height);
  }
  return comparisons;
}

// Whether gravity alone gives the published wavelength at the published frequency, within their rounding of 0.05 Hz
// and 0.5 mm.
bool GravityExplains(double wavelength, double frequency) {
  return wavelength + 0.0005 >= GravityWavelength(frequency + 0.05) &&
         wavelength - 0.0005 <= GravityWavelength(frequency - 0.05);
}

std::vector<std::string> Paragraphs(const Table2& published, const std::vector<Waves>& ours,
                                    const std::vector<StaffReading>& staffs, int records) {
  const std::size_t rows = ours.size();
  Range length, height, steepness, lengthening, highest_third;
  int explained = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    const double f = published.peak_frequency[i];
    length.Add(ours[i].peak_wavelength / published.peak_wavelength[i] - 1);
    height.Add(ours[i].significant_wave_height / published.significant_wave_height[i]);
    steepness.Add(published.significant_wave_height[i] / published.peak_wavelength[i]);
    lengthening.Add(CapillaryGravityWavelength(f) / GravityWavelength(f) - 1);
    highest_third.Add(staffs[i].highest_third.value / staffs[i].significant_wave_height.value);
    explained += GravityExplains(published.peak_wavelength[i], f);
  }
  return {absl::StrFormat("Table 2 does not state its wind. At 5.25 m/s, the strongest wind of the paper, the "
                          "peak wavelengths of Apel's spectrum differ from the published ones by %+.0f to %+.0f "
                          "%%; weaker winds make shorter waves (second table).",
                          100 * length.least, 100 * length.most),
          absl::StrFormat(
              "At 5.25 m/s the significant wave heights of the spectrum are only %.2f to %.2f of the measured "
              "ones: the spectrum has the saturation level of mature seas at all fetches, and young waves are "
              "steeper. The measured heights, however, are %.2f to %.2f of the measured wavelengths, and a "
              "gravity wave breaks at 0.14 (Michell 1893): at the short fetches they cannot be the height of the "
              "waves at the peak alone. The records must contain something else, such as longer waves or the "
              "noise that the paper mentions.",
              height.least, height.most, steepness.least, steepness.most),
          absl::StrFormat("The published wavelengths follow from the published frequencies with gravity alone, g "
                          "/ (2 pi f^2): %d of %d rows agree within the rounding of both. With surface tension "
                          "the wavelengths at these frequencies are %.0f to %.0f %% longer.",
                          explained, static_cast<int>(rows), 100 * lengthening.least, 100 * lengthening.most),
          absl::StrFormat(
              "The virtual staff samples the evolving sea of 5.25 m/s at 30 Hz for five minutes, as the paper's "
              "staff did (means of %d records). Waves above 15 Hz alias into its record. The paper does not say "
              "how its spectrum was estimated; here it is the mean of half-overlapping periodograms of 8.5 s "
              "under a Hann window, 0.12 Hz apart. The significant wave height is four times the root of the "
              "integral of the spectrum. The paper uses the mean of the highest third of the waves, which on the "
              "same records is %.2f to %.2f of that. For a narrow spectrum the two are equal; short waves on "
              "longer ones, and a sampling of five points a period, make them differ.",
              records, highest_third.least, highest_third.most)};
}

}  // namespace

absl::StatusOr<Study> WaveStaffStudy(const StudyOptions& options) {
  ASSIGN_OR_RETURN(const Table2 published, ReadTable2(options.published));

  const int records = options.quick ? 10 : 100;
  std::vector<Waves> ours;
  std::vector<StaffReading> staffs;
  for (std::size_t i = 0; i < published.fetch.size(); ++i) {
    const SeaState sea(kWindOfTable2, published.fetch[i]);
    ours.push_back(WavesOf(sea));
    staffs.push_back(Measure(sea, records, options.seed, static_cast<std::uint32_t>(i)));
  }

  Study study;
  study.id = "table_2";
  study.title = "Table 2: the wave staff";
  study.paragraphs = Paragraphs(published, ours, staffs, records);
  study.comparisons = Comparisons(published, ours);
  study.tables = {TableOfFetches(published, ours), TableOfWinds(published), TableOfDispersion(published),
                  TableOfStaff(published, ours, staffs), TableOfSpectra(published, staffs)};
  study.figures = {
      {"table_2",
       "Peak wavelength and significant wave height over fetch: measured, and by Apel's spectrum at the "
       "winds of the paper."},
      {"table_2_spectrum",
       "The spectrum over frequency at 5.25 m/s, and as measured by a staff at 30 Hz in five minutes. The "
       "floor of the measured spectrum is waves above 15 Hz that alias into the record. The dashed lines are "
       "the measured peak frequencies."}};
  return study;
}

}  // namespace albtpu
