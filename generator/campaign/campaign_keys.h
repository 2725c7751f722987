// The keys of a campaign file: the list by which they are read and checked, and of which docs/campaign.md is made.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "generator/campaign/campaign_file.h"
#include "generator/surface/discretization.h"
#include "sea/response/closed_form.h"
#include "sea/sea_state.h"

namespace albtpu {

// The values that a key takes.
struct AnyText {
  std::string_view rule;  // what it must be, for people; checked elsewhere
};
struct Choice {
  std::span<const std::string_view> words;
};
struct NumberRange {
  double least, most;  // both included
};
struct WholeRange {
  std::int64_t least, most;  // both included
};
struct NodeRange {
  double least;  // of the first node
  bool includes_least;
  double most;  // of the last node, included
  std::string_view why_most = {};
};
using KeyValues = std::variant<AnyText, Choice, NumberRange, WholeRange, NodeRange>;

// The default of a key.
struct Required {};
struct Derived {
  std::string_view rule;  // for people; implemented where the key is read
};
using KeyDefault = std::variant<Required, Derived, std::string_view, double, std::int64_t>;

struct CampaignKey {
  std::string_view table;  // empty for keys before the first table of the file
  std::string_view name;
  KeyValues values;
  std::string_view unit;  // empty if there is none
  KeyDefault absent;
  std::string_view meaning;
};

namespace campaign_keys {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr std::int64_t kMaxRealizations = 10'000'000;
inline constexpr int kMaxRealizationsUnlessGiven = 40'000;

// m. The shortest waves of the spectra have 0.5 mm and 2 mm. A narrower footprint sees what this one sees, within some
// per cent; from 0.01 mm down the coordinates of its rays are too coarse in single precision.
inline constexpr double kMinFootprint = 1e-3;

inline constexpr std::string_view kKinds[] = {"sea_surface", "water_column"};
inline constexpr std::string_view kProfiles[] = {"uniform", "gaussian"};
inline constexpr std::string_view kEstimators[] = {"control_variate", "plain"};
inline constexpr std::string_view kNodeValues[] = {"exact", "balanced"};

// clang-format off
inline constexpr CampaignKey kId = {
    "", "id", AnyText{"lowercase letters, digits, `-` and `_`, beginning with a letter or a digit"}, "", Required{},
    "Name of the table."};
inline constexpr CampaignKey kVersion = {
    "", "version", AnyText{"not empty"}, "", Required{},
    "Distinguishes tables of the same name."};
inline constexpr CampaignKey kTitle = {
    "", "title", AnyText{"one line"}, "", Required{},
    "What the table is for, in words."};
inline constexpr CampaignKey kKind = {
    "", "kind", Choice{kKinds}, "", std::string_view("sea_surface"),
    "What the table is of. Each kind has keys of its own; `id`, `version`, `title` and `seed` are the same."};
inline constexpr CampaignKey kSeed = {
    "", "seed", WholeRange{0, std::numeric_limits<std::int64_t>::max()}, "", std::int64_t{1},
    "Seed of all random numbers. The same program on the same kind of processor makes the same table from the "
    "same seed."};

inline constexpr CampaignKey kWindSpeed = {
    "axes", "wind_speed", NodeRange{0, true, kInfinity}, "m/s", Required{},
    "Wind speed at 10 m above the sea. A wind of 0 raises no waves: all values there are exactly 0."};
inline constexpr CampaignKey kFetch = {
    "axes", "fetch", NodeRange{0, false, kInfinity}, "m", Required{},
    "Fetch. The last node must be `inf`, the fully developed sea; all others must be below the fetch of full "
    "development of the strongest wind. Interpolated on a log scale."};
inline constexpr CampaignKey kIncidence = {
    "axes", "incidence", NodeRange{0, true, 60, "waves would hide behind each other, which is not modelled"}, "degree",
    Required{},
    "Angle of the beam from the vertical, in air. At the strongest wind, slopes along the beam of three standard "
    "deviations must face it."};
inline constexpr CampaignKey kAzimuth = {
    "axes", "azimuth", NodeRange{0, true, 90, "azimuths are folded into 0 to 90 degrees by symmetry"}, "degree",
    Required{},
    "Horizontal direction of the beam from downwind."};
inline constexpr CampaignKey kFootprint = {
    "axes", "footprint", NodeRange{kMinFootprint, true, kInfinity}, "m", Required{},
    "Diameter of the beam at the mean surface, across its axis. Interpolated on a log scale."};
inline constexpr CampaignKey kDepth = {
    "axes", "depth", NodeRange{0, true, kInfinity}, "m", Required{},
    "Depth of the bottom below the located surface."};

inline constexpr CampaignKey kProfile = {
    "beam", "profile", Choice{kProfiles}, "", std::string_view("uniform"),
    "Irradiance across the beam. `footprint` is the diameter of a uniform beam, and of a gaussian one where its "
    "irradiance is 1/e^2 of that on the axis."};
inline constexpr CampaignKey kSourceHeight = {
    "beam", "source_height", NumberRange{0.1, kInfinity}, "m", kInfinity,
    "Height of the point source that the beam diverges from, at least six standard deviations of the surface's "
    "elevation. `inf` is a collimated beam."};

inline constexpr CampaignKey kRefractiveIndexOfWater = {
    "water", "refractive_index", NumberRange{1.01, 2}, "", kRefractiveIndex,
    "Index of refraction of the water relative to air."};

inline constexpr CampaignKey kSpectrum = {
    "sea", "spectrum", Choice{kSpectrumKeys}, "", std::string_view("apel"),
    "Spectrum of the waves."};
inline constexpr CampaignKey kSpreading = {
    "sea", "spreading", NumberRange{0.5, 30}, "", Derived{"2 for `apel`"},
    "Exponent s of the cosine-2S spreading of `apel`. Not allowed with `elfouhaily`, which has its own spreading."};
inline constexpr CampaignKey kCorrectedAbove = {
    "sea", "corrected_above", NumberRange{0.1, kInfinity}, "m", kInfinity,
    "Waves longer than this are left out: the local slope of the surface was measured and refraction corrected for "
    "it."};

inline constexpr CampaignKey kRealizations = {
    "effort", "realizations", WholeRange{2, kMaxRealizations}, "", std::int64_t{1000},
    "Random surfaces for each beam, at least."};
inline constexpr CampaignKey kRelativeError = {
    "effort", "relative_error", NumberRange{1e-4, 0.5}, "", Derived{"none: exactly `realizations`"},
    "Add realizations until refraction, THU and TVU have this relative standard error where they are at least 0.01 "
    "degrees or 1 mm."};
inline constexpr CampaignKey kMaxRealizationsOfBeam = {
    "effort", "most_realizations", WholeRange{2, kMaxRealizations}, "",
    Derived{"40000, or `realizations` if that is more"},
    "Stop at this number even if `relative_error` is not reached. At least `realizations`; used only with "
    "`relative_error`."};
inline constexpr CampaignKey kEstimator = {
    "effort", "estimator", Choice{kEstimators}, "", std::string_view("control_variate"),
    "`control_variate` computes from the slopes of each surface what is known in closed form and traces the "
    "difference; `plain` is ray tracing alone, slower for the same error."};
inline constexpr CampaignKey kRays = {
    "effort", "rays", WholeRange{100, kMaxRays}, "", Derived{"chosen from spectrum and footprint"},
    "Rays of each beam."};

inline constexpr CampaignKey kNodes = {
    "interpolation", "nodes", Choice{kNodeValues}, "", std::string_view("exact"),
    "`balanced` shifts node values by a twelfth of their second difference along each axis but depth, which nearly "
    "halves the rms error of interpolation; `exact` keeps them as computed."};
inline constexpr CampaignKey kCheckedPulses = {
    "interpolation", "checked_pulses", WholeRange{1, 10'000}, "", std::int64_t{40},
    "Random pulses between the nodes at which the table is compared with direct computation, which gives its "
    "interpolation error."};

// Of the water column. Lengths are over the depth (tables/water/water_schema.h).
inline constexpr CampaignKey kBackscatterFraction = {
    "axes", "backscatter_fraction", NodeRange{0.002, true, 0.1, "no natural water has more"}, "", Required{},
    "Share of scattered light that turns back, of the phase function of Fournier and Forand."};
inline constexpr CampaignKey kScatteringOverAbsorption = {
    "axes", "scattering_over_absorption", NodeRange{0.05, true, 50, "the walk of photons would take too long"}, "",
    Required{}, "Scattering over absorption of the water: 4 at an albedo of 0.8."};
inline constexpr CampaignKey kIncidenceOnWater = {
    "axes", "incidence", NodeRange{0, true, 50, "footprints would be far longer than wide"}, "degree", Required{},
    "Angle of the beam from the vertical, in air. The first is 0."};
inline constexpr CampaignKey kOpticalDepth = {
    "axes", "optical_depth", NodeRange{0.01, true, 8, "hardly any echo comes back"}, "", Required{},
    "sqrt(a^2 + 6 B a b) times the depth, of absorption a, scattering b and backscatter fraction B."};
inline constexpr CampaignKey kFieldOfView = {
    "axes", "field_of_view", NodeRange{0.01, true, 1000, "the last node stands for all of the surface"}, "", Required{},
    "Diameter of the disc on the surface that the receiver sees. The last node is computed without limit."};
inline constexpr CampaignKey kPulseLength = {
    "axes", "pulse_length", NodeRange{0.001, true, 1.5, "an echo is kept up to five depths below the bottom"}, "",
    Required{}, "Length of the pulse at half its maximum, in water, over twice the depth."};
inline constexpr CampaignKey kGroupIndex = {
    "water", "group_index", NumberRange{1.01, 2}, "", kSeaWaterGroupIndex,
    "Index of the group, which delays the pulse."};
inline constexpr CampaignKey kPhotons = {
    "effort", "photons", WholeRange{1000, 10'000'000}, "", std::int64_t{60'000},
    "Photons of each of eight pools at b/a = 4, and in proportion to b/a from 1.4 to 7.2."};
inline constexpr CampaignKey kPairs = {
    "effort", "pairs_per_photon", WholeRange{1, 100}, "", std::int64_t{3},
    "Pairs of one photon down and another up, for each photon."};
inline constexpr CampaignKey kCheckedBeams = {
    "interpolation", "checked_pulses", WholeRange{1, 10'000}, "", std::int64_t{200},
    "Random waters, depths and systems between the nodes at which the table is compared with direct computation, "
    "which gives its interpolation error."};
// clang-format on

}  // namespace campaign_keys

// All of them, in the order of the reference.
inline constexpr std::array kCampaignKeys = {
    campaign_keys::kId,
    campaign_keys::kVersion,
    campaign_keys::kTitle,
    campaign_keys::kSeed,
    campaign_keys::kWindSpeed,
    campaign_keys::kFetch,
    campaign_keys::kIncidence,
    campaign_keys::kAzimuth,
    campaign_keys::kFootprint,
    campaign_keys::kDepth,
    campaign_keys::kProfile,
    campaign_keys::kSourceHeight,
    campaign_keys::kRefractiveIndexOfWater,
    campaign_keys::kSpectrum,
    campaign_keys::kSpreading,
    campaign_keys::kCorrectedAbove,
    campaign_keys::kRealizations,
    campaign_keys::kRelativeError,
    campaign_keys::kMaxRealizationsOfBeam,
    campaign_keys::kEstimator,
    campaign_keys::kRays,
    campaign_keys::kNodes,
    campaign_keys::kCheckedPulses,
};

// Those of a table of the water column beside id, version, title and seed.
inline constexpr std::array kWaterCampaignKeys = {
    campaign_keys::kKind,
    campaign_keys::kBackscatterFraction,
    campaign_keys::kScatteringOverAbsorption,
    campaign_keys::kIncidenceOnWater,
    campaign_keys::kOpticalDepth,
    campaign_keys::kFieldOfView,
    campaign_keys::kPulseLength,
    campaign_keys::kRefractiveIndexOfWater,
    campaign_keys::kGroupIndex,
    campaign_keys::kPhotons,
    campaign_keys::kPairs,
    campaign_keys::kCheckedBeams,
};

// Each reads a key of one kind of values, checks its range, and returns its default where it is missing, or nothing (an
// empty text) if the default is Derived. CampaignFile::Finish returns the problem, if there is one.
std::string ReadText(CampaignFile& file, const CampaignKey& key);  // AnyText or Choice
std::optional<double> ReadNumber(CampaignFile& file, const CampaignKey& key);
std::optional<std::int64_t> ReadWhole(CampaignFile& file, const CampaignKey& key);
std::vector<double> ReadNodes(CampaignFile& file, const CampaignKey& key);  // see NodesProblem

// The problem of nodes from ReadNodes, which are at least one; empty if there is none. Their order is checked by
// Axis::Create.
std::string NodesProblem(const CampaignKey& key, const std::vector<double>& nodes);

// "effort.rays".
inline std::string FullName(const CampaignKey& key) { return FullName(key.table, key.name); }

// The reference of all keys, docs/campaign.md.
std::string CampaignReference();

}  // namespace albtpu
