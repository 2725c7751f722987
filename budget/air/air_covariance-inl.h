// The covariance of the air side of several pulses at a time, in single precision. air_sources.h is the obvious twin
// and explains the symbols.
//
// Sources that include this must be compiled without contraction of a * b + c (-ffp-contract=off): only +, -, *, /,
// square roots and floor in one order, so that every processor has the same bits.

// Once for each instruction set.
#if defined(ALBTPU_BUDGET_AIR_COVARIANCE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ALBTPU_BUDGET_AIR_COVARIANCE_INL
#undef ALBTPU_BUDGET_AIR_COVARIANCE_INL
#else
#define ALBTPU_BUDGET_AIR_COVARIANCE_INL
#endif

#include <hwy/highway.h>

#include "budget/air/air_sources.h"

HWY_BEFORE_NAMESPACE();
namespace albtpu {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using F = hn::Vec<Floats>;  // One number of each pulse.

HWY_INLINE F Constant(float value) { return hn::Set(Floats(), value); }

struct SineAndCosine {
  F sine, cosine;
};

// Of `degrees`, up to some thousands in magnitude; NaN of NaN. Errors below 1.2e-7. Multiples of 90 degrees are exact.
HWY_INLINE SineAndCosine SineAndCosineOfDegrees(F degrees) {
  const F quarter = hn::Floor(degrees * Constant(1.0f / 90) + Constant(0.5f));
  // In [-pi/4, pi/4]; the difference is exact.
  const F x = (degrees - quarter * Constant(90)) * Constant(0.017453292519943295f);
  const F x2 = x * x, one = Constant(1);
  // Taylor's series; what is left out is below 4e-9 and 3e-8.
  const F s = x + x * x2 *
                      (Constant(-1.0f / 6) +
                       x2 * (Constant(1.0f / 120) + x2 * (Constant(-1.0f / 5040) + x2 * Constant(1.0f / 362880))));
  const F c = one + x2 * (Constant(-0.5f) +
                          x2 * (Constant(1.0f / 24) + x2 * (Constant(-1.0f / 720) + x2 * Constant(1.0f / 40320))));
  const F turn = quarter - Constant(4) * hn::Floor(quarter * Constant(0.25f));  // 0, 1, 2 or 3.
  const auto first = turn == one, third = turn == Constant(3), back = turn >= Constant(2);
  const auto swapped = hn::Or(first, third);
  const F sine = hn::IfThenElse(swapped, c, s), cosine = hn::IfThenElse(swapped, s, c);
  const auto turned = hn::Or(first, turn == Constant(2));
  return {hn::IfThenElse(back, hn::Neg(sine), sine), hn::IfThenElse(turned, hn::Neg(cosine), cosine)};
}

// Vectors on the axes north, east, down.
struct Ned {
  F n, e, d;
};
HWY_INLINE Ned operator+(const Ned& a, const Ned& b) { return {a.n + b.n, a.e + b.e, a.d + b.d}; }
HWY_INLINE Ned operator*(F s, const Ned& a) { return {s * a.n, s * a.e, s * a.d}; }
HWY_INLINE Ned Cross(const Ned& a, const Ned& b) {
  return {a.e * b.d - a.d * b.e, a.d * b.n - a.n * b.d, a.n * b.e - a.e * b.n};
}

// Symmetric matrices, m^2.
struct NedCovariance {
  F nn, ee, dd, ne, nd, ed;

