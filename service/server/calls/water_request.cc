#include "service/server/calls/water_request.h"

#include <optional>
#include <string>
#include <string_view>

#include "absl/strings/str_cat.h"
#include "service/server/ground/errors.h"
#include "service/wire_values.h"
#include "status/status_macros.h"

namespace albtpu::server {
namespace {

// Values on the wire begin at 1, those of `Enum` at 0. None where `number` is not on the wire.
template <typename Enum>
std::optional<Enum> ValueOf(int number, int greatest) {
  if (number < 1 || number > greatest) return std::nullopt;
  return static_cast<Enum>(number - 1);
}

class WaterReader {
 public:
  explicit WaterReader(const v1::WaterState& state) : state_(state) {}

  absl::StatusOr<KnownWater> Read() {
    KnownWater water;
    water.optics = Optics();
    water.photons = Optional(state_.has_photons(), "photons", state_.photons(), kPhotonsRange);
    water.temperature = Optional(state_.has_temperature(), "temperature", state_.temperature(), kTemperatureRange);
    water.salinity = Optional(state_.has_salinity(), "salinity", state_.salinity(), kSalinityRange);
    water.processed_with =
        Optional(state_.has_processed_with(), "processed_with", state_.processed_with(), kWaterIndexRange);
    water.green_surface = state_.green_surface();
    ReadIndexes(water);
    if (state_.without_column())
      RefuseColumn();
    else
      water.bias = Bias();
    ReadReceiver(water);
    RETURN_IF_ERROR(violations_.ToStatus());
    if (water.bias.has_value() || water.green_surface || TellsClarity(water.optics))
      RETURN_IF_ERROR(CheckOptics(water.optics));
    return water;
  }

 private:
  static std::string Path(std::string_view field) { return absl::StrCat("water.", std::string(field)); }

  // The problem follows the path in the message.
  void Add(std::string_view field, const std::string& problem) {
    const std::string path = Path(field);
    violations_.Add(path, absl::StrCat(path, " ", problem));
  }

  // The same number, noted if it is wrong.
  double Checked(std::string_view field, double number, const WaterRange& range) {
    if (!(number >= range.least && number <= range.greatest)) {
      const std::string unit = range.unit == "1" ? "" : absl::StrCat(" ", std::string(range.unit));
      Add(field,
          absl::StrCat("is ", number, unit, " (expected ", range.least, " to ", range.greatest, "); correct it"));
    }
    return number;
  }

  std::optional<double> Optional(bool given, std::string_view field, double number, const WaterRange& range) {
    if (!given) return std::nullopt;
    return Checked(field, number, range);
  }

  template <typename Enum>
  std::optional<Enum> Word(std::string_view field, int number, int greatest, const char* name) {
    if (number != 0 && !ValueOf<Enum>(number, greatest).has_value())
      Add(field, absl::StrCat("is ", number, " (expected a value of ", name, "); correct it"));
    return ValueOf<Enum>(number, greatest);
  }

  OpticsInput Optics() {
    OpticsInput optics{
        .kd = Optional(state_.has_kd(), "kd", state_.kd(), kKdRange),
        .kd_kind = Word<KdKind>("kd_kind", state_.kd_kind(), v1::KdKind_MAX, "KdKind"),
        .secchi = Optional(state_.has_secchi(), "secchi", state_.secchi(), kSecchiRange),
        .absorption = Optional(state_.has_absorption(), "absorption", state_.absorption(), kAbsorptionRange),
        .scattering = Optional(state_.has_scattering(), "scattering", state_.scattering(), kScatteringRange),
        .kd_sigma = Optional(state_.has_kd_sigma(), "kd_sigma", state_.kd_sigma(), kKdSigmaRange),
        .omega0 = Optional(state_.has_omega0(), "omega0", state_.omega0(), kAlbedoRange),
        .omega0_sigma = Optional(state_.has_omega0_sigma(), "omega0_sigma", state_.omega0_sigma(), kAlbedoSigmaRange),
        .backscatter_fraction = Optional(state_.has_backscatter_fraction(), "backscatter_fraction",
                                         state_.backscatter_fraction(), kBackscatterRange)};
    static_assert(v1::JerlovType_MAX == kJerlovTypes.size());
    const std::optional<std::size_t> jerlov =
        Word<std::size_t>("jerlov", state_.jerlov(), v1::JerlovType_MAX, "JerlovType");
    if (jerlov.has_value()) optics.jerlov = kJerlovTypes[*jerlov];
    return optics;
  }

  void ReadIndexes(const KnownWater& water) {
    const bool alone = water.temperature.has_value() != water.salinity.has_value();
    if (alone) {
      Add(water.temperature.has_value() ? "salinity" : "temperature",
          "is missing (temperature and salinity give the index together); give both");
    } else if (water.processed_with.has_value() && !water.temperature.has_value()) {
      Add("processed_with", "needs the index that the water has; give temperature and salinity");
    }
  }

