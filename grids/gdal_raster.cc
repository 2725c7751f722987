#include "grids/gdal_raster.h"

#include "absl/strings/str_cat.h"

#ifdef ALBTPU_GDAL_LIBRARY
#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <dlfcn.h>
#include <gdal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <memory>
#include <mutex>

#include "absl/status/statusor.h"
#include "grids/netcdf_reader.h"
#include "status/status_macros.h"
#endif

namespace albtpu {

#ifndef ALBTPU_GDAL_LIBRARY

namespace {
absl::Status BuiltWithout() {
  return absl::FailedPreconditionError(
      "GeoTIFF and BAG need GDAL, without which this program was built; give --format netcdf, from which GDAL makes "
      "others, or use the Debian package or a build with libgdal-dev");
}
}  // namespace

absl::Status CheckGdal() { return BuiltWithout(); }
absl::Status WriteCog(const Raster&, const std::filesystem::path&) { return BuiltWithout(); }
bool HasVerticalSystem(const std::filesystem::path&) { return false; }
absl::Status WriteBag(const Raster&, const std::string&, const std::filesystem::path&) { return BuiltWithout(); }

#else

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBlock = 512;            // Cells of a side of a tile; a multiple of the chunks of the grid.
constexpr GIntBig kCache = GIntBig{64} << 20;  // Bytes of blocks that GDAL keeps.
constexpr float kNoBagValue = 1e6F;            // Of elevation and uncertainty.
constexpr char kBagVersion[] = "2.0.1";        // Of the format that GDAL writes.

// The functions of GDAL that are used.
struct Gdal {
  decltype(&GDALAllRegister) all_register;
  decltype(&GDALSetCacheMax64) set_cache_max;
  decltype(&GDALGetDriverByName) driver_by_name;
  decltype(&GDALCreate) create;
  decltype(&GDALCreateCopy) create_copy;
  decltype(&GDALOpen) open;
  decltype(&GDALClose) close;
  decltype(&GDALSetProjection) set_projection;
  decltype(&GDALGetProjectionRef) projection;
  decltype(&GDALSetGeoTransform) set_geo_transform;
  decltype(&GDALSetMetadataItem) set_metadata_item;
  decltype(&GDALSetDescription) set_description;
  decltype(&GDALGetRasterBand) raster_band;
  decltype(&GDALSetRasterNoDataValue) set_no_data;
  decltype(&GDALSetRasterUnitType) set_unit;
  decltype(&GDALRasterIO) raster_io;
  decltype(&CPLPushErrorHandlerEx) push_error_handler;
  decltype(&CPLPopErrorHandler) pop_error_handler;
  decltype(&CPLGetErrorHandlerUserData) error_handler_data;
  decltype(&CPLSetConfigOption) set_option;
  decltype(&CSLSetNameValue) set_name_value;
  decltype(&CSLDestroy) destroy_list;
  std::string missing;  // Why it cannot be used; empty if it can.

  Gdal() {
    // Its symbols stay its own: it shares HDF5, PROJ and SQLite with other libraries of the program.
    void* const library = dlopen(ALBTPU_GDAL_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
      missing = dlerror();
      return;
    }
    const auto find = [&](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)> >(dlsym(library, name));
      if (function == nullptr) missing = absl::StrCat(ALBTPU_GDAL_LIBRARY, " has no ", name);
    };
    find(all_register, "GDALAllRegister");
    find(set_cache_max, "GDALSetCacheMax64");
    find(driver_by_name, "GDALGetDriverByName");
    find(create, "GDALCreate");
    find(create_copy, "GDALCreateCopy");
    find(open, "GDALOpen");
    find(close, "GDALClose");
    find(set_projection, "GDALSetProjection");
    find(projection, "GDALGetProjectionRef");
    find(set_geo_transform, "GDALSetGeoTransform");
    find(set_metadata_item, "GDALSetMetadataItem");
    find(set_description, "GDALSetDescription");
    find(raster_band, "GDALGetRasterBand");
    find(set_no_data, "GDALSetRasterNoDataValue");
    find(set_unit, "GDALSetRasterUnitType");
    find(raster_io, "GDALRasterIO");
    find(push_error_handler, "CPLPushErrorHandlerEx");
    find(pop_error_handler, "CPLPopErrorHandler");
    find(error_handler_data, "CPLGetErrorHandlerUserData");
    find(set_option, "CPLSetConfigOption");
    find(set_name_value, "CSLSetNameValue");
    find(destroy_list, "CSLDestroy");
    if (!missing.empty()) return;
    set_option("GDAL_PAM_ENABLED", "NO");  // No files beside the raster.
    set_cache_max(kCache);
    all_register();
    for (const char* const driver : {"GTiff", "COG", "BAG"})
      if (driver_by_name(driver) == nullptr)
        missing = absl::StrCat(ALBTPU_GDAL_LIBRARY, " has no driver named ", driver);
  }