  // Adds that of an error of this vector times a standard normal number.
  HWY_INLINE void Add(const Ned& a) {
    nn = nn + a.n * a.n;
    ee = ee + a.e * a.e;
    dd = dd + a.d * a.d;
    ne = ne + a.n * a.e;
    nd = nd + a.n * a.d;
    ed = ed + a.e * a.d;
  }
};
HWY_INLINE NedCovariance NoCovariance() {
  const F zero = hn::Zero(Floats());
  return {zero, zero, zero, zero, zero, zero};
}
HWY_INLINE NedCovariance operator+(const NedCovariance& a, const NedCovariance& b) {
  return {a.nn + b.nn, a.ee + b.ee, a.dd + b.dd, a.ne + b.ne, a.nd + b.nd, a.ed + b.ed};
}

// AirPulse (air_sources.h) in columns.
struct AirNumbers {
  F incidence, beam_azimuth, altitude, depth;  // degree, degree, m, m
  F roll, pitch, heading;                      // degree
  Ned velocity;                                // m/s
  F roll_rate, pitch_rate, yaw_rate;           // degree/s
  Ned position_sigma;                          // m
  F roll_sigma, pitch_sigma, heading_sigma;    // degree
};

// The directions of beams that other shares need, too.
struct BeamNumbers {
  F cosine, inverse_index;             // Of the angle in air; 1 / n.
  F sine_refracted, cosine_refracted;  // Of the angle in water.
  F north, east;                       // Where the beam travels to, of length 1.
  Ned surface;                         // What one metre of the height of the surface does: -k / c.
};

struct AirContribution {
  NedCovariance pulse, line, survey;
  BeamNumbers beam;
};

// How errors of the direction in air and of the position move the point.
struct PointErrors {
  F slant_range, by_north_east, bend;
  Ned u, k_over_c;

