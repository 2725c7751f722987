#include "formats/trajectories/ascii_columns.h"

#include <array>
#include <numbers>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "formats/trajectories/trajectory_sigmas.h"

namespace albtpu::formats {
namespace {

using enum AsciiField;

// Times may be seconds of the week or GPS time minus 1e9 s, which is negative before 2011.
constexpr double kMinTime = -1e9, kLargestTime = 1e10;
constexpr double kLargestGrid = 1e8;  // Metres or feet, with false eastings of some millions.
constexpr double kLowest = -1000, kHighest = 30000;
constexpr double kLargestSigma = 10000;  // m
constexpr double kLargestSpeed = 500;    // m/s
constexpr double kAnyNumber = 1e300;

constexpr std::array<AsciiColumn, 15> kCblue = {{
    {kTime, "time", "s", kMinTime, kLargestTime, "|time|t|gpstime|gps_time|gps time|"},
    {kLongitude, "longitude", "degree", -360, 360, "|lon|long|longitude|"},
    {kLatitude, "latitude", "degree", -90, 90, "|lat|latitude|"},
    {kX, "X", "m", -kLargestGrid, kLargestGrid, "|x|easting|east|"},
    {kY, "Y", "m", -kLargestGrid, kLargestGrid, "|y|northing|north|"},
    {kHeight, "Z", "m", kLowest, kHighest, "|z|height|altitude|ellipsoid height|"},
    {kRoll, "roll", "degree", -180, 180, "|roll|"},
    {kPitch, "pitch", "degree", -90, 90, "|pitch|"},
    {kHeading, "heading", "degree", -360, 720, "|heading|"},
    {kSigmaX, "sigma X", "m", 0, kLargestSigma, "|stdx|east sd|"},
    {kSigmaY, "sigma Y", "m", 0, kLargestSigma, "|stdy|north sd|"},
    {kSigmaZ, "sigma Z", "m", 0, kLargestSigma, "|stdz|height sd|"},
    {kSigmaRoll, "sigma roll", "degree", 0, 180, "|stdroll|roll sd|"},
    {kSigmaPitch, "sigma pitch", "degree", 0, 180, "|stdpitch|pitch sd|"},
    {kSigmaHeading, "sigma heading", "degree", 0, 180, "|stdheading|heading sd|"},
}};

constexpr std::array<AsciiColumn, 20> kPosExport = {{
    {kTime, "time", "s", kMinTime, kLargestTime, "|time|"},
    {kUnused, "distance", "m", -kAnyNumber, kAnyNumber, "|distance|"},
    {kX, "easting", "m", -kLargestGrid, kLargestGrid, "|easting|"},
    {kY, "northing", "m", -kLargestGrid, kLargestGrid, "|northing|"},
    {kUnused, "height", "m", -kAnyNumber, kAnyNumber, "|orthometric height|"},
    {kLatitude, "latitude", "degree", -90, 90, "|latitude|"},
    {kLongitude, "longitude", "degree", -360, 360, "|longitude|"},
    {kHeight, "ellipsoid height", "m", kLowest, kHighest, "||"},
    {kRoll, "roll", "degree", -180, 180, "|roll|"},
    {kPitch, "pitch", "degree", -90, 90, "|pitch|"},
    {kHeading, "heading", "degree", -360, 720, "|heading|"},
    {kVelocityEast, "east velocity", "m/s", -kLargestSpeed, kLargestSpeed, "|east velocity|"},
    {kVelocityNorth, "north velocity", "m/s", -kLargestSpeed, kLargestSpeed, "|north velocity|"},
    {kVelocityUp, "up velocity", "m/s", -kLargestSpeed, kLargestSpeed, "|up velocity|"},
    {kSigmaX, "east SD", "m", 0, kLargestSigma, "|east sd|"},
    {kSigmaY, "north SD", "m", 0, kLargestSigma, "|north sd|"},
    {kSigmaZ, "height SD", "m", 0, kLargestSigma, "|height sd|"},
    {kSigmaRoll, "roll SD", "degree", 0, 180, "|roll sd|"},
    {kSigmaPitch, "pitch SD", "degree", 0, 180, "|pitch sd|"},
    {kSigmaHeading, "heading SD", "degree", 0, 180, "|heading sd|"},
}};

// Names of columns, separated by semicolons, tabs or commas if there are any (they may consist of several words then),
// else by blanks.
std::vector<std::string> Names(std::string_view line) {
  const absl::string_view text(line.data(), line.size());
  std::vector<std::string> names;
  const char separator = absl::StrContains(text, ";") ? ';' : absl::StrContains(text, "\t") ? '\t' : ',';
  if (absl::StrContains(text, absl::string_view(&separator, 1)))
    for (const absl::string_view name : absl::StrSplit(text, separator))
      names.push_back(absl::AsciiStrToLower(absl::StripAsciiWhitespace(name)));
  else
    for (const absl::string_view name : absl::StrSplit(text, absl::ByAnyChar(" \t\r"), absl::SkipEmpty()))
      names.push_back(absl::AsciiStrToLower(name));
  return names;
}

// The units as the POS Export Utility states them, in one sentence above the numbers.
std::string UnitContradiction(std::string_view line) {
  const absl::string_view text(line.data(), line.size());
  if (!absl::StrContains(text, "(time in ")) return "";
  for (const char* unit : {"time in Sec", "position in Meters", "lat, long in Degrees",
                           "orientation angles and SD in Degrees", "velocity in Meter/Sec", "position SD in Meters"})
    if (!absl::StrContains(text, unit))
      return absl::StrCat("units other than '", unit, "'; export the trajectory with these units");
  return "";
}

}  // namespace

std::span<const AsciiColumn> AsciiColumns(std::size_t count) {
  if (count == kCblue.size()) return kCblue;
  if (count == kPosExport.size()) return kPosExport;
  return {};
}

SigmaColumns SigmaColumnsOf(std::span<const AsciiColumn> columns) {
  // As kSigmaFields: north, east, down, velocities, roll, pitch, heading.
  constexpr std::array kFields = {kSigmaY, kSigmaX,    kSigmaZ,     kUnused,      kUnused,
                                  kUnused, kSigmaRoll, kSigmaPitch, kSigmaHeading};
  SigmaColumns found = {.angle = "degrees",
                        .radians = std::numbers::pi / 180,
                        .if_unknown =
                            "write 0 in all three columns of the position or of the attitude, and state them "
                            "by [sigma] of a survey file"};
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (std::size_t field = 0; field < kFields.size(); ++field)
      if (columns[i].field == kFields[field])
        found.names[field] = absl::StrCat("column ", i + 1, " '", columns[i].name, "'");
  return found;
}

std::string HeaderContradiction(std::string_view line, std::span<const AsciiColumn> columns) {
  if (std::string units = UnitContradiction(line); !units.empty()) return units;
  const std::vector<std::string> names = Names(line);
  if (names.size() != columns.size()) return "";
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty()) continue;
    const std::string quoted = absl::StrCat("|", names[i], "|");
    if (absl::StrContains(columns[i].names, quoted)) continue;
    for (const AsciiColumn& other : columns) {
      if (!absl::StrContains(other.names, quoted)) continue;
      return absl::StrCat("column ", i + 1, " is '", names[i], "', not ", columns[i].name,
                          "; write the columns in the order of docs/client.md");
    }
  }
  return "";
}

}  // namespace albtpu::formats
