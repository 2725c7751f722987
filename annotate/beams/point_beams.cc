#include "annotate/beams/point_beams.h"

#include <cmath>
#include <limits>

#include "budget/beams/beam_columns.h"
#include "sea/angle.h"

namespace albtpu::annotate {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// In [0, 360).
double FullCircle(double degrees) {
  const double turned = std::fmod(degrees, 360);
  return turned < 0 ? turned + 360 : turned;
}

// As float32, in which an angle just below 360 rounds to 360.
float Direction(double degrees) {
  const auto direction = static_cast<float>(FullCircle(degrees));
  return direction >= 360 ? 0 : direction;
}

double FootprintOf(const BeamPlan& plan, double slant_range) {
  const auto* beam = std::get_if<DivergingBeam>(&plan.footprint);
  if (beam == nullptr) return std::get<float>(plan.footprint);
  return FootprintDiameter(slant_range, beam->divergence * 1e-3, beam->aperture);  // mrad
}

}  // namespace

double AcrossTrackAzimuth(double flight_direction, double scan_angle) {
  return scan_angle < 0 ? flight_direction - 90 : flight_direction + 90;
}

void BeamGeometry::Compute(const SurveyPoints& points, BeamScratch& scratch, PointBeams& beams) const {
  const std::size_t count = points.size();
  for (std::vector<float>* column :
       {&beams.incidence, &beams.beam_azimuth, &beams.azimuth, &beams.footprint, &beams.depth, &beams.slant_range})
    column->assign(count, kNan);
  beams.why_not.assign(count, std::nullopt);
  beams.dry = points.dry;
  beams.dry.resize(count);
  beams.surface = {};
  Locate(points, scratch, beams);
  if (plan_.has_track())
    FromTrack(points, scratch, beams);
  else
    FromAngles(points, scratch, beams);
  if (plan_.any_aircraft) FindAircraft(points, scratch, beams);
}

void BeamGeometry::FindAircraft(const SurveyPoints& points, const BeamScratch& scratch, PointBeams& beams) const {
  const std::size_t count = points.size();
  AircraftColumns& aircraft = beams.aircraft;
  std::vector<float>& altitudes = aircraft[BudgetInput::kAltitude];
  altitudes.resize(count);
  beams.convergence.resize(count);
  for (std::size_t i = 0; i < kMotionInputs; ++i)
    aircraft[BudgetInput::kRoll + i].resize(motions_ != nullptr ? count : 0);
  if (plan_.has_track()) {
    for (std::size_t i = 0; i < count; ++i) {
      altitudes[i] = static_cast<float>(scratch.height[i]);
      beams.convergence[i] = static_cast<float>(scratch.convergence[i]);
    }
  } else {
    const auto* scan = std::get_if<AcrossTrackScan>(&plan_.source);
    const std::optional<double> altitude =
        scan != nullptr ? scan->altitude : std::get<ConstantIncidence>(plan_.source).altitude;
    for (std::size_t i = 0; i < count; ++i) {
      altitudes[i] = static_cast<float>(altitude.value_or(kNan) - scratch.above[i]);
      beams.convergence[i] = static_cast<float>(frame_.ConvergenceAt(frame_.At(points.x[i], points.y[i])));
    }
    if (scan != nullptr && scan->flight_direction.has_value())
      aircraft[BudgetInput::kHeading].assign(count, static_cast<float>(*scan->flight_direction));
  }
  if (motions_ == nullptr) return;
  ForEachMotion(*motions_, points.times, [&](std::size_t i, const SensorMotion& motion) {
    const auto put = [&](BudgetInput input, double number) { aircraft[input][i] = static_cast<float>(number); };
    put(BudgetInput::kRoll, motion.roll);
    put(BudgetInput::kPitch, motion.pitch);
    put(BudgetInput::kHeading, motion.heading);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      put(BudgetInput::kVelocityNorth + axis, motion.velocity[axis]);
      put(BudgetInput::kRollRate + axis, motion.rates[axis]);
      put(BudgetInput::kPositionSigmaNorth + axis, motion.position_sigma[axis]);
      put(BudgetInput::kRollSigma + axis, motion.attitude_sigma[axis]);
    }
  });
}

void BeamGeometry::Locate(const SurveyPoints& points, BeamScratch& scratch, PointBeams& beams) const {
  water_.At(points, frame_, scratch.heights, beams.surface);
  scratch.depth.resize(points.size());
  scratch.above.assign(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double own = frame_.Z(points.z[i]);
    scratch.depth[i] = scratch.heights[i] - own;
    beams.depth[i] = static_cast<float>(scratch.depth[i]);
    const bool is_above = scratch.depth[i] < 0;
    if (plan_.dry_points && is_above) beams.dry[i] = 1;
    if (beams.dry[i] != 0) {
      if (std::isfinite(scratch.depth[i])) scratch.above[i] = -scratch.depth[i];
      scratch.heights[i] = own;
      scratch.depth[i] = beams.depth[i] = 0;
    } else if (!std::isfinite(scratch.heights[i])) {
      beams.why_not[i] = NoPulse::kNoSurface;
    } else if (is_above) {
      beams.why_not[i] = NoPulse::kAboveWater;
    }
  }
}

