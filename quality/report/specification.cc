#include "quality/report/specification.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_replace.h"
#include "annotate/answers/batch.h"
#include "config/toml/toml_keys.h"
#include "formats/text/text.h"
#include "status/status_macros.h"
#include "tables/default_tables.h"

namespace albtpu::quality {
namespace {

using namespace config;

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr TomlKind kSpecificationFile = {"a specification file", "the limits", "the path of --spec"};
constexpr double kMaxLimit = 1000;  // m

std::optional<Limit> ReadLimit(TomlKeys& of_class, std::string_view key) {
  for (TomlKeys& keys : of_class.Table(key)) {
    Limit limit;
    const std::optional<double> constant = keys.Number("constant", 0, kMaxLimit, "m");
    const std::optional<double> of_depth = keys.Number("of_depth", 0, 1, "m in a metre of depth");
    const std::optional<std::string> combined = keys.OneOf("combined", {"sum", "rss"});
    keys.Finish();
    limit.constant = constant.value_or(0);
    limit.of_depth = of_depth.value_or(0);
    limit.rss = combined == "rss";
    if (!keys.Has("constant")) keys.Fail("constant is missing; give the limit at depth 0 in m");
    if (keys.Has("of_depth") && !keys.Has("combined"))
      keys.Fail("combined is missing; say \"sum\" or \"rss\", the root of the sum of the squares");
    return limit;
  }
  return std::nullopt;
}

SpecificationClass ReadClass(TomlKeys& keys) {
  SpecificationClass read;
  read.name = keys.Text("name", "the name of a class").value_or("");
  const std::optional<std::string> coverage = keys.OneOf("coverage", {"p95", "2sigma", "1sigma"});
  if (coverage == "2sigma") read.coverage = Coverage::kTwoSigma;
  if (coverage == "1sigma") read.coverage = Coverage::kOneSigma;
  read.horizontal = ReadLimit(keys, "horizontal");
  read.vertical = ReadLimit(keys, "vertical");
  read.also = keys.Text("also", "what the class asks beside its limits").value_or("");
  keys.Finish();
  if (!keys.Has("name")) keys.Fail("name is missing; give the name of the class");
  if (!keys.Has("coverage")) keys.Fail("coverage is missing; give that of the limits, \"p95\" or \"1sigma\"");
  if (!read.horizontal.has_value() && !read.vertical.has_value())
    keys.Fail("has no limit; give horizontal, vertical or both");
  return read;
}

// Land has no depth, and an RMSE is 1 sigma.
bool IsOfRmse(const SpecificationClass& of) {
  const auto grows = [](const std::optional<Limit>& limit) { return limit.has_value() && limit->of_depth > 0; };
  return of.coverage == Coverage::kOneSigma && !grows(of.horizontal) && !grows(of.vertical);
}

absl::StatusOr<Specification> ReadSpecification(const fs::path& path) {
  ASSIGN_OR_RETURN(const std::string text, ReadTomlText(path, kSpecificationFile));
  absl::StatusOr<Specification> specification = ParseSpecification(text);
  if (!specification.ok()) return InFile(path, specification.status());
  specification->name = path.stem().string();
  return specification;
}

std::vector<std::string> InstalledNames() {
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(SpecificationsDirectory(), error))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  std::stable_partition(names.begin(), names.end(), [](const std::string& name) { return name == "s44"; });
  return names;
}

absl::Status NotInstalled() {
  return absl::NotFoundError(absl::StrCat("there are no specifications in ", SpecificationsDirectory().string(),
                                          "; name their folder by ALBTPU_SPECIFICATIONS, or give the path of a "
                                          "file by --spec"));
}

}  // namespace

double Limit::At(double depth) const {
  return rss ? std::hypot(constant, of_depth * depth) : constant + of_depth * depth;
}

nlohmann::ordered_json LimitsJson(const Specification& specification) {
  Json json = {{"name", specification.name},     {"title", specification.title}, {"edition", specification.edition},
               {"source", specification.source}, {"land", specification.land},   {"classes", Json::array()}};
  for (const SpecificationClass& of : specification.classes) {
    Json limits = Json::array({of.name, annotate::CoverageName(of.coverage)});
    for (const auto& limit : {of.horizontal, of.vertical})
      limits.push_back(limit.has_value() ? Json{limit->constant, limit->of_depth, limit->rss} : Json());
    json["classes"].push_back(std::move(limits));
  }
  return json;
}

