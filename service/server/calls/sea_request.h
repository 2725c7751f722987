// The sea of a request (read, checked and named), and the tables and waters from which a request may be answered.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "absl/status/statusor.h"
#include "albtpu/v1/sea.pb.h"
#include "service/seas/known_sea.h"
#include "service/server/calls/sea_tables.h"
#include "service/server/calls/water_shares.h"
#include "service/server/tables/table_catalog.h"
#include "tables/digest.h"

namespace albtpu::server {

// INVALID_ARGUMENT with the paths of the wrong fields, relative to `state`: of a list only the first wrong number, and
// kMaxSeaViolations fields at most.
absl::StatusOr<KnownSea> ReadSea(const v1::SeaState& state);

// SHA-256 over the fields of `state` that this server knows, and the index of the water. States with the same key are
// equal.
Sha256Digest KeyOf(const v1::SeaState& state, double index = kSeaWaterIndex);

// `index`, the refractive index of a request, or that of sea water if it has none. INVALID_ARGUMENT for the field
// `path` if it is not from 1 to 2.
absl::StatusOr<double> ReadIndex(bool given, double index, std::string_view path);

// What a request needs and had to be made: when the request is handled, it may no longer be kept. Null: not needed.
struct MadeForRequest {
  std::shared_ptr<const ServedTable> table;
  std::shared_ptr<const ServedWater> water;
};

// The tables and waters from which one request may be answered.
class AnswerSources {
 public:
  // `catalog`, `seas` and `waters` must outlive it. `waters` may be null for requests that cannot have a water.
  AnswerSources(const TableCatalog& catalog, SeaTables& seas, WaterShares* waters, MadeForRequest made = {})
      : catalog_(catalog), seas_(seas), waters_(waters), made_(std::move(made)) {}

  // All live as long as catalog and this object. If one is not made yet, wanted() has a value and the returned error
  // means nothing.
  //
  // The table of this name, as TableCatalog::Find, in water of the index.
  absl::StatusOr<const ServedTable*> Find(std::string_view table, double index);

  // The table of a sea. INVALID_ARGUMENT with the paths of wrong fields, which begin with `sea`.
  absl::StatusOr<const ServedTable*> Find(const v1::SeaState& sea, double index);

  // The compiled water, which `known` has read. FAILED_PRECONDITION: the server cannot compile it.
  absl::StatusOr<const ServedWater*> Find(const v1::WaterState& water, const KnownWater& known);

  const TableCatalog& catalog() const { return catalog_; }
  const std::optional<std::variant<WantedTable, WantedWater>>& wanted() const { return wanted_; }

 private:
  const TableCatalog& catalog_;
  SeaTables& seas_;
  WaterShares* const waters_;
  MadeForRequest made_;
  std::optional<std::variant<WantedTable, WantedWater>> wanted_;
};

}  // namespace albtpu::server
