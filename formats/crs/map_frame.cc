#include "formats/crs/map_frame.h"

#include <cassert>
#include <cmath>
#include <cstdlib>
#include <map>
#include <mutex>
#include <numbers>
#include <utility>

#include "absl/strings/str_cat.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

// A degree is 0.0175 rad, and every other angular unit of coordinates is smaller. A text whose unit of angles is larger
// has the wrong one: some programs write UNIT["Meter",1] there.
constexpr double kLargestAngularUnit = 0.018;

// m, between a position on the map and the projection of its inverse: PROJ iterates to 1e-4 m or better.
constexpr double kLargestDeparture = 0.01;

constexpr double kLeastSkew = 1e-7;  // rad. Less is the error of the differences for a projection that has none.

constexpr double kStep = 1e-5;  // rad, half the distance of the differences that MetricAt takes: 64 m.

absl::StatusOr<ProjCrs> ReadUsable(ProjContext& context, const std::string& text) {
  absl::StatusOr<ProjCrs> crs = ReadCrs(context, text);
  if (crs.ok() && crs->angular_unit > kLargestAngularUnit)
    return absl::InvalidArgumentError("its geographic coordinates have a unit that is not an angle");
  return crs;
}

absl::Status Unusable(const std::string& name, const std::string& why) {
  return absl::InvalidArgumentError(absl::StrCat(name, ": its coordinate system cannot be used (", why,
                                                 "); name it by --crs, such as --crs EPSG:26917"));
}

// The coordinate system, and how it was found where the user should know.
struct Found {
  ProjCrs crs;
  std::string remark;
  std::optional<double> unit;  // Overrides that of the system.
};

absl::StatusOr<Found> FromGeoKeys(ProjContext& context, const CrsDescription& description) {
  if (description.projected == 0 && description.own.has_projection()) {
    const double metres = MetresOfUnit(context, description.linear_unit).value_or(1);
    ASSIGN_OR_RETURN(const std::string wkt, WktOf(context, description.own, metres));
    ASSIGN_OR_RETURN(ProjCrs crs, ReadUsable(context, wkt));
    return Found{std::move(crs), "", std::nullopt};
  }
  const int code = description.projected != 0 ? description.projected : description.geographic;
  ASSIGN_OR_RETURN(ProjCrs crs, ReadUsable(context, absl::StrCat("EPSG:", code)));
  Found found = {std::move(crs), "", std::nullopt};
  if (found.crs.is_projected && description.linear_unit != 0)
    found.unit = MetresOfUnit(context, description.linear_unit);
  return found;
}

absl::StatusOr<Found> FromFile(ProjContext& context, const std::string& name, const CrsDescription& description) {
  const bool has_keys = description.has_keys();
  if (description.wkt.empty()) {
    absl::StatusOr<Found> found = FromGeoKeys(context, description);
    if (!found.ok()) return Unusable(name, absl::StrCat("its GeoTIFF codes: ", found.status().message()));
    return found;
  }
  absl::StatusOr<ProjCrs> crs = ReadCrs(context, description.wkt);
  const std::optional<double> height_unit = crs.ok() ? crs->metres_per_height_unit : std::nullopt;
  if (crs.ok() && crs->angular_unit <= kLargestAngularUnit) return Found{*std::move(crs), "", std::nullopt};
  const std::string why =
      crs.ok() ? "its geographic coordinates have a unit that is not an angle" : std::string(crs.status().message());
  std::optional<int> code = LastEpsgCode(description.wkt);
  if (crs.ok() && crs->authority == "EPSG") {
    int named = 0;
    for (const char digit : crs->code) named = named * 10 + (digit - '0');
    code = named;
  }
  if (code.has_value()) {
    absl::StatusOr<ProjCrs> by_code = ReadUsable(context, absl::StrCat("EPSG:", *code));
    if (by_code.ok()) {
      if (!by_code->metres_per_height_unit.has_value()) by_code->metres_per_height_unit = height_unit;
      return Found{
          *std::move(by_code),
          absl::StrCat(name, ": its well-known text is faulty (", why, "); its code, EPSG:", *code, ", is used"),
          std::nullopt};
    }
  }
  if (has_keys) {
    absl::StatusOr<Found> by_keys = FromGeoKeys(context, description);
    if (by_keys.ok()) {
      by_keys->remark = absl::StrCat(name, ": its well-known text is faulty (", why, "); its GeoTIFF ",
                                     by_keys->crs.code.empty() ? absl::StrCat("keys, ", by_keys->crs.name, ",")
                                                               : absl::StrCat("code, EPSG:", by_keys->crs.code, ","),
                                     " is used");
      return by_keys;
    }
  }
  return Unusable(name, absl::StrCat("its well-known text: ", why));
}

}  // namespace

