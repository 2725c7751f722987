// The contribution of the sea surface to the covariance of several pulses at a time, in single precision, of the
// reported point. docs/budget.md, "The sea surface contribution", derives it.
//
// As air_covariance-inl.h: +, -, *, / and square roots in one order, without contraction.

// Once for each instruction set.
#if defined(ALBTPU_BUDGET_SEA_COVARIANCE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ALBTPU_BUDGET_SEA_COVARIANCE_INL
#undef ALBTPU_BUDGET_SEA_COVARIANCE_INL
#else
#define ALBTPU_BUDGET_SEA_COVARIANCE_INL
#endif

#include <hwy/highway.h>

#include "budget/air/air_covariance-inl.h"

HWY_BEFORE_NAMESPACE();
namespace albtpu {
namespace HWY_NAMESPACE {

// As BudgetInputs has them, 2 sigma.
struct SeaNumbers {
  F thu, tvu, along, cross, axis, depth;
};

// A symmetric matrix on two horizontal axes.
struct Symmetric {
  F xx, yy, xy;
};

// On axes where its own first axis has this cosine and sine.
HWY_INLINE Symmetric Turned(const Symmetric& m, F cosine, F sine) {
  const F c2 = cosine * cosine, s2 = sine * sine, sc = sine * cosine, mixed = Constant(2) * (m.xy * sc);
  return {m.xx * c2 + m.yy * s2 - mixed, m.xx * s2 + m.yy * c2 + mixed, (m.xx - m.yy) * sc + m.xy * (c2 - s2)};
}

// Snell's law to first order, where the beam has this sine and cosine on the axes of the sea: the tangent of the
// refracted direction answers to a slope in the plane of the beam 1 / cos^2 r as much as to one across it. In units of
// the gain across the beam.
struct SlopeResponse {
  F xx, yy, xy;

  HWY_INLINE SlopeResponse(F cosine, F sine, F cosine_refracted) {
    const F one = Constant(1), more = one / (cosine_refracted * cosine_refracted) - one;
    xx = one + more * (cosine * cosine);
    yy = one + more * (sine * sine);
    xy = more * (cosine * sine);
  }

  // The variances of slopes, uncorrelated on the axes of the sea, from those of the tangent:
  //     var_x = Gxx^2 s_x + Gxy^2 s_y,  var_y = Gxy^2 s_x + Gyy^2 s_y.
  HWY_INLINE Symmetric SlopesOf(F var_x, F var_y) const {
    const F zero = hn::Zero(Floats()), xx2 = xx * xx, yy2 = yy * yy, xy2 = xy * xy;
    const F scale = Constant(1) / (xx2 * yy2 - xy2 * xy2);
    return {hn::Max(zero, (var_x * yy2 - var_y * xy2) * scale), hn::Max(zero, (var_y * xx2 - var_x * xy2) * scale),
            zero};
  }

  HWY_INLINE F CovarianceOf(const Symmetric& slopes) const { return xy * (xx * slopes.xx + yy * slopes.yy); }
};

// A covariance that is of second order in slope, on axes along (x) and across (y) the beam; p is the path times cos r.
struct SecondOrder {
  F xx, yy, xy, xp, yp, pp;