void BeamGeometry::FromTrack(const SurveyPoints& points, BeamScratch& scratch, PointBeams& beams) const {
  const std::size_t count = points.size();
  scratch.positions.resize(count);
  scratch.outcomes.resize(count);
  if (count > 0) track_->PositionsAt(points.times, scratch.positions, scratch.outcomes);
  for (std::vector<double>* column : {&scratch.east, &scratch.north, &scratch.height, &scratch.convergence,
                                      &scratch.incidence, &scratch.azimuth, &scratch.slant_range})
    column->resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const SensorPosition& sensor = scratch.positions[i];
    const double dx = frame_.Difference(points.x[i], sensor.x);
    scratch.east[i] = dx * sensor.metres_per_x;
    scratch.north[i] = (points.y[i] - sensor.y) * sensor.metres_per_y + dx * sensor.north_per_x;
    scratch.height[i] = sensor.z - scratch.heights[i];
    scratch.convergence[i] = sensor.convergence;
  }
  ComputeBeams({.east = scratch.east,
                .north = scratch.north,
                .height = scratch.height,
                .depth = scratch.depth,
                .convergence = scratch.convergence},
               plan_.refractive_index,
               {.incidence = scratch.incidence,
                .azimuth = scratch.azimuth,
                .slant_range = scratch.slant_range,
                .water_path = {}});
  const double wind_from = RadiansOfDegrees(FullCircle(plan_.wind_from.value_or(0)));
  for (std::size_t i = 0; i < count; ++i) {
    if (scratch.outcomes[i] != TrackOutcome::kKnown) {
      beams.why_not[i] =
          scratch.outcomes[i] == TrackOutcome::kOutside ? NoPulse::kNoTrajectory : NoPulse::kUncertainTrajectory;
      continue;
    }
    if (beams.why_not[i] == NoPulse::kNoSurface) continue;
    beams.incidence[i] = static_cast<float>(DegreesOfRadians(scratch.incidence[i]));
    beams.beam_azimuth[i] = Direction(DegreesOfRadians(scratch.azimuth[i]));
    if (plan_.wind_from.has_value())
      beams.azimuth[i] = static_cast<float>(DegreesOfRadians(AzimuthFromDownwind(scratch.azimuth[i], wind_from)));
    beams.slant_range[i] = static_cast<float>(scratch.slant_range[i]);
    beams.footprint[i] = static_cast<float>(FootprintOf(plan_, scratch.slant_range[i]));
  }
}

void BeamGeometry::FromAngles(const SurveyPoints& points, const BeamScratch& scratch, PointBeams& beams) const {
  const auto* scan = std::get_if<AcrossTrackScan>(&plan_.source);
  const auto* constant = std::get_if<ConstantIncidence>(&plan_.source);
  const double altitude = (scan != nullptr ? scan->altitude : constant->altitude).value_or(kNan);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double over = altitude - scratch.above[i];
    // A sensor that is not above the point has no beam to it, as with a track.
    const double incidence = over <= 0 ? kNan : scan != nullptr ? std::abs(points.scan_angles[i]) : constant->incidence;
    beams.incidence[i] = static_cast<float>(incidence);
    std::optional<double> direction;
    if (scan == nullptr)
      direction = constant->beam_azimuth;
    else if (scan->flight_direction.has_value())
      direction = AcrossTrackAzimuth(*scan->flight_direction, points.scan_angles[i]);
    if (direction.has_value()) beams.beam_azimuth[i] = Direction(*direction);
    if (direction.has_value() && plan_.wind_from.has_value()) {
      const double downwind = *plan_.wind_from + 180;
      beams.azimuth[i] = static_cast<float>(*direction - downwind);
    }
    const double slant_range = over / std::cos(RadiansOfDegrees(incidence));
    beams.slant_range[i] = static_cast<float>(slant_range);
    beams.footprint[i] = static_cast<float>(FootprintOf(plan_, slant_range));
  }
}

void MakePulses(const BeamPlan& plan, const PointBeams& beams, std::vector<std::uint32_t>& rows, PulseBatch& pulses) {
  rows.clear();
  for (std::size_t i = 0; i < beams.why_not.size(); ++i)
    if (!beams.why_not[i].has_value() && beams.dry[i] == 0) rows.push_back(static_cast<std::uint32_t>(i));
  const auto column = [&](const std::vector<float>& values, std::vector<float>& selected) {
    selected.resize(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) selected[i] = values[rows[i]];
  };
  pulses.size = rows.size();
  pulses[AxisId::kWindSpeed].assign(plan.any_sea ? 0 : 1, plan.wind_speed);
  pulses[AxisId::kFetch].assign(plan.fetch.has_value() ? 1 : 0, plan.fetch.value_or(0));
  column(beams.incidence, pulses[AxisId::kIncidence]);
  column(beams.depth, pulses[AxisId::kDepth]);
  if (const auto* footprint = std::get_if<float>(&plan.footprint))
    pulses[AxisId::kFootprint].assign(1, *footprint);
  else
    column(beams.footprint, pulses[AxisId::kFootprint]);
  pulses[AxisId::kAzimuth].clear();
  if (plan.azimuth.has_value())
    pulses[AxisId::kAzimuth].assign(1, *plan.azimuth);
  else if (plan.any_sea && plan.has_direction())
    column(beams.beam_azimuth, pulses[AxisId::kAzimuth]);
  else if (plan.wind_from.has_value())
    column(beams.azimuth, pulses[AxisId::kAzimuth]);
  pulses.azimuths_from_north = plan.any_sea && !plan.azimuth.has_value();
}

}  // namespace albtpu::annotate
