// The two layouts of an ASCII trajectory, distinguished by the number of columns.
//
// 15 columns, as users of cBLUE have them (its documentation of the class Sbet): time, longitude, latitude, X, Y, Z,
// roll, pitch, heading, sigma X, Y, Z, sigma roll, pitch, heading. Z is the height above the ellipsoid there.
//
// 20 columns, as the POS Export Utility of Applanix's POSPac writes them and the sensors PILLS and RAMMS come with:
// time, distance, easting, northing, height, latitude, longitude, ellipsoidal height, roll, pitch, heading, velocity
// east, north, up, sigma east, north, height, sigma roll, pitch, heading. The first height belongs to the map frame and
// may be orthometric, so it is not used. Text stands above the numbers, with the names and units of the columns.
//
// Angles and their sigmas are in degrees, all else in metres and seconds.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace albtpu::formats {

// The quantity of a column.
enum class AsciiField : unsigned char {
  kTime,
  kLongitude,
  kLatitude,
  kX,
  kY,
  kHeight,
  kRoll,
  kPitch,
  kHeading,
  kSigmaX,
  kSigmaY,
  kSigmaZ,
  kSigmaRoll,
  kSigmaPitch,
  kSigmaHeading,
  kVelocityEast,
  kVelocityNorth,
  kVelocityUp,
  kUnused,
};
inline constexpr std::size_t kAsciiFields = 19;

struct AsciiColumn {
  AsciiField field;
  const char* name;
  const char* unit;
  double least, largest;  // Values beyond them show that the column is another quantity.
  const char* names;      // Its names in headers: in lower case, each between bars.
};

inline constexpr std::size_t kMaxAsciiColumns = 20;

// The columns of a file with `count` columns; empty if there is no such layout.
std::span<const AsciiColumn> AsciiColumns(std::size_t count);

// Their standard deviations, for messages (trajectory_errors.h).
struct SigmaColumns;
SigmaColumns SigmaColumnsOf(std::span<const AsciiColumn> columns);

// The contradiction between the layout and a line of text above the numbers: a column with the name of another one, or
// units other than those above. Empty if there is none.
std::string HeaderContradiction(std::string_view line, std::span<const AsciiColumn> columns);

}  // namespace albtpu::formats