  static const Gdal& Get() {
    static const Gdal* const gdal = new Gdal();  // Its threads may outlive static variables.
    return *gdal;
  }
};

// Keeps the first error of GDAL in place of printing it.
class Errors {
 public:
  Errors() { Gdal::Get().push_error_handler(&Keep, this); }
  ~Errors() { Gdal::Get().pop_error_handler(); }
  Errors(const Errors&) = delete;
  Errors& operator=(const Errors&) = delete;

  bool any() const { return any_; }
  absl::Status CannotWrite(const fs::path& path) const {
    const std::string why = first_.empty() ? "" : absl::StrCat(" (", first_, ")");
    return absl::DataLossError(absl::StrCat(path.string(), ": cannot be written by GDAL", why));
  }

 private:
  static void CPL_STDCALL Keep(CPLErr level, CPLErrorNum, const char* message) {
    if (level < CE_Failure) return;
    Errors& errors = *static_cast<Errors*>(Gdal::Get().error_handler_data());
    const std::lock_guard lock(errors.mutex_);
    if (!errors.any_) errors.first_ = message;
    errors.any_ = true;
  }

  std::mutex mutex_;
  bool any_ = false;
  std::string first_;
};

class Options {
 public:
  Options& operator()(const char* name, const std::string& value) {
    list_ = Gdal::Get().set_name_value(list_, name, value.c_str());
    return *this;
  }
  Options() = default;
  ~Options() { Gdal::Get().destroy_list(list_); }
  Options(const Options&) = delete;
  Options& operator=(const Options&) = delete;
  char** get() const { return list_; }

 private:
  char** list_ = nullptr;
};

struct CloseDataset {
  void operator()(GDALDatasetH dataset) const { Gdal::Get().close(dataset); }
};
using Dataset = std::unique_ptr<std::remove_pointer_t<GDALDatasetH>, CloseDataset>;

// Horizontal and, where the datum of heights is known, vertical.
std::string WholeCrs(const GridFrame& frame) {
  if (frame.crs_wkt.empty() || frame.vertical_wkt.empty()) return frame.crs_wkt;
  return absl::StrCat("COMPD_CS[\"", frame.crs_name, " + ", frame.vertical_name, "\",", frame.crs_wkt, ",",
                      frame.vertical_wkt, "]");
}

// Calls `visit` for each block, the northern ones first.
template <typename Visit>
absl::Status ForEachBlock(const GridFrame& frame, const Visit& visit) {
  for (std::size_t row = 0; row < frame.rows; row += kBlock)
    for (std::size_t column = 0; column < frame.columns; column += kBlock)
      RETURN_IF_ERROR(visit(GridWindow{.row = row,
                                       .column = column,
                                       .rows = std::min(kBlock, frame.rows - row),
                                       .columns = std::min(kBlock, frame.columns - column)}));
  return absl::OkStatus();
}