  HWY_INLINE void Multiply(F factor) {
    xx = factor * xx;
    yy = factor * yy;
    xy = factor * xy;
    xp = factor * xp;
    yp = factor * yp;
    pp = factor * pp;
  }
};

// 1/2 tr(H_i V H_j V) for each metre of depth, by the second derivatives H of Snell's law on level water.
// `slopes` is V on the axes of the beam, in units of the gain across it: g^2 V.
HWY_INLINE SecondOrder SecondOrderOf(const Symmetric& slopes, const BeamNumbers& beam) {
  const F one = Constant(1), two = Constant(2), s = beam.sine_refracted, c = beam.cosine_refracted;
  const F ratio = beam.inverse_index, g = one - beam.cosine * ratio / c;
  // The refracted ray is parallel to (k + l m, -1) where the surface has the slope m, k being the horizontal part of
  // the incident ray over n; l and the inverse u of the secant are functions of m: RefractAtSlope in sea/response.
  const F l = hn::Neg(c * g), l_x = s * g;
  const F bend = one - ratio * ratio, root_x = s * (one - g);
  const F l_xx = hn::Neg((bend + s * s - root_x * root_x) / c) - two * l;
  const F l_yy = hn::Neg(bend / c) - two * l;
  const F secant_xx = (l_xx + two * (l_x * l_x) / c) / (c * c), secant_yy = l_yy / (c * c);
  const F scale = hn::IfThenElseZero(g > Constant(1e-4f), one / (g * g));
  const F a = scale * (s * secant_xx - two * (l_x / c) - two * (l * l_x) / (c * c));  // along by slopes along
  const F b = scale * (s * secant_yy);                                                // along by slopes across
  const F q = hn::Neg(scale * (l_x / c + l * l_x / (c * c)));                         // across by both
  const F pa = scale * (c * secant_xx), pb = scale * (c * secant_yy);                 // path by slopes along, across
  const F xx = slopes.xx, yy = slopes.yy, xy = slopes.xy, half = Constant(0.5f);
  const auto form = [&](F a1, F b1, F a2, F b2) HWY_ATTR {
    return half * ((a1 * a2) * (xx * xx) + (b1 * b2) * (yy * yy) + (a1 * b2 + b1 * a2) * (xy * xy));
  };
  return {.xx = form(a, b, a, b),
          .yy = q * q * (xx * yy + xy * xy),
          .xy = q * xy * (a * xx + b * yy),
          .xp = form(a, b, pa, pb),
          .yp = q * xy * (pa * xx + pb * yy),
          .pp = form(pa, pb, pa, pb)};
}

// The factor by which `part` is at most `whole`.
HWY_INLINE F AtMost(F part, F whole) { return hn::IfThenElse(part > whole, whole / part, Constant(1)); }

// From the spot on a level bottom to the reported point: J C J^T (reported_point.h).
HWY_INLINE void TakeReportedPoint(const BeamNumbers& beam, NedCovariance& c) {
  const F tangent = beam.sine_refracted / beam.cosine_refracted, two = Constant(2);
  const F n = tangent * beam.north, e = tangent * beam.east;
  c.nn = c.nn + two * (n * c.nd) + (n * n) * c.dd;
  c.ee = c.ee + two * (e * c.ed) + (e * e) * c.dd;
  c.ne = c.ne + (n * c.ed + e * c.nd) + (n * e) * c.dd;
  c.nd = c.nd + n * c.dd;
  c.ed = c.ed + e * c.dd;
}

HWY_INLINE NedCovariance SeaContributionOf(const SeaNumbers& sea, const BeamNumbers& beam) {
  const Floats d;
  const F one = Constant(1), half = Constant(0.5f), quarter = Constant(0.25f), zero = hn::Zero(d);
  const F along2 = sea.along * sea.along, sum = along2 + sea.cross * sea.cross;
  const auto refracts = sum > zero;
  const auto known = hn::And(sea.axis == sea.axis, refracts);
  const F share = hn::IfThenElse(known, along2 / sum, half);
  const F trace = quarter * (sea.thu * sea.thu);
  const F on_axis = trace * share, across_axis = trace * (one - share);
  const SineAndCosine turn = SineAndCosineOfDegrees(hn::IfThenElseZero(known, sea.axis));
  // Of the beam on the axes of the sea; those of an unknown sea are the beam's.
  const F cosine = hn::IfThenElse(known, beam.north * turn.cosine + beam.east * turn.sine, one);
  const F sine = hn::IfThenElseZero(known, beam.east * turn.cosine - beam.north * turn.sine);
  const SlopeResponse response(cosine, sine, beam.cosine_refracted);

  // Of second order, from the slopes by the refraction, which no depth and no wave height changes.
  const F radian = Constant(0.017453292519943295f);
  const F tangents = hn::IfThenElseZero(refracts, quarter * (radian * radian) * sum);
  SecondOrder second =
      SecondOrderOf(Turned(response.SlopesOf(tangents * share, tangents * (one - share)), cosine, hn::Neg(sine)), beam);
  second.Multiply(sea.depth * sea.depth);
  Symmetric second_on_axes = Turned({second.xx, second.yy, second.xy}, cosine, sine);
  const F held = hn::Min(AtMost(second_on_axes.xx, on_axis), AtMost(second_on_axes.yy, across_axis));
  const F tvu2 = quarter * (sea.tvu * sea.tvu), bent = held * second.pp;
  const F factor = held * AtMost(bent, tvu2);
  second.Multiply(factor);
  second_on_axes = {factor * second_on_axes.xx, factor * second_on_axes.yy, factor * second_on_axes.xy};

  // What is left is of first order: a horizontal error that makes the path shorter by sin r of it.
  const Symmetric slopes = response.SlopesOf(on_axis - second_on_axes.xx, across_axis - second_on_axes.yy);
  const F covariance = hn::IfThenElseZero(known, response.CovarianceOf(slopes) + second_on_axes.xy);
  const F turn_cosine = hn::IfThenElse(known, turn.cosine, beam.north);
  const F turn_sine = hn::IfThenElse(known, turn.sine, beam.east);
  const Symmetric spot = Turned({on_axis, across_axis, covariance}, turn_cosine, turn_sine);
  const Symmetric bend = Turned({second.xx, second.yy, second.xy}, beam.north, beam.east);
  const F north = (spot.xx - bend.xx) * beam.north + (spot.xy - bend.xy) * beam.east;
  const F east = (spot.xy - bend.xy) * beam.north + (spot.yy - bend.yy) * beam.east;
  const F in_plane = north * beam.north + east * beam.east;
  const F left = hn::IfThenElseZero(bent < tvu2, tvu2 - second.pp);
  const F by_snell = beam.sine_refracted * beam.cosine_refracted;
  const F lift = hn::IfThenElse(by_snell * by_snell * in_plane > left, hn::Sqrt(left / in_plane), by_snell);
  NedCovariance c;
  c.nn = spot.xx;
  c.ee = spot.yy;
  c.ne = spot.xy;
  c.dd = tvu2;
  c.nd = hn::Neg(lift * north + (second.xp * beam.north - second.yp * beam.east));
  c.ed = hn::Neg(lift * east + (second.xp * beam.east + second.yp * beam.north));
  TakeReportedPoint(beam, c);
  return c;
}

}  // namespace HWY_NAMESPACE
}  // namespace albtpu
HWY_AFTER_NAMESPACE();

#endif
