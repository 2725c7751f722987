// The sea of a request (read, checked and named), and the tables from which a request may be answered.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "absl/status/statusor.h"
#include "albtpu/v1/sea.pb.h"
#include "service/seas/known_sea.h"
#include "service/server/calls/sea_tables.h"
#include "service/server/tables/table_catalog.h"
#include "tables/digest.h"

namespace albtpu::server {

// INVALID_ARGUMENT with the paths of the wrong fields, relative to `state`: of a list only the first wrong number, and
// kMaxSeaViolations fields at most.
absl::StatusOr<KnownSea> ReadSea(const v1::SeaState& state);

// SHA-256 over the fields of `state` that this server knows, and the index of the water. States with the same key are
// equal.
Sha256Digest KeyOf(const v1::SeaState& state, double index = kSeaWaterIndex);

// The tables from which one request may be answered.

// `index`, the refractive index of a request, or that of sea water if it has none. INVALID_ARGUMENT for the field
// `path` if it is not from 1 to 2.
absl::StatusOr<double> ReadIndex(bool given, double index, std::string_view path);

class AnswerSources {
 public:
  // `catalog` and `seas` must outlive it. `compiled` is the table that the request needs, if it had to be made: when
  // the request is handled, it may no longer be kept.
  AnswerSources(const TableCatalog& catalog, SeaTables& seas, std::shared_ptr<const ServedTable> compiled = nullptr)
      : catalog_(catalog), seas_(seas), made_(std::move(compiled)) {}

  // Both live as long as catalog and this object. If a table is not made yet, wanted() has a value and the returned
  // error means nothing.
  //
  // The table of this name, as TableCatalog::Find, in water of the index.
  absl::StatusOr<const ServedTable*> Find(std::string_view table, double index);

  // The table of a sea. INVALID_ARGUMENT with the paths of wrong fields, which begin with `sea`.
  absl::StatusOr<const ServedTable*> Find(const v1::SeaState& sea, double index);

  const std::optional<WantedTable>& wanted() const { return wanted_; }

 private:
  const TableCatalog& catalog_;
  SeaTables& seas_;
  std::shared_ptr<const ServedTable> made_;
  std::optional<WantedTable> wanted_;
};

}  // namespace albtpu::server