bool Transfer(GDALRWFlag direction, GDALDatasetH dataset, std::size_t band, const GridWindow& at, float* values) {
  return Gdal::Get().raster_io(Gdal::Get().raster_band(dataset, static_cast<int>(band) + 1), direction,
                               static_cast<int>(at.column), static_cast<int>(at.row), static_cast<int>(at.columns),
                               static_cast<int>(at.rows), values, static_cast<int>(at.columns),
                               static_cast<int>(at.rows), GDT_Float32, 0, 0) == CE_None;
}

// The values of the grid, `none` in place of NaN.
absl::Status ReadGrid(const NetcdfReader& grid, const RasterBand& band, const GridWindow& at, float none,
                      std::vector<float>& values) {
  RETURN_IF_ERROR(grid.Read(band.name, at, values));
  if (!std::isnan(none))
    for (float& value : values)
      if (std::isnan(value)) value = none;
  return absl::OkStatus();
}

// The raster as a plain GeoTIFF, from which GDAL makes the others.
absl::Status WritePlain(const Raster& raster, float none, const fs::path& path) {
  const Gdal& gdal = Gdal::Get();
  const Errors errors;
  ASSIGN_OR_RETURN(const NetcdfReader grid, NetcdfReader::Open(raster.grid));
  const GridFrame& frame = raster.frame;
  Options options;
  options("TILED", "YES")("BLOCKXSIZE", absl::StrCat(kBlock))("BLOCKYSIZE", absl::StrCat(kBlock));
  options("INTERLEAVE", "BAND")("COMPRESS", "DEFLATE")("ZLEVEL", "1")("SPARSE_OK", "TRUE")("BIGTIFF", "IF_SAFER");
  Dataset file(gdal.create(gdal.driver_by_name("GTiff"), path.c_str(), static_cast<int>(frame.columns),
                           static_cast<int>(frame.rows), static_cast<int>(raster.bands.size()), GDT_Float32,
                           options.get()));
  if (file == nullptr) return errors.CannotWrite(path);
  const double north = static_cast<double>(frame.first_row + static_cast<std::int64_t>(frame.rows)) * frame.cell;
  std::array<double, 6> place = {
      static_cast<double>(frame.first_column) * frame.cell, frame.cell, 0, north, 0, -frame.cell};
  gdal.set_geo_transform(file.get(), place.data());
  if (const std::string crs = WholeCrs(frame); !crs.empty()) gdal.set_projection(file.get(), crs.c_str());
  for (const auto& [name, value] : raster.metadata)
    gdal.set_metadata_item(file.get(), name.c_str(), value.c_str(), nullptr);
  for (std::size_t i = 0; i < raster.bands.size(); ++i) {
    const RasterBand& band = raster.bands[i];
    const GDALRasterBandH of_file = gdal.raster_band(file.get(), static_cast<int>(i) + 1);
    gdal.set_description(of_file, band.name.c_str());
    if (!band.unit.empty()) gdal.set_unit(of_file, band.unit.c_str());
    gdal.set_metadata_item(of_file, "long_name", band.description.c_str(), nullptr);
    gdal.set_no_data(of_file, none);
  }
  std::vector<float> values;
  for (std::size_t i = 0; i < raster.bands.size(); ++i)
    RETURN_IF_ERROR(ForEachBlock(frame, [&](const GridWindow& at) -> absl::Status {
      RETURN_IF_ERROR(ReadGrid(grid, raster.bands[i], at, std::numeric_limits<float>::quiet_NaN(), values));
      if (std::ranges::all_of(values, [](float value) { return std::isnan(value); })) return absl::OkStatus();
      if (!std::isnan(none))
        for (float& value : values)
          if (std::isnan(value)) value = none;
      return Transfer(GF_Write, file.get(), i, at, values.data()) ? absl::OkStatus() : errors.CannotWrite(path);
    }));
  file.reset();
  return errors.any() ? errors.CannotWrite(path) : absl::OkStatus();
}

