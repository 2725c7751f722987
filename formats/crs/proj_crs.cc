#include "formats/crs/proj_crs.h"

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "sea/angle.h"
#include "tables/default_tables.h"

namespace albtpu::formats {
namespace {

// The unit of an axis: metres or radians.
std::optional<double> AxisUnit(ProjContext& context, const PJ* crs, int axis) {
  const ProjObject system(proj_crs_get_coordinate_system(context.get(), crs));
  double unit = 0;
  if (system == nullptr || axis >= proj_cs_get_axis_count(context.get(), system.get()) ||
      !proj_cs_get_axis_info(context.get(), system.get(), axis, nullptr, nullptr, nullptr, &unit, nullptr, nullptr,
                             nullptr) ||
      !(unit > 0))
    return std::nullopt;
  return unit;
}

// A compound system consists of others; a bound one adds a datum shift, which is not used, to another.
ProjObject WithoutDatumShift(ProjContext& context, ProjObject crs) {
  if (crs != nullptr && proj_get_type(crs.get()) == PJ_TYPE_BOUND_CRS)
    return ProjObject(proj_get_source_crs(context.get(), crs.get()));
  return crs;
}

bool IsGeographic(const PJ* crs) {
  const PJ_TYPE type = proj_get_type(crs);
  return type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
}

std::string TextOrEmpty(const char* text) { return text == nullptr ? "" : text; }

void FillEllipsoid(ProjContext& context, ProjCrs& crs) {
  if (const ProjObject ellipsoid(proj_get_ellipsoid(context.get(), crs.geographic.get())); ellipsoid != nullptr) {
    double a = 0, b = 0;
    if (proj_ellipsoid_get_parameters(context.get(), ellipsoid.get(), &a, &b, nullptr, nullptr) && a > 0)
      crs.ellipsoid = {a, 1 - (b / a) * (b / a)};
  }
  if (const ProjObject meridian(proj_get_prime_meridian(context.get(), crs.geographic.get())); meridian != nullptr) {
    double longitude = 0, unit = 0;
    if (proj_prime_meridian_get_parameters(context.get(), meridian.get(), &longitude, &unit, nullptr))
      crs.prime_meridian = longitude * unit;
  }
}

bool IsTransverseMercator(ProjContext& context, const PJ* projected) {
  const ProjObject conversion(proj_crs_get_coordoperation(context.get(), projected));
  const char* method = nullptr;
  return conversion != nullptr &&
         proj_coordoperation_get_method_info(context.get(), conversion.get(), &method, nullptr, nullptr) &&
         std::string(method) == "Transverse Mercator";
}

// Of heights upwards, in metres.
VerticalCrs HeightsOf(const PJ* datum) {
  const std::string name = TextOrEmpty(proj_get_name(datum));
  return {.name = absl::StrCat(name, " height"),
          .wkt = absl::StrCat("VERT_CS[\"", name, " height\",VERT_DATUM[\"", name,
                              "\",2005],UNIT[\"metre\",1],AXIS[\"Gravity-related height\",UP]]")};
}

// m; nullopt where heights do not count upwards.
std::optional<double> UnitOfHeights(ProjContext& context, const PJ* vertical) {
  const ProjObject system(proj_crs_get_coordinate_system(context.get(), vertical));
  const char* direction = nullptr;
  if (system == nullptr ||
      !proj_cs_get_axis_info(context.get(), system.get(), 0, nullptr, nullptr, &direction, nullptr, nullptr, nullptr,
                             nullptr) ||
      std::string(direction) != "up")
    return std::nullopt;
  return AxisUnit(context, vertical, 0);
}

VerticalCrs AsItIs(ProjContext& context, const PJ* vertical) {
  return {.name = TextOrEmpty(proj_get_name(vertical)),
          .wkt = TextOrEmpty(proj_as_wkt(context.get(), vertical, PJ_WKT1_GDAL, nullptr))};
}

// The system of the database with heights in metres from a datum, 5703 for that of 6360, some ms. GeoTIFF keeps only
// systems with a code. If there is none, one that has the name of the datum.
VerticalCrs MetricHeightsOf(ProjContext& context, const PJ* datum) {
  std::optional<VerticalCrs> found;
  const PROJ_STRING_LIST codes = proj_get_codes_from_database(context.get(), "EPSG", PJ_TYPE_VERTICAL_CRS, 0);
  for (auto code = codes; code != nullptr && *code != nullptr && !found.has_value(); ++code) {
    const ProjObject crs(proj_create_from_database(context.get(), "EPSG", *code, PJ_CATEGORY_CRS, 0, nullptr));
    const ProjObject its(crs == nullptr ? nullptr : proj_crs_get_datum_forced(context.get(), crs.get()));
    if (its != nullptr && proj_is_equivalent_to_with_ctx(context.get(), datum, its.get(), PJ_COMP_EQUIVALENT) != 0 &&
        UnitOfHeights(context, crs.get()) == 1)
      found = AsItIs(context, crs.get());
  }
  proj_string_list_destroy(codes);
  return found.has_value() ? *std::move(found) : HeightsOf(datum);
}

// nullopt for one whose heights do not count upwards.
std::optional<VerticalCrs> InMetres(ProjContext& context, const PJ* vertical) {
  const std::optional<double> unit = UnitOfHeights(context, vertical);
  if (!unit.has_value()) return std::nullopt;
  if (unit == 1) return AsItIs(context, vertical);
  const ProjObject datum(proj_crs_get_datum_forced(context.get(), vertical));
  return datum == nullptr ? std::nullopt : std::optional(MetricHeightsOf(context, datum.get()));
}

ProjObject Parse(ProjContext& context, const std::string& text) {
  // A text in brackets is well-known text, which PROJ reads leniently; faults that do not prevent reading are ignored.
  if (text.find('[') != std::string::npos && text.find('{') == std::string::npos) {
    PROJ_STRING_LIST warnings = nullptr, errors = nullptr;
    ProjObject crs(proj_create_from_wkt(context.get(), text.c_str(), nullptr, &warnings, &errors));
    proj_string_list_destroy(warnings);
    proj_string_list_destroy(errors);
    return crs;
  }
  return ProjObject(proj_create(context.get(), text.c_str()));
}

// Lets a relocatable installation use the database that it brings. PROJ_DATA may name one of another PROJ, whose layout
// may differ.
void UseInstalledDatabase(PJ_CONTEXT* context) {
  const std::filesystem::path folder = InstalledDataDirectory() / "proj";
  std::error_code error;
  if (!std::filesystem::exists(folder / "proj.db", error)) return;
  const char* const path = folder.c_str();
  proj_context_set_search_paths(context, 1, &path);
}

}  // namespace

ProjContext::ProjContext() : context_(proj_context_create()) {
  UseInstalledDatabase(context_);
  proj_context_set_enable_network(context_, 0);
  proj_log_level(context_, PJ_LOG_ERROR);
  proj_log_func(context_, &last_message_,
                [](void* last, int, const char* message) { *static_cast<std::string*>(last) = message; });
}

ProjContext::~ProjContext() { proj_context_destroy(context_); }

namespace {

// The database to which the environment leads, and how: "PROJ_LIB is /opt/other/share/proj". Empty where there is none.
struct NamedDatabase {
  std::string path, how;
};
NamedDatabase DatabaseOfEnvironment() {
  for (const char* const variable : {"PROJ_DATA", "PROJ_LIB"}) {  // The first one counts.
    const char* const value = std::getenv(variable);
    if (value == nullptr) continue;
    const std::vector<std::string> folders = absl::StrSplit(value, ':', absl::SkipEmpty());
    for (const std::string& folder : folders) {
      const std::filesystem::path path = std::filesystem::path(folder) / "proj.db";
      std::error_code ignored;
      if (std::filesystem::exists(path, ignored)) return {path.string(), absl::StrCat(variable, " is ", value)};
    }
  }
  return {};
}

}  // namespace

absl::Status ProjContext::CheckDatabase() const {
  if (proj_context_get_database_path(context_) != nullptr) return absl::OkStatus();
  if (!DatabaseOfEnvironment().path.empty()) return CheckLayout();
  return absl::FailedPreconditionError(
      "PROJ does not find proj.db, its database of coordinate systems; install the package proj-data, or set "
      "PROJ_LIB to the folder of proj.db");
}

absl::Status ProjContext::CheckLayout() const {
  constexpr char kAnyCode[] = "4326";  // WGS 84, which every database has.
  const ProjObject any(proj_create_from_database(context_, "EPSG", kAnyCode, PJ_CATEGORY_CRS, 0, nullptr));
  if (any != nullptr) return absl::OkStatus();
  const char* const opened = proj_context_get_database_path(context_);
  const NamedDatabase named = DatabaseOfEnvironment();
  const std::string path = opened != nullptr ? opened : named.path;
  return absl::FailedPreconditionError(
      absl::StrCat("PROJ ", proj_info().version, " cannot read its database ", path.empty() ? "proj.db" : path,
                   " (that of another program's PROJ", named.how.empty() ? "" : ": ", named.how, "); ",
                   named.how.empty() ? "install the package proj-data" : "unset the variable",
                   ", or set PROJ_LIB to the folder of a proj.db of this version"));
}

absl::StatusOr<ProjCrs> ReadCrs(ProjContext& context, const std::string& text) {
  ProjCrs crs;
  ProjObject whole = WithoutDatumShift(context, Parse(context, text));
  if (whole == nullptr)
    return absl::InvalidArgumentError(context.last_message().empty() ? "PROJ cannot read it" : context.last_message());
  if (proj_get_type(whole.get()) == PJ_TYPE_COMPOUND_CRS) {
    const ProjObject vertical =
        WithoutDatumShift(context, ProjObject(proj_crs_get_sub_crs(context.get(), whole.get(), 1)));
    if (vertical != nullptr) {
      crs.metres_per_height_unit = AxisUnit(context, vertical.get(), 0);
      crs.vertical = InMetres(context, vertical.get());
    }
    whole = WithoutDatumShift(context, ProjObject(proj_crs_get_sub_crs(context.get(), whole.get(), 0)));
  }
  if (whole != nullptr) {
    crs.is_projected = proj_get_type(whole.get()) == PJ_TYPE_PROJECTED_CRS;
    if (crs.is_projected || IsGeographic(whole.get()))
      crs.geographic.reset(proj_crs_get_geodetic_crs(context.get(), whole.get()));
  }
  const std::optional<double> unit = whole == nullptr ? std::nullopt : AxisUnit(context, whole.get(), 0);
  const std::optional<double> angular_unit =
      crs.geographic == nullptr ? std::nullopt : AxisUnit(context, crs.geographic.get(), 0);
  if (!unit.has_value() || !angular_unit.has_value())
    return absl::InvalidArgumentError("it is not a projected or geographic coordinate system");
  crs.unit = *unit;
  crs.angular_unit = *angular_unit;
  crs.name = TextOrEmpty(proj_get_name(whole.get()));
  crs.authority = TextOrEmpty(proj_get_id_auth_name(whole.get(), 0));
  crs.code = TextOrEmpty(proj_get_id_code(whole.get(), 0));
  if (!crs.metres_per_height_unit.has_value()) crs.metres_per_height_unit = AxisUnit(context, whole.get(), 2);
  crs.is_transverse_mercator = crs.is_projected && IsTransverseMercator(context, whole.get());
  FillEllipsoid(context, crs);
  crs.horizontal = std::move(whole);
  return crs;
}

std::optional<double> MetresOfUnit(ProjContext& context, int code) {
  double metres = 0;
  const char* category = nullptr;
  if (!proj_uom_get_info_from_database(context.get(), "EPSG", absl::StrCat(code).c_str(), nullptr, &metres,
                                       &category) ||
      std::string(category) != "linear" || !(metres > 0))
    return std::nullopt;
  return metres;
}

std::optional<double> MetresOfVerticalCrs(ProjContext& context, int code) {
  const ProjObject crs(
      proj_create_from_database(context.get(), "EPSG", absl::StrCat(code).c_str(), PJ_CATEGORY_CRS, 0, nullptr));
  if (crs == nullptr || proj_get_type(crs.get()) != PJ_TYPE_VERTICAL_CRS) return std::nullopt;
  return AxisUnit(context, crs.get(), 0);
}

std::optional<VerticalCrs> VerticalCrsOf(ProjContext& context, int code) {
  const auto find = [&](PJ_CATEGORY category) {
    return ProjObject(
        proj_create_from_database(context.get(), "EPSG", absl::StrCat(code).c_str(), category, 0, nullptr));
  };
  if (const ProjObject crs = find(PJ_CATEGORY_CRS); crs != nullptr && proj_get_type(crs.get()) == PJ_TYPE_VERTICAL_CRS)
    return InMetres(context, crs.get());
  if (const ProjObject datum = find(PJ_CATEGORY_DATUM);
      datum != nullptr && proj_get_type(datum.get()) == PJ_TYPE_VERTICAL_REFERENCE_FRAME)
    return MetricHeightsOf(context, datum.get());
  return std::nullopt;
}

std::optional<int> LastEpsgCode(const std::string& wkt) {
  const std::string text = absl::AsciiStrToUpper(wkt);
  // The entry of the outermost bracket is the last one, so nothing but brackets follows it.
  const std::size_t at = std::max(text.rfind("AUTHORITY[") + 1, text.rfind("ID[") + 1);
  if (at == 0) return std::nullopt;
  const std::size_t open = text.find('[', at);
  const std::size_t close = text.find(']', open);
  if (close == std::string::npos) return std::nullopt;
  std::string rest = text.substr(close + 1);
  absl::StripAsciiWhitespace(&rest);
  if (rest != "]") return std::nullopt;
  const std::vector<std::string> parts = absl::StrSplit(text.substr(open + 1, close - open - 1), ',');
  int code = 0;
  if (parts.size() != 2) return std::nullopt;
  const auto unquoted = [](std::string part) {
    absl::StripAsciiWhitespace(&part);
    if (part.size() >= 2 && part.front() == '"' && part.back() == '"') part = part.substr(1, part.size() - 2);
    return part;
  };
  if (unquoted(parts[0]) != "EPSG" || !absl::SimpleAtoi(unquoted(parts[1]), &code) || code <= 0) return std::nullopt;
  return code;
}

}  // namespace albtpu::formats
