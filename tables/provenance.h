// The origin of a table: its global attributes and the rules for them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "absl/status/status.h"

namespace albtpu {

using AttributeValue = std::variant<std::string, std::int64_t, double, std::vector<double>>;

// The origin of a table, from which it can be checked and made again. `id` names what the table is, `version` which
// edition of it. Neither is the name of its file.
struct Provenance {
  std::string id;        // [a-z0-9][a-z0-9_-]*
  std::string version;   // not empty
  std::string title;     // one line
  std::string campaign;  // the TOML text that it was made from; empty for published tables
  // All other global attributes, by name (FORMAT.md).
  std::map<std::string, AttributeValue> attributes;
};

// InvalidArgument, naming the attribute, if a rule of `Provenance` is broken, if a text is not UTF-8 or contains
// NUL, or if the name of an attribute is not [A-Za-z_][A-Za-z0-9_]* or is reserved (format.h).
absl::Status CheckProvenance(const Provenance& provenance);

}  // namespace albtpu
