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

// SHA-256 over the fields of `state` that this server knows. States with the same key are equal.
Sha256Digest KeyOf(const v1::SeaState& state);

// The tables from which one request may be answered.

// A sea of a request, to be compiled before the request can be handled.
struct WantedSea {
  Sha256Digest key;
  KnownSea sea;
};

class AnswerSources {
 public:
  // `catalog` and `seas` must outlive it. `compiled` is the table of the sea of the request, if it had to be compiled:
  // when the request is handled, it may no longer be kept.
  AnswerSources(const TableCatalog& catalog, SeaTables& seas, std::shared_ptr<const ServedTable> compiled = nullptr)
      : catalog_(catalog), seas_(seas), sea_table_(std::move(compiled)) {}

  // The table of this name, as TableCatalog::Find. Lives as long as the catalog.
  absl::StatusOr<const ServedTable*> Find(std::string_view table) const;

  // The table of a sea. Lives as long as this object. INVALID_ARGUMENT with the paths of wrong fields, which begin with
  // `sea`. If the sea is not compiled yet, wanted() has a value and the returned error means nothing.
  absl::StatusOr<const ServedTable*> Find(const v1::SeaState& sea);

  const std::optional<WantedSea>& wanted() const { return wanted_; }

 private:
  const TableCatalog& catalog_;
  SeaTables& seas_;
  std::shared_ptr<const ServedTable> sea_table_;
  std::optional<WantedSea> wanted_;
};

}  // namespace albtpu::server
