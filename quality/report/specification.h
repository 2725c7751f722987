// Specifications of accuracy as TOML files: classes with a limit of THU and TVU that may grow with the depth.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "tables/coverage.h"

namespace albtpu::quality {

// The limit of an uncertainty at a depth: constant + of_depth depth, or the root of the sum of the squares of both.
struct Limit {
  double constant = 0;  // m
  double of_depth = 0;  // m in a metre of depth.
  bool rss = false;     // The root of the sum of the squares.

  double At(double depth) const;  // m; depth in m, 0 or more.
};

// A class, such as an order of S-44. It limits at least one of the two.
struct SpecificationClass {
  std::string name;
  Coverage coverage = Coverage::kP95;  // Of the limits.
  std::optional<Limit> horizontal = {}, vertical = {};
  std::string also = {};  // What it asks beside these, in words; may be empty.
};

struct Specification {
  std::string name = {};     // Of the file: "s44".
  std::string title = {};    // "IHO S-44"
  std::string edition = {};  // Of the document, whose text was read: "6.1.0 (2022)"; empty if nobody stated it.
  std::string source = {};   // The document.
  // Its limits are those of root mean square errors, which hold for all dry points together and for no single point.
  bool land = false;
  std::vector<SpecificationClass> classes = {};
};

// All of it, compact, for `made_from` of a report.
nlohmann::ordered_json LimitsJson(const Specification& specification);

// Fails on the first problem of the text, with its line.
//
//     title = "Harbour of Mine"
//     source = "Port authority, order 12 of 2021"
//     edition = "2"                                                        # may be left out
//     land = "rmse"                                                        # may be left out
//     [[class]]
//     name = "berths"
//     coverage = "p95"                                                     # or "1sigma", "2sigma"
//     horizontal = {constant = 2}                                          # m
//     vertical = {constant = 0.25, of_depth = 0.0075, combined = "rss"}    # or "sum"
//     also = "bathymetric coverage 100 %"                                  # may be left out
absl::StatusOr<Specification> ParseSpecification(std::string_view text);

// The value of the environment variable `ALBTPU_SPECIFICATIONS`; if it is empty or not set,
// PREFIX/share/albtpu/specifications for a program that runs as PREFIX/bin/NAME.
std::filesystem::path SpecificationsDirectory();

// All installed specifications, S-44 first and the others by name. NotFound if there is none.
absl::StatusOr<std::vector<Specification>> ListSpecifications();

// The specification in a file (ends in .toml or has a slash), or the installed one of this name in any case; "S-44" is
// "s44". NotFound with the names that there are.
absl::StatusOr<Specification> FindSpecification(std::string_view name_or_path);

// Without those of land.
std::vector<Specification> OfPoints(const std::vector<Specification>& specifications);

// Classes of all of them.
std::size_t ClassCount(const std::vector<Specification>& specifications);

// A class in a list of specifications.
struct WantedClass {
  std::size_t specification = 0, of_class = 0;  // In the list.
  std::size_t index = 0;                        // Over all classes.
};
// The class of this name of the specification `name`. InvalidArgument with the names that there are.
absl::StatusOr<WantedClass> FindClass(const std::vector<Specification>& specifications, const std::string& name,
                                      const std::string& class_name);

}  // namespace albtpu::quality