// A failure to write the last bytes of a file is not reported by every driver.
absl::Status CheckWritten(const Raster& raster, float none, const fs::path& path) {
  const Errors errors;
  ASSIGN_OR_RETURN(const NetcdfReader grid, NetcdfReader::Open(raster.grid));
  const Dataset file(Gdal::Get().open(path.c_str(), GA_ReadOnly));
  if (file == nullptr) return errors.CannotWrite(path);
  std::vector<float> values, written;
  const auto same = [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  for (std::size_t i = 0; i < raster.bands.size(); ++i)
    RETURN_IF_ERROR(ForEachBlock(raster.frame, [&](const GridWindow& at) -> absl::Status {
      RETURN_IF_ERROR(ReadGrid(grid, raster.bands[i], at, none, values));
      written.resize(values.size());
      if (!Transfer(GF_Read, file.get(), i, at, written.data()) || !std::ranges::equal(values, written, same))
        return errors.CannotWrite(path);
      return absl::OkStatus();
    }));
  return absl::OkStatus();
}

absl::Status Copy(const Raster& raster, float none, const char* driver, const Options& options, const fs::path& path) {
  RETURN_IF_ERROR(CheckGdal());
  const Gdal& gdal = Gdal::Get();
  fs::path plain = path;
  plain += ".plain.tif";
  absl::Status status = WritePlain(raster, none, plain);
  if (status.ok()) {
    const Errors errors;
    const Dataset from(gdal.open(plain.c_str(), GA_ReadOnly));
    Dataset to(from == nullptr ? nullptr
                               : gdal.create_copy(gdal.driver_by_name(driver), path.c_str(), from.get(), 0,
                                                  options.get(), nullptr, nullptr));
    const bool made = to != nullptr;
    to.reset();
    if (!made || errors.any()) status = errors.CannotWrite(path);
  }
  std::error_code not_there;
  fs::remove(plain, not_there);
  return status.ok() ? CheckWritten(raster, none, path) : status;
}

}  // namespace

absl::Status CheckGdal() {
  const std::string& missing = Gdal::Get().missing;
  if (missing.empty()) return absl::OkStatus();
  return absl::FailedPreconditionError(absl::StrCat("GeoTIFF and BAG need GDAL, which cannot be used (", missing,
                                                    "); install the package of ", ALBTPU_GDAL_LIBRARY,
                                                    ", or give --format netcdf"));
}

absl::Status WriteCog(const Raster& raster, const fs::path& path) {
  RETURN_IF_ERROR(CheckGdal());
  Options options;
  options("COMPRESS", "DEFLATE")("PREDICTOR", "YES")("BLOCKSIZE", absl::StrCat(kBlock))("BIGTIFF", "IF_SAFER");
  options("OVERVIEW_RESAMPLING", "NEAREST")("NUM_THREADS", "ALL_CPUS");
  return Copy(raster, std::numeric_limits<float>::quiet_NaN(), "COG", options, path);
}

bool HasVerticalSystem(const fs::path& path) {
  if (!CheckGdal().ok()) return false;
  const Errors errors;
  const Dataset file(Gdal::Get().open(path.c_str(), GA_ReadOnly));
  if (file == nullptr) return false;
  const std::string wkt = Gdal::Get().projection(file.get());
  return wkt.find("VERT_CS[") != std::string::npos || wkt.find("VERTCRS[") != std::string::npos;
}

absl::Status WriteBag(const Raster& raster, const std::string& metadata, const fs::path& path) {
  RETURN_IF_ERROR(CheckGdal());
  fs::path text = path;
  text += ".xml";
  if (!(std::ofstream(text) << metadata << std::flush))
    return absl::ResourceExhaustedError(absl::StrCat(text.string(), ": cannot be written; free some of its disk"));
  Options options;
  options("TEMPLATE", text.string())("BAG_VERSION", kBagVersion);
  const absl::Status status = Copy(raster, kNoBagValue, "BAG", options, path);
  std::error_code not_there;
  fs::remove(text, not_there);
  return status;
}

#endif

}  // namespace albtpu
