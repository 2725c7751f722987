#include "validation/published/published_tables.h"

#include <Eigen/Dense>
#include <cassert>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "generator/campaign/campaign_axes.h"
#include "generator/campaign/provenance.h"
#include "sea/angle.h"
#include "sea/response/closed_form.h"
#include "status/status_macros.h"
#include "tables/version.h"
#include "validation/published/published_table.h"

namespace albtpu {
double PublishedAlongWindDiameterFactor(double diameter) {
  return std::pow(diameter / 0.25, kPublishedAlongWindExponent);
}

double PublishedCrossWindDiameterFactor(double diameter) {
  return std::pow(diameter / 0.25, kPublishedCrossWindExponent);
}

AngleModel FitAngleModel(const std::vector<AngleSample>& samples) {
  assert(samples.size() >= 4);
  const auto count = static_cast<Eigen::Index>(samples.size());
  Eigen::MatrixX4d terms(count, 4);
  Eigen::VectorXd angles(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const AngleSample& sample = samples[i];
    terms.row(i) << sample.incidence_degrees * sample.wind_speed, sample.wind_speed, sample.incidence_degrees, 1;
    angles[i] = sample.angle_degrees;
  }
  const Eigen::Vector4d fit = terms.colPivHouseholderQr().solve(angles);
  return {fit[0], fit[1], fit[2], fit[3]};
}

LineFit FitLine(const std::vector<double>& x, const std::vector<double>& y) {
  assert(x.size() == y.size() && x.size() >= 2);
  const auto count = static_cast<Eigen::Index>(x.size());
  const Eigen::ArrayXd xs = Eigen::Map<const Eigen::ArrayXd>(x.data(), count);
  const Eigen::ArrayXd ys = Eigen::Map<const Eigen::ArrayXd>(y.data(), count);
  const Eigen::ArrayXd dx = xs - xs.mean(), dy = ys - ys.mean();
  const double slope = (dx * dy).sum() / dx.square().sum();
  return {slope, ys.mean() - slope * xs.mean(), slope * (dx * dy).sum() / dy.square().sum()};
}

PowerLaw FitPowerLaw(std::vector<double> x, std::vector<double> y) {
  for (double& value : x) value = std::log(value);
  for (double& value : y) value = std::log(value);
  const LineFit line = FitLine(x, y);
  return {std::exp(line.intercept), line.slope};
}

namespace {

// 2 sigma along and across the wind, degrees, as in the paper.
struct Angles {
  double along, cross;
};
using AnglesAt = std::function<Angles(double wind_speed, double incidence_degrees, double footprint)>;

struct TableNodes {
  std::vector<double> wind_speeds, incidences, footprints, depths;
};

// The fetch of the sea that the paper fits to its tank and takes as fully developed; an axis with one fetch answers
// for any fetch. The plane of incidence is along the wind.
constexpr double kFetch = 30, kAzimuth = 0;

// The angles at each node, and THU and TVU from both angles together, as Table 5 follows from Table 4.
UncertaintyTable::Variables MakeVariables(const TableNodes& nodes, const AnglesAt& angles_at) {
  Variable along, cross, thu, tvu;
  for (const double wind_speed : nodes.wind_speeds) {
    for (const double incidence : nodes.incidences) {
      const double refracted = StillWaterRefraction(RadiansOfDegrees(incidence), kRefractiveIndex);
      for (const double footprint : nodes.footprints) {
        const Angles angles = angles_at(wind_speed, incidence, footprint);
        const AngleMethodUncertainty uncertainty =
            AngleMethod(refracted, RadiansOfDegrees(std::hypot(angles.along, angles.cross)));
        along.values.push_back(static_cast<float>(angles.along));
        cross.values.push_back(static_cast<float>(angles.cross));
        for (const double depth : nodes.depths) {
          thu.values.push_back(static_cast<float>(depth * uncertainty.thu_per_depth));
          tvu.values.push_back(static_cast<float>(depth * uncertainty.tvu_per_depth));
        }
      }
    }
  }
  UncertaintyTable::Variables variables;
  variables[Index(Quantity::kRefractionAlongWind)] = std::move(along);
  variables[Index(Quantity::kRefractionCrossWind)] = std::move(cross);
  variables[Index(Quantity::kThu)] = std::move(thu);
  variables[Index(Quantity::kTvu)] = std::move(tvu);
  return variables;
}

constexpr char kAlongTheWind[] =
    " For a beam along the wind alone: ask with azimuth 0; a question without an azimuth is for the "
    "worse of 0 and 90 degrees, and out of the domain.";

// The provenance of either table.
Provenance MakeProvenance(std::string id, std::string title, std::string source, const std::string& comment) {
  return {.id = std::move(id),
          .version = "1",
          .title = std::move(title),
          .campaign = "",
          .attributes = {
              {"source", std::move(source)},
              {"references",
               "Birkebak, M., Eren, F., Pe'eri, S., Weston, N. (2018): The Effect of Surface Waves on Airborne "
               "Lidar Bathymetry (ALB) Measurement Uncertainties. Remote Sensing 10(3), 453, "
               "doi:10.3390/rs10030453"},
              {"license", "CC BY 4.0, https://creativecommons.org/licenses/by/4.0/"},
              {"comment", comment + kAlongTheWind},
              {"component", "sea surface only: no water column, air side, platform or system"},
              {"refractive_index", kRefractiveIndex},
              {"program_version", std::string(Version())},
              {"date_created", DateCreated()},
          }};
}

absl::StatusOr<UncertaintyTable> Make(const TableNodes& nodes, const AnglesAt& angles_at, Provenance provenance) {
  ASSIGN_OR_RETURN(
      UncertaintyTable::Axes axes,
      AxesOfKind(kSeaSurface,
                 {nodes.wind_speeds, {kFetch}, nodes.incidences, {kAzimuth}, nodes.footprints, nodes.depths}));
  return UncertaintyTable::Create(std::move(axes), MakeVariables(nodes, angles_at), std::move(provenance));
}

}  // namespace

absl::StatusOr<UncertaintyTable> MeasuredTable(const PublishedAngles& table_4) {
  TableNodes nodes{table_4.wind_speeds, table_4.incidences, {0.25}, {}};
  for (int depth = 1; depth <= 10; ++depth) nodes.depths.push_back(depth);
  std::size_t cell = 0;  // the cells are in the order of the nodes
  const auto angles = [&](double, double, double) {
    const PublishedAngles::Cell& measured = table_4.cells[cell++];
    return Angles{measured.along, measured.cross};
  };
  return Make(
      nodes, angles,
      MakeProvenance("birkebak2018-measured", "Birkebak et al. (2018), Table 4: refraction measured in a wave tank",
                     "Measured angles of a published table, THU and TVU from them by its angle method (Eq. "
                     "24-26)",
                     "Measured with an array of 6 x 6 photodiodes 0.25 m below the water of a wave tank, 3.5 "
                     "to 8.5 m from a fan, the plane of incidence along the wind. The array samples the beam "
                     "at 36 points: much of these angles may be the sampling of caustics rather than the "
                     "motion of the beam. Depths are extrapolated from 0.25 m by the angle method. THU and "
                     "TVU take the angle in still water as theta and the root of the summed squares of both "
                     "axes as delta theta."));
}

absl::StatusOr<UncertaintyTable> ModelTable() {
  TableNodes nodes{{2, 2.5, 3, 3.5, 4, 5.25}, {}, {}, {1, 10}};  // THU and TVU are proportional to depth
  for (int incidence = 0; incidence <= 20; ++incidence) nodes.incidences.push_back(incidence);
  for (int i = 0; i <= 16; ++i) nodes.footprints.push_back(static_cast<float>(0.25 * std::pow(2, i / 4.0)));
  const auto angles = [](double wind_speed, double incidence, double footprint) {
    return Angles{kPublishedAlongWind(wind_speed, incidence) * PublishedAlongWindDiameterFactor(footprint),
                  kPublishedCrossWind(wind_speed, incidence) * PublishedCrossWindDiameterFactor(footprint)};
  };
  return Make(
      nodes, angles,
      MakeProvenance("birkebak2018-model", "Birkebak et al. (2018), Eq. 27-30: the fit to its simulated refraction",
                     "Equations of a published fit to its Monte Carlo simulation, THU and TVU from them by "
                     "its angle method (Eq. 24-26)",
                     "Eq. 27 and 28 with 0.0276 theta and 0.0281 theta (printed a decimal smaller, against "
                     "Table 3), Eq. 29 and 30 as the ratio to their value at 0.25 m (as printed they are not "
                     "1 there); winds, incidences and diameters of Table 1, the plane of incidence along the "
                     "wind. THU and TVU take the angle in still water as theta and the root of the summed "
                     "squares of both axes as delta theta."));
}

}  // namespace albtpu