  void ReadReceiver(KnownWater& water) {
    const bool column = !state_.without_column(), green = state_.green_surface();
    const std::optional<EchoDetector> detector =
        Word<EchoDetector>("detector", state_.detector(), v1::EchoDetector_MAX, "EchoDetector");
    if (detector.has_value())
      water.detector = *detector;
    else if ((column || green) && state_.detector() == v1::ECHO_DETECTOR_UNSPECIFIED)
      AddMissing("detector");
    if (green && detector == EchoDetector::kCentroid) {
      Add("green_surface",
          "cannot be computed for ECHO_DETECTOR_CENTROID (the water's light has no end that would give a centroid); "
          "give another detector, or leave it out where the processing corrected it");
    }
    water.field_of_view =
        Length("field_of_view", state_.has_field_of_view(), state_.field_of_view(), kFieldOfViewRange, column);
    water.pulse_length =
        Length("pulse_length", state_.has_pulse_length(), state_.pulse_length(), kPulseLengthRange, column || green);
  }

  double Length(std::string_view field, bool given, double number, const WaterRange& range, bool required) {
    if (given) return Checked(field, number, range);
    if (required) AddMissing(field);
    return 0;
  }

  void AddMissing(std::string_view field) {
    Add(field, "is missing (the bias of the water column depends on it); give it, or set water.without_column");
  }

  // What belongs to the part that is left out.
  void RefuseColumn() {
    const auto refuse = [this](std::string_view field, bool given) {
      if (given) Add(field, "has no effect with water.without_column; leave out one of the two");
    };
    refuse("bias", state_.bias() != v1::BIAS_HANDLING_UNSPECIFIED);
    refuse("residual_fraction", state_.has_residual_fraction());
    refuse("calibration", state_.has_calibration());
    refuse("photons", state_.has_photons());
  }

  std::optional<BiasTreatment> Bias() {
    const std::optional<BiasHandling> handling =
        Word<BiasHandling>("bias", state_.bias(), v1::BiasHandling_MAX, "BiasHandling");
    if (!handling.has_value()) {
      if (state_.bias() == v1::BIAS_HANDLING_UNSPECIFIED)
        Add("bias", "is missing (what the processing did about scattering); give it, or set water.without_column");
      return std::nullopt;
    }
    BiasTreatment treatment{.handling = *handling};
    if (Belongs("residual_fraction", state_.has_residual_fraction(), *handling, BiasHandling::kVendor))
      treatment.residual_fraction = Checked("residual_fraction", state_.residual_fraction(), kFractionRange);
    if (!Belongs("calibration", state_.has_calibration(), *handling, BiasHandling::kCalibrated)) return treatment;
    const v1::BiasCalibration& calibration = state_.calibration();
    treatment.calibration_depth = Checked("calibration.depth", calibration.depth(), kCalibrationDepthRange);
    treatment.calibration_offset = Checked("calibration.offset", calibration.offset(), kCalibrationOffsetRange);
    treatment.calibration_sigma = Checked("calibration.sigma", calibration.sigma(), kCalibrationSigmaRange);
    return treatment;
  }

  // Whether a field is given, with the handling that needs it.
  bool Belongs(std::string_view field, bool given, BiasHandling handling, BiasHandling its) {
    const std::string name = v1::BiasHandling_Name(ToWire(its));
    if (given && handling != its)
      Add(field, absl::StrCat("has no effect with this bias; leave it out, or give ", name));
    else if (!given && handling == its)
      Add(field, absl::StrCat("is missing (", name, " needs it); give it"));
    return given && handling == its;
  }

  // Whether it is said how clear the water is, needed or not.
  static bool TellsClarity(const OpticsInput& optics) {
    return optics.kd.has_value() || optics.kd_kind.has_value() || optics.secchi.has_value() ||
           optics.jerlov.has_value() || optics.absorption.has_value() || optics.scattering.has_value();
  }

  // The one field to which a problem of the optics belongs; else the whole water.
  static absl::Status CheckOptics(const OpticsInput& optics) {
    const absl::StatusOr<WaterOptics> found = OpticsOf(optics);
    if (found.ok()) return absl::OkStatus();
    OpticsInput clarity = optics;
    clarity.omega0.reset();
    const bool of_albedo = OpticsOf(clarity).ok();
    const std::string path = of_albedo ? Path("omega0") : "water";
    return FieldViolation(path, absl::StrCat(path, ": ", std::string(found.status().message())));
  }

  const v1::WaterState& state_;
  FieldViolations violations_;
};

}  // namespace

absl::StatusOr<KnownWater> ReadWater(const v1::WaterState& state) { return WaterReader(state).Read(); }

Sha256Digest KeyOf(const v1::WaterState& state, std::string_view table) {
  v1::WaterState known = state;
  known.DiscardUnknownFields();
  Sha256 sha;
  sha.Update(absl::StrCat(std::string(table), " water ", known.SerializeAsString()));
  return sha.Finish();
}

}  // namespace albtpu::server