  // dB/du on a vector; `given` is 1 where the height of the surface is given.
  HWY_INLINE Ned ByDirection(const Ned& v, F given) const {
    const F fall = slant_range * given * v.d;
    return {by_north_east * v.n - fall * k_over_c.n, by_north_east * v.e - fall * k_over_c.e,
            slant_range * v.d - bend * (u.n * v.n + u.e * v.e) - fall * k_over_c.d};
  }
  // dB/dO on a vector.
  HWY_INLINE Ned ByPosition(const Ned& v, F given) const {
    const F fall = given * v.d;
    return {v.n - fall * k_over_c.n, v.e - fall * k_over_c.e, v.d - fall * k_over_c.d};
  }
};

HWY_INLINE AirContribution AirContributionOf(const AirNumbers& pulse, const AirConstants& is) {
  const F zero = hn::Zero(Floats()), one = Constant(1), radian = Constant(0.017453292519943295f);
  const F inverse_index = Constant(is.inverse_index), inverse_square = Constant(is.inverse_square_index);
  const F given = Constant(is.given);
  const SineAndCosine incidence = SineAndCosineOfDegrees(pulse.incidence);
  const SineAndCosine azimuth = SineAndCosineOfDegrees(pulse.beam_azimuth);
  const F c = incidence.cosine, north = azimuth.cosine, east = azimuth.sine;
  const Ned u = {incidence.sine * north, incidence.sine * east, c};
  const F sine_refracted = incidence.sine * inverse_index;
  const F down = hn::Sqrt((one - sine_refracted) * (one + sine_refracted));
  const Ned w_over_n = {u.n * inverse_square, u.e * inverse_square, down * inverse_index};
  const F inverse_c = one / c, inverse_down = one / down;
  const F slant_range = pulse.altitude * inverse_c, water_path = pulse.depth * inverse_down;
  const Ned k_over_c = inverse_c * Ned{u.n - w_over_n.n, u.e - w_over_n.e, u.d - w_over_n.d};
  const PointErrors point = {slant_range, slant_range + water_path * inverse_index,
                             water_path * inverse_square * inverse_down, u, k_over_c};

  const SineAndCosine roll = SineAndCosineOfDegrees(pulse.roll), pitch = SineAndCosineOfDegrees(pulse.pitch),
                      heading = SineAndCosineOfDegrees(pulse.heading);
  const Ned forward = {heading.cosine * pitch.cosine, heading.sine * pitch.cosine, hn::Neg(pitch.sine)};
  const F cp = heading.cosine * pitch.sine, sp = heading.sine * pitch.sine;
  const Ned right = {cp * roll.sine - heading.sine * roll.cosine, sp * roll.sine + heading.cosine * roll.cosine,
                     pitch.cosine * roll.sine};
  const Ned below = {cp * roll.cosine + heading.sine * roll.sine, sp * roll.cosine - heading.cosine * roll.sine,
                     pitch.cosine * roll.cosine};
  const Ned lever = Constant(is.forward) * forward + Constant(is.right) * right + Constant(is.down) * below;
  const Ned rates =
      (radian * pulse.roll_rate) * forward + (radian * pulse.pitch_rate) * right + (radian * pulse.yaw_rate) * below;
  const Ned by_down = point.ByPosition({zero, zero, one}, given);

  AirContribution contribution;
  NedCovariance& line = contribution.line = NoCovariance();
  line.nn = pulse.position_sigma.n * pulse.position_sigma.n;
  line.ee = pulse.position_sigma.e * pulse.position_sigma.e;
  line.Add(pulse.position_sigma.d * by_down);
  const Ned right_of_heading = {hn::Neg(heading.sine), heading.cosine, zero};
  const Ned vertical = {zero, zero, one};
  line.Add((radian * pulse.roll_sigma) *
           (point.ByDirection(Cross(forward, u), given) + point.ByPosition(Cross(forward, lever), given)));
  line.Add((radian * pulse.pitch_sigma) * (point.ByDirection(Cross(right_of_heading, u), given) +
                                           point.ByPosition(Cross(right_of_heading, lever), given)));
  line.Add((radian * pulse.heading_sigma) *
           (point.ByDirection(Cross(vertical, u), given) + point.ByPosition(Cross(vertical, lever), given)));

  NedCovariance& survey = contribution.survey = NoCovariance();
  const float lever_arm = is.Sigma<&AirErrors::lever_arm>();
  survey.nn = survey.ee = Constant(lever_arm * lever_arm);
  survey.Add(Constant(lever_arm) * by_down);
  survey.Add(Constant(is.Sigma<&AirErrors::boresight>(0)) * point.ByDirection(Cross(forward, u), given));
  survey.Add(Constant(is.Sigma<&AirErrors::boresight>(1)) * point.ByDirection(Cross(right, u), given));
  survey.Add(Constant(is.Sigma<&AirErrors::boresight>(2)) * point.ByDirection(Cross(below, u), given));
  survey.Add(Constant(is.Sigma<&AirErrors::time>()) * (point.ByPosition(pulse.velocity + Cross(rates, lever), given) +
                                                       point.ByDirection(Cross(rates, u), given)));
  survey.Add(Constant(is.Sigma<&AirErrors::range_offset>()) * (given * w_over_n + (one - given) * u));
  survey.Add((Constant(is.Sigma<&AirErrors::index>()) * water_path) *
             Ned{Constant(-2) * w_over_n.n, Constant(-2) * w_over_n.e,
                 sine_refracted * sine_refracted * inverse_index * inverse_down - w_over_n.d});

  NedCovariance& own = contribution.pulse = NoCovariance();
  const F scan = Constant(is.Sigma<&AirErrors::scan>());
  own.Add(scan * point.ByDirection({c * north, c * east, hn::Neg(incidence.sine)}, Constant(is.scan_given)));
  own.Add((scan * point.by_north_east) * Ned{hn::Neg(east), north, zero});
  own.Add(Constant(is.Sigma<&AirErrors::bottom_range>()) * w_over_n);
  const Ned surface = Constant(-1) * k_over_c;
  own.Add((Constant(is.Sigma<&AirErrors::surface_range>()) * c) * k_over_c);
  own.Add(Constant(is.surface_height[0]) * surface);
  line.Add(Constant(is.surface_height[1]) * surface);
  survey.Add(Constant(is.surface_height[2]) * surface);
  contribution.beam = {c, inverse_index, sine_refracted, down, north, east, surface};
  return contribution;
}

}  // namespace HWY_NAMESPACE
}  // namespace albtpu
HWY_AFTER_NAMESPACE();

#endif
