#include "quality/surface/surface_part.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "annotate/answers/batch.h"
#include "quality/surface/point_tiles.h"
#include "status/status_macros.h"
#include "tables/digest.h"
#include "tables/version.h"

namespace albtpu::quality {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::array<char, 8> kSealMagic = {'a', 'l', 'b', 't', 'p', 'u', 'S', '1'};

// The end of a part. The digest is of all bytes before it.
struct Tail {
  std::uint64_t points_end = 0;
  Sha256Digest digest = {};
  std::array<char, 8> magic = kSealMagic;
};
constexpr std::size_t kDigested = offsetof(Tail, digest);

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

absl::Status Damaged(const fs::path& path) {
  return absl::DataLossError(absl::StrCat(path.string(), ": was cut short or changed; make it again"));
}

absl::Status IsNoPart(const fs::path& path) {
  return absl::DataLossError(
      absl::StrCat(path.string(), ": is no part of a surface; give files that albtpu-query surface --partial wrote"));
}

// Of the first `count` bytes; false where the file has fewer.
bool DigestOf(std::FILE* file, std::uint64_t count, Sha256& digest) {
  constexpr std::uint64_t kPiece = 1 << 20;
  std::vector<char> bytes(kPiece);
  while (count > 0) {
    const std::size_t read = std::fread(bytes.data(), 1, std::min(count, kPiece), file);
    if (read == 0) return false;
    digest.Update(bytes.data(), read);
    count -= read;
  }
  return true;
}

Json ToJson(const PartFacts& facts) {
  const SurfaceMap& map = facts.map;
  Json json = {{"program_version", std::string(Version())},
               {"cell", facts.cell},
               {"crs", {map.crs_name, map.crs_wkt, map.vertical_name, map.vertical_wkt}},
               {"metres_per_unit", map.metres_per_unit},
               {"coverage", annotate::CoverageName(facts.coverage)},
               {"table_digest", facts.table_digest},
               {"files", Json::array()},
               {"summary_digests", facts.summary_digests},
               {"seas", Json::array()},
               {"sources", Json::array()},
               {"points", {facts.with_number, facts.without_number}},
               {"dry", facts.dry.has_value() ? Json(*facts.dry) : Json()},
               {"left_out", {facts.left_out.withheld, facts.left_out.noise}},
               {"times", Json()}};
  for (const PartFile& file : facts.files) json["files"].push_back({file.name, file.bytes, file.points, file.bounds});
  for (const SeaOfSource& sea : facts.seas)
    json["seas"].push_back(
        {sea.spectrum.k, sea.spectrum.s, sea.spectrum.a, sea.spectrum.b, sea.x_azimuth, sea.water_index});
  for (const SourceOfPoints& source : facts.sources)
    json["sources"].push_back({source.sea, source.groups.pulse, source.groups.line, source.groups.survey});
  if (facts.times.has_value()) json["times"] = {facts.times->first, facts.times->second};
  return json;
}

// Throws where a member is missing or has another type.
PartFacts FactsOf(const Json& json) {
  PartFacts facts;
  json.at("cell").get_to(facts.cell);
  const Json& crs = json.at("crs");
  facts.map = {.crs_name = crs.at(0), .crs_wkt = crs.at(1), .vertical_name = crs.at(2), .vertical_wkt = crs.at(3)};
  json.at("metres_per_unit").get_to(facts.map.metres_per_unit);
  facts.coverage = annotate::FindCoverage(json.at("coverage").get<std::string>()).value();
  json.at("table_digest").get_to(facts.table_digest);
  for (const Json& file : json.at("files"))
    facts.files.push_back({.name = file.at(0), .bytes = file.at(1), .points = file.at(2), .bounds = file.at(3)});
  json.at("summary_digests").get_to(facts.summary_digests);
  for (const Json& sea : json.at("seas"))
    facts.seas.push_back({.spectrum = {.k = sea.at(0), .s = sea.at(1), .a = sea.at(2), .b = sea.at(3)},
                          .x_azimuth = sea.at(4),
                          .water_index = sea.at(5)});
  for (const Json& source : json.at("sources"))
    facts.sources.push_back(
        {.sea = source.at(0), .groups = {.pulse = source.at(1), .line = source.at(2), .survey = source.at(3)}});
  facts.with_number = json.at("points").at(0), facts.without_number = json.at("points").at(1);
  if (const Json& dry = json.at("dry"); !dry.is_null()) facts.dry = dry.get<std::uint64_t>();
  facts.left_out = {.withheld = json.at("left_out").at(0), .noise = json.at("left_out").at(1)};
  if (const Json& times = json.at("times"); !times.is_null()) facts.times = {times.at(0), times.at(1)};
  return facts;
}

bool IsWhole(const PartFacts& facts) {
  return facts.files.empty() == facts.seas.empty() && facts.cell > 0 && facts.map.metres_per_unit > 0 &&
         std::ranges::all_of(facts.sources, [&](const auto& source) { return source.sea < facts.seas.size(); });
}

}  // namespace