// A context with its transformation, for one thread at a time.
class MapFrame::Transformer {
 public:
  explicit Transformer(const std::string& pipeline) : transformation_(proj_create(context_.get(), pipeline.c_str())) {
    assert(transformation_ != nullptr);  // PROJ wrote the text itself.
  }
  MapPosition operator()(double longitude, double latitude) {
    const PJ_COORD result = proj_trans(transformation_.get(), PJ_FWD, proj_coord(longitude, latitude, 0, 0));
    return {result.xy.x, result.xy.y};
  }
  // Longitude and latitude as x and y.
  MapPosition Inverse(double x, double y) {
    const PJ_COORD result = proj_trans(transformation_.get(), PJ_INV, proj_coord(x, y, 0, 0));
    return {result.xy.x, result.xy.y};
  }

 private:
  ProjContext context_;
  ProjObject transformation_;
};

// As many transformers as threads ask at a time.
class MapFrame::Transformers {
 public:
  std::unique_ptr<Transformer> Take(const std::string& pipeline) {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        std::unique_ptr<Transformer> transformer = std::move(idle_.back());
        idle_.pop_back();
        return transformer;
      }
    }
    return std::make_unique<Transformer>(pipeline);
  }
  void Return(std::unique_ptr<Transformer> transformer) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(transformer));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Transformer>> idle_;
};

MapFrame::MapFrame() : transformers_(std::make_unique<Transformers>()) {}
MapFrame::~MapFrame() = default;

namespace {

// The frames that were made, by their description and the database that the environment names. Those with a remark
// name their file and are not kept.
class KnownFrames {
 public:
  using Frame = std::shared_ptr<const MapFrame>;

  static KnownFrames& Get() {
    static KnownFrames* const known = new KnownFrames();  // Lives as long as the threads that use it.
    return *known;
  }
  static std::string KeyOf(const CrsDescription& description) {
    const auto variable = [](const char* name) {
      const char* const value = std::getenv(name);
      return absl::StrCat(value == nullptr ? "" : value, "\n");
    };
    return absl::StrCat(description.user, "\n", description.wkt, "\n", description.projected, ",",
                        description.geographic, ",", description.linear_unit, ",", description.vertical, ",",
                        description.vertical_unit, "\n", description.own.Key(), "\n", variable("PROJ_DATA"),
                        variable("PROJ_LIB"));
  }

  Frame Find(const std::string& key) {
    const std::lock_guard lock(mutex_);
    const auto found = frames_.find(key);
    return found == frames_.end() ? nullptr : found->second;
  }
  void Keep(const std::string& key, const Frame& frame) {
    constexpr std::size_t kMost = 64;  // A survey has a few.
    if (!frame->remark().empty()) return;
    const std::lock_guard lock(mutex_);
    if (frames_.size() >= kMost) frames_.clear();
    frames_.emplace(key, frame);
  }

 private:
  std::mutex mutex_;
  std::map<std::string, Frame> frames_;
};

}  // namespace

