// The studies of the report: each a function of its options alone.
#pragma once

#include "absl/status/statusor.h"
#include "validation/report/study.h"

namespace albtpu {

// Figures 2 and 3 of the paper: the spectrum of a young sea, and a beam through a surface drawn from it.
absl::StatusOr<Study> SpectrumStudy(const StudyOptions& options);

// Table 2: the waves of the tank, as a wave staff measured them.
absl::StatusOr<Study> WaveStaffStudy(const StudyOptions& options);

// Table 3, Figures 8 and 9, Eq. 27-30: the paper's Monte Carlo beside ours.
absl::StatusOr<Study> PaperMonteCarloStudy(const StudyOptions& options);

// Table 4: refraction as photodiodes under a wave tank measured it.
absl::StatusOr<Study> LaboratoryStudy(const StudyOptions& options);

// Table 5, THU and TVU by the angle method beside the limits of IHO S-44: from the measured angles of Table 4 at 20
// degrees and 5.25 m/s, by quadrature and with the paper's 10,000 draws.
absl::StatusOr<Study> AngleMethodStudy(const StudyOptions& options);

// The range of validity of the small-slope theory over the domain of a survey.
absl::StatusOr<Study> ClosedFormMapStudy(const StudyOptions& options);

// The spectra beside measurements of real seas, and how the choice of spectrum changes the uncertainty of a beam.
absl::StatusOr<Study> RealSeaStudy(const StudyOptions& options);

// The response theory, which makes the tables of measured and described seas, beside tracing.
absl::StatusOr<Study> ResponseTheoryStudy(const StudyOptions& options);

// The effect of scattering in the water on the reported bottom, beside known results for its parts.
absl::StatusOr<Study> WaterColumnStudy(const StudyOptions& options);

// Figure 1a of the paper: gravity waves longer than the footprint, removed by a correction for the local slope.
absl::StatusOr<Study> CorrectedWavesStudy(const StudyOptions& options);

}  // namespace albtpu
