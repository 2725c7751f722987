#include "quality/report/stated_by_files.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "absl/strings/str_cat.h"

namespace albtpu::quality {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kHow =
    "the variances of the sources at samples of the pulses of each file, summed, over those of the totals; of the "
    "water "
    "column all, where a number of its uncertainty is assumed; values that are no standard deviations count for "
    "nothing";

double NumberOr(const Json& json, double absent) { return json.is_number() ? json.get<double>() : absent; }

struct Contributions {
  std::map<std::string, double> horizontal, vertical;  // Sums of variances, m^2.
  double points = 0, along = 0, up = 0;                // Biases: sums, m.
  Json to;
};

void AddShares(const Json& shares, double variance, std::map<std::string, double>& sums) {
  for (const auto& [name, share] : shares.items()) sums[name] += NumberOr(share, 0) * variance;
}

Json SigmasOf(const std::map<std::string, double>& sums, double points) {
  Json json = Json::object();
  double total = 0;
  for (const char* const name : {"air", "sea", "water", "datum", "extra"}) {
    const auto found = sums.find(name);
    const double variance = found == sums.end() ? 0 : found->second / points;
    json[name] = std::sqrt(std::max(variance, 0.0));
    total += variance;
  }
  json["total"] = std::sqrt(std::max(total, 0.0));
  return json;
}

}  // namespace

Json ProjectOf(const std::vector<AnnotatedLasFile>& files,
               const std::vector<std::pair<std::string, std::string>>& given) {
  Json project;
  for (const auto& [key, text] : given) project[key] = text;
  if (!project.is_null()) return project;
  for (const AnnotatedLasFile& file : files)
    if (Json of_file = MemberOf(file.summary()["input"], "project"); of_file.is_object()) return of_file;
  return nullptr;
}

StatedDatum DatumOf(const std::vector<AnnotatedLasFile>& files, const std::string& given) {
  std::string name = given;
  for (const AnnotatedLasFile& file : files) {
    if (!file.vertical_wkt().empty()) return {.name = file.vertical_name(), .wkt = file.vertical_wkt()};
    if (name.empty()) name = file.vertical_name();
  }
  return {.name = name, .wkt = ""};
}

Json NumbersOf(const Json& summary) {
  const auto of_total = [](const Json& in) {
    const Json numbers = MemberOf(MemberOf(in, "total"), "numbers");
    return numbers.is_object() ? numbers : Json::object();
  };
  const Json& parameters = summary["parameters"];
  if (!parameters.contains("channels") || !parameters["channels"].is_array()) return of_total(parameters);
  const Json names = summary["answers"].value("channels", Json());
  Json all = Json::object();
  for (std::size_t i = 0; i < parameters["channels"].size(); ++i) {
    const Json name = i < names.size() && names[i].is_object() ? names[i].value("name", Json()) : Json();
    const std::string channel = name.is_string() ? name.get<std::string>() : absl::StrCat("channel ", i + 1);
    const Json numbers = of_total(parameters["channels"][i]);
    for (const auto& [key, number] : numbers.items()) all[absl::StrCat(key, ", ", channel)] = number;
  }
  return all;
}

Json NumbersOf(const std::vector<AnnotatedLasFile>& files) {
  Json list = Json::array();
  std::set<std::string> seen;
  for (const AnnotatedLasFile& file : files) {
    const Json numbers = NumbersOf(file.summary());
    for (const auto& [name, number] : numbers.items()) {
      Json json = {{"name", name}};
      for (const char* const key : {"value", "source", "assumed"})
        if (number.is_object() && number.contains(key)) json[key] = number[key];
      if (seen.insert(json.dump()).second) list.push_back(std::move(json));
    }
  }
  return list;
}

Json OutcomesWithoutNumber(const std::vector<AnnotatedLasFile>& files, std::uint64_t points) {
  std::map<std::string, std::uint64_t> counts;
  for (const AnnotatedLasFile& file : files) {
    for (const auto& [outcome, count] : file.summary()["answers"]["outcomes"].items())
      if (outcome != "INTERPOLATED" && count.is_number_unsigned()) counts[outcome] += count.get<std::uint64_t>();
  }
  // Points of ours have all their reasons in the summaries; others may not.
  std::uint64_t named = 0;
  for (const auto& [outcome, count] : counts) named += count;
  // Summaries may count points that are left out here.
  if (named > points) counts.clear(), named = 0;
  if (named < points) counts["UNKNOWN"] = points - named;
  return counts.empty() ? Json::object() : Json(counts);
}