absl::StatusOr<std::shared_ptr<const MapFrame>> MapFrame::Create(const std::string& name,
                                                                 const CrsDescription& description) {
  const std::string key = KnownFrames::KeyOf(description);
  if (KnownFrames::Frame known = KnownFrames::Get().Find(key); known != nullptr) return known;
  ProjContext context;
  RETURN_IF_ERROR(context.CheckDatabase());
  absl::StatusOr<std::shared_ptr<const MapFrame>> frame = CreateIn(context, name, description);
  // What PROJ says of a system is no help where it cannot read its database.
  if (!frame.ok() && !description.empty()) RETURN_IF_ERROR(context.CheckLayout());
  if (frame.ok()) KnownFrames::Get().Keep(key, *frame);
  return frame;
}

absl::StatusOr<std::shared_ptr<const MapFrame>> MapFrame::CreateIn(ProjContext& context, const std::string& name,
                                                                   const CrsDescription& description) {
  if (description.empty()) return Unusable(name, "it states none");
  absl::StatusOr<Found> found;
  if (!description.user.empty()) {
    absl::StatusOr<ProjCrs> crs = ReadUsable(context, description.user);
    if (!crs.ok()) {
      return absl::InvalidArgumentError(absl::StrCat("--crs: '", description.user, "' cannot be used (",
                                                     crs.status().message(),
                                                     "); give a code such as EPSG:26917, or well-known text"));
    }
    found = Found{*std::move(crs), "", std::nullopt};
  } else {
    found = FromFile(context, name, description);
    if (!found.ok()) return found.status();
  }
  const ProjCrs& crs = found->crs;
  std::shared_ptr<MapFrame> frame(new MapFrame());
  frame->crs_name_ = crs.name;
  if (const char* wkt = proj_as_wkt(context.get(), crs.horizontal.get(), PJ_WKT1_GDAL, nullptr)) frame->wkt_ = wkt;
  frame->vertical_ = crs.vertical;
  if (!frame->vertical_.has_value() && description.vertical != 0)
    frame->vertical_ = VerticalCrsOf(context, description.vertical);
  frame->remark_ = found->remark;
  frame->angular_unit_ = crs.angular_unit;
  frame->prime_meridian_ = crs.prime_meridian;
  frame->unit_ = found->unit.value_or(crs.unit);
  frame->unit_factor_ = frame->unit_ / crs.unit;
  frame->is_transverse_mercator_ = crs.is_transverse_mercator;
  frame->ellipsoid_ = crs.ellipsoid;
  frame->metres_per_height_unit_ = crs.metres_per_height_unit;
  if (!frame->metres_per_height_unit_.has_value() && description.vertical_unit != 0)
    frame->metres_per_height_unit_ = MetresOfUnit(context, description.vertical_unit);
  if (!frame->metres_per_height_unit_.has_value() && description.vertical != 0)
    frame->metres_per_height_unit_ = MetresOfVerticalCrs(context, description.vertical);
  if (!crs.is_projected) return frame;
  // The conversion that defines the system. A search for operations from its geographic system finds the same one, but
  // takes longer.
  const ProjObject conversion(proj_crs_get_coordoperation(context.get(), crs.horizontal.get()));
  const ProjObject by_longitude(
      conversion == nullptr ? nullptr : proj_normalize_for_visualization(context.get(), conversion.get()));
  const char* pipeline =
      by_longitude == nullptr ? nullptr : proj_as_proj_string(context.get(), by_longitude.get(), PJ_PROJ_5, nullptr);
  if (pipeline == nullptr)
    return Unusable(name, absl::StrCat("PROJ cannot project into ", crs.name, ": ", context.last_message()));
  frame->pipeline_ = pipeline;
  return frame;
}

absl::Status CheckProjDatabase() {
  const ProjContext context;
  RETURN_IF_ERROR(context.CheckDatabase());
  return context.CheckLayout();
}