absl::Status SealPart(const SurfacePart& part) {
  const std::string facts = ToJson(part.facts).dump(-1, ' ', false, Json::error_handler_t::replace);
  Tail tail = {.points_end = part.points_end};
  Sha256 digest;
  {
    const File points(std::fopen(part.path.c_str(), "rb"), &std::fclose);
    if (points == nullptr || !DigestOf(points.get(), part.points_end, digest)) return Damaged(part.path);
  }
  digest.Update(facts);
  digest.Update(&tail, kDigested);
  tail.digest = digest.Finish();
  std::FILE* const file = std::fopen(part.path.c_str(), "ab");
  bool written = file != nullptr && std::fwrite(facts.data(), facts.size(), 1, file) == 1 &&
                 std::fwrite(&tail, sizeof(tail), 1, file) == 1;
  written &= file != nullptr && std::fclose(file) == 0;
  return written ? absl::OkStatus() : CannotWritePoints(part.path);
}

absl::StatusOr<SurfacePart> OpenPart(const fs::path& path) {
  const File file(std::fopen(path.c_str(), "rb"), &std::fclose);
  std::error_code error;
  if (file == nullptr || fs::is_directory(path, error))
    return absl::NotFoundError(
        absl::StrCat(path.string(), ": cannot be read (", std::strerror(file == nullptr ? errno : EISDIR), ")"));
  const std::uint64_t size = fs::file_size(path, error);
  if (error || !IsPointsFile(file.get())) return IsNoPart(path);
  Tail tail;
  if (size < sizeof(tail) || std::fseek(file.get(), -static_cast<long>(sizeof(tail)), SEEK_END) != 0 ||
      std::fread(&tail, sizeof(tail), 1, file.get()) != 1 || tail.magic != kSealMagic ||
      tail.points_end > size - sizeof(tail))
    return Damaged(path);
  std::string text(size - sizeof(tail) - tail.points_end, '\0');
  if (std::fseek(file.get(), static_cast<long>(tail.points_end), SEEK_SET) != 0 ||
      (!text.empty() && std::fread(text.data(), text.size(), 1, file.get()) != 1))
    return Damaged(path);
  Sha256 digest;
  std::rewind(file.get());
  if (!DigestOf(file.get(), size - sizeof(tail) + kDigested, digest) || digest.Finish() != tail.digest)
    return Damaged(path);
  const Json json = Json::parse(text, nullptr, false);
  const Json version = json.is_object() ? json.value("program_version", Json()) : Json();
  if (version != std::string(Version()))
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": was made by version ", version.dump(),
                                                   " of albtpu-query, this is ", std::string(Version()),
                                                   "; make all parts and merge them by one version"));
  SurfacePart part = {.path = path, .facts = {}, .points_end = tail.points_end};
  try {
    part.facts = FactsOf(json);
  } catch (const std::exception&) {
    return IsNoPart(path);
  }
  return IsWhole(part.facts) ? absl::StatusOr<SurfacePart>(std::move(part)) : IsNoPart(path);
}

}  // namespace albtpu::quality