absl::StatusOr<Specification> ParseSpecification(std::string_view text) {
  ASSIGN_OR_RETURN(const toml::table table, ParseToml(text, kSpecificationFile));
  TomlProblem problem(kSpecificationFile);
  TomlKeys root(table, "", problem);
  Specification read;
  read.title = root.Text("title", "the name of the specification").value_or("");
  read.source = root.Text("source", "the document").value_or("");
  std::set<std::string> names;
  for (TomlKeys& keys : root.Tables("class")) {
    read.classes.push_back(ReadClass(keys));
    if (!names.insert(read.classes.back().name).second) keys.Fail("has the name of another class; give each its own");
  }
  read.edition = root.Text("edition", "that of the document").value_or("");
  read.land = root.OneOf("land", {"rmse"}).has_value();
  for (const SpecificationClass& of : read.classes)
    if (read.land && !IsOfRmse(of))
      root.Fail(absl::StrCat("class ", of.name,
                             " is none of root mean square errors, which land = \"rmse\" asks for; "
                             "give it coverage = \"1sigma\" and limits without of_depth"));
  root.Finish();
  for (const std::string_view key : {"title", "source", "class"})
    if (!root.Has(key)) root.Fail(absl::StrCat(std::string(key), " is missing; give title, source and each [[class]]"));
  if (!problem.status().ok()) return problem.status();
  return read;
}

fs::path SpecificationsDirectory() {
  if (const char* folder = std::getenv("ALBTPU_SPECIFICATIONS"); folder != nullptr && *folder != '\0') return folder;
  return InstalledDataDirectory() / "specifications";
}

absl::StatusOr<std::vector<Specification>> ListSpecifications() {
  std::vector<Specification> specifications;
  for (const std::string& name : InstalledNames()) {
    ASSIGN_OR_RETURN(Specification read, ReadSpecification(SpecificationsDirectory() / (name + ".toml")));
    specifications.push_back(std::move(read));
  }
  if (specifications.empty()) return NotInstalled();
  if (std::ranges::find(specifications, "s44", &Specification::name) == specifications.end())
    return absl::NotFoundError(
        absl::StrCat(SpecificationsDirectory().string(),
                     ": has no s44.toml, by whose orders maps are drawn; copy the installed one there, or give a "
                     "specification of your own by the path of its file"));
  return specifications;
}

absl::StatusOr<Specification> FindSpecification(std::string_view name_or_path) {
  if (name_or_path.ends_with(".toml") || name_or_path.find('/') != std::string_view::npos)
    return ReadSpecification(fs::path(name_or_path));
  const std::vector<std::string> names = InstalledNames();
  const std::string name = absl::StrReplaceAll(absl::AsciiStrToLower(std::string(name_or_path)), {{"-", ""}});
  if (std::ranges::find(names, name) != names.end())
    return ReadSpecification(SpecificationsDirectory() / (name + ".toml"));
  if (names.empty()) return NotInstalled();
  return absl::NotFoundError(
      absl::StrCat("'", formats::OneLine(std::string(name_or_path)), "' is no specification",
                   formats::Suggestion(name, names, absl::StrCat("there are ", absl::StrJoin(names, ", ")))));
}

std::vector<Specification> OfPoints(const std::vector<Specification>& specifications) {
  std::vector<Specification> of_points;
  std::ranges::remove_copy_if(specifications, std::back_inserter(of_points), &Specification::land);
  return of_points;
}

std::size_t ClassCount(const std::vector<Specification>& specifications) {
  std::size_t count = 0;
  for (const Specification& each : specifications) count += each.classes.size();
  return count;
}

absl::StatusOr<WantedClass> FindClass(const std::vector<Specification>& specifications, const std::string& name,
                                      const std::string& class_name) {
  std::size_t index = 0;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < specifications.size(); ++i)
    for (std::size_t k = 0; k < specifications[i].classes.size(); ++k, ++index) {
      if (specifications[i].name != name) continue;
      names.push_back(specifications[i].classes[k].name);
      if (names.back() == class_name) return WantedClass{i, k, index};
    }
  return absl::InvalidArgumentError(
      absl::StrCat("'", formats::OneLine(class_name), "' is no class of the specification ", name,
                   formats::Suggestion(class_name, names, absl::StrCat("there are ", absl::StrJoin(names, ", ")))));
}

}  // namespace albtpu::quality