void MapFrame::Project(std::span<const GeographicPosition> from, std::span<MapPosition> to) const {
  assert(from.size() == to.size());
  if (is_geographic()) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      const double longitude = std::remainder(from[i].longitude - prime_meridian_, 2 * std::numbers::pi);
      to[i] = {longitude / unit_, from[i].latitude / unit_};
    }
    return;
  }
  std::unique_ptr<Transformer> transformer = transformers_->Take(pipeline_);
  for (std::size_t i = 0; i < from.size(); ++i) {
    to[i] = (*transformer)((from[i].longitude - prime_meridian_) / angular_unit_, from[i].latitude / angular_unit_);
    to[i].x /= unit_factor_;
    to[i].y /= unit_factor_;
  }
  transformers_->Return(std::move(transformer));
}

MapPosition MapFrame::Project(const GeographicPosition& position) const {
  MapPosition result;
  Project(std::span(&position, 1), std::span(&result, 1));
  return result;
}

std::optional<GeographicPosition> MapFrame::GeographicAt(const MapPosition& position) const {
  double longitude = position.x * unit_, latitude = position.y * unit_;
  if (!is_geographic()) {
    std::unique_ptr<Transformer> transformer = transformers_->Take(pipeline_);
    const MapPosition angles = transformer->Inverse(position.x * unit_factor_, position.y * unit_factor_);
    transformers_->Return(std::move(transformer));
    longitude = angles.x * angular_unit_;
    latitude = angles.y * angular_unit_;
  }
  if (!std::isfinite(longitude) || !(std::abs(latitude) < std::numbers::pi / 2)) return std::nullopt;
  const GeographicPosition found = {latitude, longitude + prime_meridian_};
  // Far outside of a projection, PROJ's inverse gives some position that does not lead back.
  if (!is_geographic()) {
    const MapPosition again = Project(found);
    if (!(std::hypot(again.x - position.x, again.y - position.y) * unit_ < kLargestDeparture)) return std::nullopt;
  }
  return found;
}

// With x_E the change of x in a metre to the east and so on, a step (E, N) on the ground is the step
//     (x, y) = ((x_E, x_N), (y_E, y_N)) (E, N)
// on the map. The columns of the inverse are the steps on the ground for a unit of x and of y. The second has the
// length of metres_per_y and the direction of grid north, clockwise from true north. The first, on the axes of the
// second, is (metres_per_x, north_per_x): the product of the lengths across, the determinant, is that of the inverse.
MapMetric MapFrame::MetricAt(const GeographicPosition& position) const {
  const double meridian = ellipsoid_.MeridianRadius(position.latitude);
  const double parallel = ellipsoid_.PrimeVerticalRadius(position.latitude) * std::cos(position.latitude);
  if (is_geographic()) return {parallel * unit_, meridian * unit_};
  const std::array from = {GeographicPosition{position.latitude, position.longitude - kStep},
                           GeographicPosition{position.latitude, position.longitude + kStep},
                           GeographicPosition{position.latitude - kStep, position.longitude},
                           GeographicPosition{position.latitude + kStep, position.longitude}};
  std::array<MapPosition, 4> to;
  Project(from, to);
  const double east = 2 * kStep * parallel, north = 2 * kStep * meridian;
  const double x_east = (to[1].x - to[0].x) / east, y_east = (to[1].y - to[0].y) / east;
  const double x_north = (to[3].x - to[2].x) / north, y_north = (to[3].y - to[2].y) / north;
  const double determinant = x_east * y_north - x_north * y_east;
  MapMetric metric = {.metres_per_x = std::hypot(y_north, y_east) / std::abs(determinant),
                      .metres_per_y = std::hypot(x_north, x_east) / std::abs(determinant),
                      .convergence = std::atan2(-x_north / determinant, x_east / determinant)};
  const double north_per_x = -(x_east * y_east + x_north * y_north) / (determinant * determinant * metric.metres_per_y);
  if (std::abs(north_per_x) > kLeastSkew * metric.metres_per_x) {
    metric.north_per_x = north_per_x;
    metric.metres_per_x = 1 / (std::abs(determinant) * metric.metres_per_y);
  }
  return metric;
}

}  // namespace albtpu::formats
