// The enums of the wire and ours. Those of the wire list the values of ours in the same order, after "unspecified".
#pragma once

#include <optional>
#include <type_traits>

#include "albtpu/v1/budget.pb.h"
#include "albtpu/v1/pulse.pb.h"
#include "albtpu/v1/sea.pb.h"
#include "albtpu/v1/table.pb.h"
#include "albtpu/v1/uncertainty.pb.h"
#include "albtpu/v1/water.pb.h"
#include "budget/air/air_errors.h"
#include "budget/query/budget_query.h"
#include "budget/water/water_optics.h"
#include "budget/water/water_receiver.h"
#include "sea/spectra/spectral_tail.h"
#include "tables/coverage.h"
#include "tables/query/interpolation.h"
#include "tables/s44.h"
#include "tables/schema.h"

namespace albtpu {

template <typename Enum>
struct OnWire;
template <>
struct OnWire<AxisId> : std::type_identity<v1::Axis> {};
template <>
struct OnWire<Quantity> : std::type_identity<v1::Quantity> {};
template <>
struct OnWire<Scale> : std::type_identity<v1::Scale> {};
template <>
struct OnWire<Outcome> : std::type_identity<v1::Outcome> {};
template <>
struct OnWire<S44Order> : std::type_identity<v1::S44Order> {};
template <>
struct OnWire<SurfaceLocation> : std::type_identity<v1::SurfaceLocation> {};
template <>
struct OnWire<BudgetQuantity> : std::type_identity<v1::BudgetQuantity> {};
template <>
struct OnWire<TailRule> : std::type_identity<v1::TailRule> {};
template <>
struct OnWire<KdKind> : std::type_identity<v1::KdKind> {};
template <>
struct OnWire<EchoDetector> : std::type_identity<v1::EchoDetector> {};
template <>
struct OnWire<BiasHandling> : std::type_identity<v1::BiasHandling> {};

template <typename Enum>
constexpr typename OnWire<Enum>::type ToWire(Enum value) {
  return static_cast<typename OnWire<Enum>::type>(static_cast<int>(value) + 1);
}

static_assert(ToWire(AxisId::kWindSpeed) == v1::AXIS_WIND_SPEED);
static_assert(ToWire(AxisId::kFetch) == v1::AXIS_FETCH);
static_assert(ToWire(AxisId::kIncidence) == v1::AXIS_INCIDENCE);
static_assert(ToWire(AxisId::kAzimuth) == v1::AXIS_AZIMUTH);
static_assert(ToWire(AxisId::kFootprint) == v1::AXIS_FOOTPRINT);
static_assert(ToWire(AxisId::kDepth) == v1::AXIS_DEPTH);

static_assert(ToWire(Quantity::kRefractionAlongWind) == v1::QUANTITY_REFRACTION_ALONG_WIND);
static_assert(ToWire(Quantity::kRefractionCrossWind) == v1::QUANTITY_REFRACTION_CROSS_WIND);
static_assert(ToWire(Quantity::kThu) == v1::QUANTITY_THU);
static_assert(ToWire(Quantity::kTvu) == v1::QUANTITY_TVU);
static_assert(ToWire(Quantity::kBiasAlongBeam) == v1::QUANTITY_BIAS_ALONG_BEAM);
static_assert(ToWire(Quantity::kBiasVertical) == v1::QUANTITY_BIAS_VERTICAL);

static_assert(ToWire(Outcome::kInterpolated) == v1::OUTCOME_INTERPOLATED);
static_assert(ToWire(Outcome::kOutOfDomain) == v1::OUTCOME_OUT_OF_DOMAIN);
static_assert(ToWire(Outcome::kInvalid) == v1::OUTCOME_INVALID);

static_assert(ToWire(S44Order::kExclusive) == v1::S44_ORDER_EXCLUSIVE);
static_assert(ToWire(S44Order::kSpecial) == v1::S44_ORDER_SPECIAL);
static_assert(ToWire(S44Order::k1a) == v1::S44_ORDER_1A);
static_assert(ToWire(S44Order::k1b) == v1::S44_ORDER_1B);
static_assert(ToWire(S44Order::k2) == v1::S44_ORDER_2);

static_assert(ToWire(SurfaceLocation::kPulse) == v1::SURFACE_LOCATION_PULSE);
static_assert(ToWire(SurfaceLocation::kLocal) == v1::SURFACE_LOCATION_LOCAL);
static_assert(ToWire(SurfaceLocation::kLevel) == v1::SURFACE_LOCATION_LEVEL);

static_assert(ToWire(BudgetQuantity::kTotalThu) == v1::BUDGET_QUANTITY_TOTAL_THU);
static_assert(ToWire(BudgetQuantity::kTvuSea) == v1::BUDGET_QUANTITY_TVU_SEA);
static_assert(ToWire(BudgetQuantity::kBiasVertical) == v1::BUDGET_QUANTITY_BIAS_VERTICAL);
static_assert(ToWire(BudgetQuantity::kCovarianceTotal) == v1::BUDGET_QUANTITY_COVARIANCE_TOTAL);
static_assert(ToWire(BudgetQuantity::kCovarianceSurvey) == v1::BUDGET_QUANTITY_COVARIANCE_SURVEY);
static_assert(ToWire(BudgetQuantity::kBestS44Order) == v1::BUDGET_QUANTITY_BEST_S44_ORDER);
static_assert(ToWire(BudgetQuantity::kTvuWater) == v1::BUDGET_QUANTITY_TVU_WATER);

static_assert(ToWire(TailRule::kWind) == v1::TAIL_RULE_WIND);
static_assert(ToWire(TailRule::kRelax) == v1::TAIL_RULE_RELAX);
static_assert(ToWire(TailRule::kLevel) == v1::TAIL_RULE_LEVEL);
static_assert(ToWire(TailRule::kNone) == v1::TAIL_RULE_NONE);

static_assert(ToWire(KdKind::kSatellite490) == v1::KD_KIND_SATELLITE490);
static_assert(ToWire(KdKind::kDiffuse532) == v1::KD_KIND_DIFFUSE532);
static_assert(ToWire(KdKind::kSystem) == v1::KD_KIND_SYSTEM);
static_assert(ToWire(KdKind::kSecchi) == v1::KD_KIND_SECCHI);
static_assert(ToWire(KdKind::kJerlov) == v1::KD_KIND_JERLOV);

static_assert(ToWire(EchoDetector::kPeak) == v1::ECHO_DETECTOR_PEAK);
static_assert(ToWire(EchoDetector::kHalf) == v1::ECHO_DETECTOR_HALF);
static_assert(ToWire(EchoDetector::kCentroid) == v1::ECHO_DETECTOR_CENTROID);

static_assert(ToWire(BiasHandling::kNone) == v1::BIAS_HANDLING_NONE);
static_assert(ToWire(BiasHandling::kCorrect) == v1::BIAS_HANDLING_CORRECT);
static_assert(ToWire(BiasHandling::kVendor) == v1::BIAS_HANDLING_VENDOR);
static_assert(ToWire(BiasHandling::kCalibrated) == v1::BIAS_HANDLING_CALIBRATED);

static_assert(ToWire(Scale::kLinear) == v1::SCALE_LINEAR && ToWire(Scale::kLog) == v1::SCALE_LOG);

template <typename Enum>
constexpr typename OnWire<Enum>::type ToWire(std::optional<Enum> value) {  // Unspecified if none.
  return value ? ToWire(*value) : typename OnWire<Enum>::type{};
}

// The exception: its orders differ.
constexpr v1::Coverage ToWire(Coverage coverage) {
  if (coverage == Coverage::kTwoSigma) return v1::COVERAGE_TWO_SIGMA;
  return coverage == Coverage::kP95 ? v1::COVERAGE_P95 : v1::COVERAGE_ONE_SIGMA;
}

}  // namespace albtpu