Json ContributionsOf(const std::vector<AnnotatedLasFile>& files) {
  std::map<double, Contributions> bands;
  for (const AnnotatedLasFile& file : files) {
    const Json of_bands = MemberOf(MemberOf(file.summary()["answers"], "total"), "depth_bands");
    if (!of_bands.is_array()) continue;  // No point has a total.
    for (const Json& band : of_bands) {
      const Json horizontal = MemberOf(band, "variance_horizontal"), vertical = MemberOf(band, "variance_vertical");
      if (!horizontal.is_number() || !vertical.is_number() || !MemberOf(band, "from").is_number()) return nullptr;
      Contributions& sums = bands[MemberOf(band, "from").get<double>()];
      const double points = NumberOr(MemberOf(band, "pulses"), 0);
      sums.to = MemberOf(band, "to");
      sums.points += points;
      sums.along += points * NumberOr(MemberOf(band, "mean_bias_along_beam"), 0);
      sums.up += points * NumberOr(MemberOf(band, "mean_bias_vertical"), 0);
      AddShares(MemberOf(band, "shares_horizontal"), points * horizontal.get<double>(), sums.horizontal);
      AddShares(MemberOf(band, "shares_vertical"), points * vertical.get<double>(), sums.vertical);
    }
  }
  Json list = Json::array();
  for (const auto& [from, sums] : bands) {
    if (sums.points <= 0) continue;
    list.push_back({{"from", from},
                    {"to", sums.to},
                    {"points", sums.points},
                    {"sigma_horizontal", SigmasOf(sums.horizontal, sums.points)},
                    {"sigma_vertical", SigmasOf(sums.vertical, sums.points)},
                    {"bias_along_beam", sums.along / sums.points},
                    {"bias_vertical", sums.up / sums.points}});
  }
  return list.empty() ? Json() : list;
}

Json AssumedOf(const std::vector<AnnotatedLasFile>& files) {
  struct Axis {
    const char *name, *variance;
    double total = 0, assumed = 0;
    std::map<std::string, double> sources = {};
  };
  Axis axes[] = {{"horizontal", "variance_horizontal"}, {"vertical", "variance_vertical"}};
  double samples = 0;
  for (const AnnotatedLasFile& file : files) {
    const Json total = MemberOf(file.summary()["answers"], "total"), stated = MemberOf(total, "sources");
    if (NumberOr(MemberOf(total, "pulses"), 0) == 0) continue;
    if (!stated.is_object()) return nullptr;
    samples += NumberOr(MemberOf(stated, "samples"), 0);
    for (Axis& axis : axes) {
      const double variance = NumberOr(MemberOf(stated, axis.variance), 0);
      axis.total += variance;
      axis.assumed += variance * NumberOr(MemberOf(MemberOf(stated, "assumed"), axis.name), 0);
      const Json sources = MemberOf(stated, "sources");
      for (const auto& [name, of] : sources.items())
        axis.sources[name] += variance * NumberOr(MemberOf(of, axis.name), 0);
    }
  }
  if (samples == 0) return nullptr;
  Json json;
  double share = 0;
  const auto fraction = [](double part, double whole) { return whole > 0 ? part / whole : 0.0; };
  for (const Axis& axis : axes) {
    json[axis.name] = fraction(axis.assumed, axis.total);
    share = std::max(share, fraction(axis.assumed, axis.total));
  }
  json["share"] = share;
  json["greatest_for_green"] = kMostAssumed;
  for (const Axis& axis : axes)
    for (const auto& [name, sum] : axis.sources) json["sources"][name][axis.name] = fraction(sum, axis.total);
  json["samples"] = samples;
  json["how"] = kHow;
  return json;
}

}  // namespace albtpu::quality
