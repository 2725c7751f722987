// The Extra Bytes record of LAS (LASF_Spec 4), which describes the bytes of a point after the fields of its format, and
// the floats that are appended to each record.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/las/las_reader.h"
#include "tables/coverage.h"

namespace albtpu::formats {

// One of the numbers that are appended to each record.
struct AppendedFloat {
  std::string_view name, description;  // At most 32 bytes each.
  float no_data = 0;
  bool is_byte = false;  // An unsigned byte instead, without a no-data value.

  std::size_t size() const { return is_byte ? 1 : sizeof(float); }
};

// Together, of a list.
std::size_t BytesOf(const std::vector<AppendedFloat>& appended);

// The byte share_of: what a total is made of.
enum class ShareOf : std::uint8_t { kNone, kLand, kWater };

inline constexpr float kNoNumber = -1;  // The no-data value of lengths; that of angles is NaN.

// The floats that are appended to each record.
struct Appended {
  Coverage coverage = Coverage::kTwoSigma;
  bool total = false;    // The total uncertainty, not the contribution of the sea surface alone.
  bool water = false;    // The total includes the water column.
  bool extra = false;    // The total includes what the surveyor adds.
  bool details = false;  // The geometry of each beam, too; of a total also its contributions, biases and covariance.
  bool terrain = false;  // A total with details has the slope of the terrain and what it adds, too.

  bool share_of() const { return total && details; }
};

// In this order in a record: sea_thu and sea_tvu, or total_thu and total_tvu; of a total with details kTotalDetailCount
// more, with `extra` two more behind tvu_water, and with terrain terrain_slope, tvu_slope, tvu_footprint; with details
// the geometry; of a total with details share_of, the only byte.
std::vector<AppendedFloat> AppendedFloats(const Appended& appended);

inline constexpr std::size_t kUncertaintyCount = 2;
// thu_air to tvu_water, tvu_pulse, tvu_line, two biases, six entries of the covariance.
inline constexpr std::size_t kTotalDetailCount = 16;
inline constexpr std::size_t kGeometryCount = 5;  // incidence, beam_azimuth, footprint, water_depth, slant_range

// Bytes; the capacity of a VLR.
inline constexpr std::size_t kLargestExtraBytesRecord = 65535;

// The data of the Extra Bytes record of a file; empty if it has none. A file should have one VLR of them. Some have
// several, or an EVLR: their entries are one list, in the order of the file. Where one of them has the whole list, and
// the others its beginning, that is the list. Fails when the list is ambiguous: when records describe a name twice, or
// more bytes than a point has.
absl::StatusOr<std::string> ReadExtraBytesRecord(const LasReader& reader);

// Extra bytes of the input that have the name of an appended float, and take its values in its place.
struct ReplacedFloat {
  std::size_t appended = 0;  // Which of the appended floats.
  std::size_t offset = 0;    // In the extra bytes of a point.
  bool is_double = false;    // Otherwise the type of what is appended.
};

struct AppendedDescription {
  std::string record;                   // The data of the VLR.
  std::vector<ReplacedFloat> replaced;  // By `appended`.
};

// The data of the record after descriptions of `appended` have been added. `described` is the existing data, which is
// kept byte for byte but for what is replaced; it is empty if the file has no such record. `extra_bytes` is the actual
// number of extra bytes in a point. Bytes without a description get entries of type 0, "undocumented", so that readers
// find ours at the right offset. With `replace`, entries of a name of ours that are floats or doubles get our
// description, no-data value and no scale, and are not added again.
//
// Fails when a name exists already (with `replace`: and has another type, or twice), when more bytes are described than
// exist, when a type is unknown, or when the result does not fit a VLR.
absl::StatusOr<AppendedDescription> DescribeAppended(const std::string& name, std::string_view described,
                                                     std::size_t extra_bytes,
                                                     const std::vector<AppendedFloat>& appended, bool replace = false);

// Where the floats (type 9) lie in the extra bytes of a point, by their names. `described` and `extra_bytes` as above;
// fails when an entry has an unknown type, or when more bytes are described than exist.
absl::StatusOr<std::map<std::string, std::size_t, std::less<>>> FloatOffsets(const std::string& name,
                                                                             std::string_view described,
                                                                             std::size_t extra_bytes);

// The same of unsigned bytes (type 1), such as share_of.
absl::StatusOr<std::map<std::string, std::size_t, std::less<>>> ByteOffsets(const std::string& name,
                                                                            std::string_view described,
                                                                            std::size_t extra_bytes);

}  // namespace albtpu::formats
