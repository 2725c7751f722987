// The names and limits of the written form, which FORMAT.md specifies. Those of the user block are in seal.h, the
// names of axes and variables in schema.h.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace albtpu::format {

// Attributes of the file that are written from the members of a table. No other attribute may have their names.
inline constexpr std::string_view kConventions = "Conventions";
inline constexpr std::string_view kId = "id";
inline constexpr std::string_view kVersion = "version";
inline constexpr std::string_view kTitle = "title";
inline constexpr std::string_view kCampaign = "campaign";
inline constexpr std::string_view kContentDigest = "content_digest";
inline constexpr std::string_view kCoverage = "coverage";
inline constexpr std::string_view kTableKind = "table_kind";
inline constexpr std::array<std::string_view, 8> kReservedAttributes = {
    kConventions, kId, kVersion, kTitle, kCampaign, kContentDigest, kCoverage, kTableKind};

// Free, but what it states matters: of the water for which the table was computed.
inline constexpr std::string_view kRefractiveIndex = "refractive_index";

inline constexpr std::string_view kConventionsValue = "CF-1.10";
inline constexpr std::string_view kCoverageValue = "2 sigma";
// The kind of the files that have no attribute `table_kind`. They never have one.
inline constexpr std::string_view kDefaultTableKind = "sea_surface";

// Attributes of datasets.
inline constexpr std::string_view kUnits = "units";
inline constexpr std::string_view kLongName = "long_name";
inline constexpr std::string_view kInterpolation = "interpolation";
inline constexpr std::string_view kAncillaryVariables = "ancillary_variables";
inline constexpr std::string_view kFillValue = "_FillValue";

// The maximum number of nodes of an axis and of values of a variable (1 GiB): they bound the memory that a malformed
// file can make a reader allocate.
inline constexpr std::size_t kMaxNodeCount = std::size_t{1} << 16;
inline constexpr std::size_t kMaxValueCount = std::size_t{1} << 28;

// The largest node, the smallest distance between two nodes (on a log scale also the smallest node) and the largest
// magnitude of a value, each in its own units. They are far beyond any sea, and within them single precision suffices
// to interpolate.
inline constexpr double kMaxNode = 1e9;
inline constexpr double kMinNodeDistance = 1e-6;
inline constexpr float kMaxValue = 1e6f;

// The maximum size of an attribute in bytes. The longest one, the campaign, has a few thousand.
inline constexpr std::size_t kMaxAttributeBytes = std::size_t{1} << 24;

// A chunk holds at most this many values (256 KiB).
inline constexpr std::size_t kMaxChunkValues = std::size_t{1} << 16;

inline constexpr unsigned kDeflateLevel = 6;

// The first bytes that the content digest is computed over.
inline constexpr std::string_view kContentDigestPrefix = "albtpu table content 1\n";

}  // namespace albtpu::format
