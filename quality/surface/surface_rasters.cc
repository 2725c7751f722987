#include "quality/surface/surface_rasters.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "annotate/run/file_progress.h"
#include "grids/bag_metadata.h"
#include "grids/gdal_raster.h"
#include "quality/surface/surface_file.h"
#include "status/status_macros.h"
#include "tables/version.h"

namespace albtpu::quality {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string Software() { return absl::StrCat("albtpu-query ", std::string(Version())); }

// UTC; that of SOURCE_DATE_EPOCH where it is set.
std::string Now() {
  std::time_t now = std::time(nullptr);
  if (const char* const epoch = std::getenv("SOURCE_DATE_EPOCH"); epoch != nullptr)
    now = static_cast<std::time_t>(std::strtoll(epoch, nullptr, 10));
  std::tm utc = {};
  gmtime_r(&now, &utc);
  std::array<char, 32> text = {};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &utc);
  return text.data();
}

Raster RasterOf(const MadeSurface& surface, std::size_t bands) {
  Raster raster = {.grid = surface.path, .frame = surface.frame, .bands = {}, .metadata = {}};
  for (const SurfaceLayer& layer : LayersOfRasters())
    if (raster.bands.size() < bands)
      raster.bands.push_back({.name = layer.name, .description = layer.description, .unit = layer.unit});
  raster.metadata = {{"TIFFTAG_SOFTWARE", Software()},
                     {"TIFFTAG_IMAGEDESCRIPTION", SurfaceStatement(surface.frame.vertical_name)}};
  return raster;
}

std::string OrdersText(const Json& orders) {
  std::string text;
  for (const auto& [order, nodes] : orders.items())
    absl::StrAppend(&text, text.empty() ? "" : ", ", order, " ", nodes.get<std::uint64_t>());
  return text;
}

BagFacts FactsOf(const MadeSurface& surface, const std::string& organisation) {
  const Json& json = *surface.json;
  BagFacts facts = {
      .title = absl::StrFormat("Bathymetric surface by airborne lidar, nodes of %g m", json["cell"].get<double>()),
      .abstract = absl::StrCat(
          SurfaceStatement(surface.frame.vertical_name),
          " The uncertainty layer is the one at 95 %; of the types of the format productUncert is the nearest. Nodes "
          "by the strictest order of IHO S-44 that they meet: ",
          OrdersText(json["order_met"]), "."),
      .organisation = organisation,
      .vertical_wkt = surface.frame.vertical_wkt,
      .software = Software(),
      .process = "mean of the points of each cell, and its propagated uncertainty",
      .source = absl::StrFormat("%d points with an uncertainty, in %d files", json["points"].get<std::uint64_t>(),
                                json["files"].get<std::uint64_t>()),
      .made = Now(),
      .first_survey = {},
      .last_survey = {},
      .lowest = json["lowest"],
      .highest = json["highest"]};
  if (const Json& surveyed = json["surveyed"]; surveyed.is_object()) {
    facts.first_survey = surveyed["first"].get<std::string>();
    facts.last_survey = surveyed["last"].get<std::string>();
  }
  return facts;
}

}  // namespace

std::string FileOf(SurfaceFormat format) {
  return format == SurfaceFormat::kNetcdf    ? "surface.nc"
         : format == SurfaceFormat::kGeoTiff ? "surface.tif"
                                             : "surface.bag";
}

absl::Status CheckFormats(const std::vector<SurfaceFormat>& formats, const SurfaceMap& map) {
  for (const SurfaceFormat format : formats) {
    if (format != SurfaceFormat::kNetcdf) RETURN_IF_ERROR(CheckGdal());
    if (format != SurfaceFormat::kBag) continue;
    if (map.crs_wkt.empty())
      return absl::InvalidArgumentError(absl::StrCat("the coordinate system of the points is ", map.crs_name,
                                                     ", and BAG needs one; annotate them with --crs"));
    if (map.metres_per_unit != 1)
      return absl::InvalidArgumentError(absl::StrFormat(
          "x and y of the points are in units of %.10g m, and BAG has metres only; give --format netcdf,geotiff",
          map.metres_per_unit));
  }
  return absl::OkStatus();
}

absl::Status WriteRasters(const MadeSurface& surface, const std::vector<SurfaceFormat>& formats,
                          const std::string& organisation) {
  constexpr std::size_t kBagBands = 2;  // Elevation and uncertainty.
  const auto path = [&](SurfaceFormat format) { return surface.path.parent_path() / FileOf(format); };
  if (std::ranges::count(formats, SurfaceFormat::kGeoTiff) > 0) {
    const std::filesystem::path tiff = path(SurfaceFormat::kGeoTiff);
    RETURN_IF_ERROR(WriteCog(RasterOf(surface, LayersOfRasters().size()), tiff));
    if (!surface.frame.vertical_wkt.empty() && !HasVerticalSystem(tiff))
      annotate::Note(absl::StrCat(FileOf(SurfaceFormat::kGeoTiff),
                                  ": GDAL keeps no vertical system without a code, as ", surface.frame.vertical_name,
                                  " is; the description of the file names it"));
  }
  if (std::ranges::count(formats, SurfaceFormat::kBag) > 0)
    RETURN_IF_ERROR(
        WriteBag(RasterOf(surface, kBagBands), BagMetadata(FactsOf(surface, organisation)), path(SurfaceFormat::kBag)));
  return absl::OkStatus();
}

}  // namespace albtpu::quality
