// Sources of seas: of each sea, a table in this process or on a server. Both give the same numbers, bit for bit on the
// same instruction set.
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "service/client/credentials.h"
#include "service/client/patience.h"
#include "service/client/uncertainty_source.h"
#include "service/seas/known_sea.h"

namespace albtpu::client {

class SeaSources {
 public:
  virtual ~SeaSources() = default;

  // Compiles the sea, 10 to 40 ms, and opens its table, to which the source is fixed: `table().sea` summarizes the sea.
  // The source may outlive this object. Any number of threads may call this at the same time. InvalidArgument: a table
  // cannot hold the numbers of the sea, or a server refuses them, because they are out of the ranges of sea.proto. A
  // server also fails as in OpenServer.
  virtual absl::StatusOr<std::unique_ptr<UncertaintySource>> Open(const KnownSea& sea) = 0;
};

// Compiles seas in this process, each time anew, in water of this index. Each source holds its table: 1.2 MiB.
//
// Example:
//   const absl::StatusOr<SeaSeries> buoy = ReadSeaFile("41010.data_spec");
//   if (!buoy.ok()) return buoy.status();
//   const auto source = LocalSeas()->Open(
//       KnownSeaOf(buoy->records.back(), {.wind_speed_10m = 6, .water_depth = 12}, buoy->record_length));
//   if (!source.ok()) return source.status();
//   absl::Status status = (*source)->Answer({}, pulses, answers);
// where `pulses` and `answers` are as in the example in column_query.h. On such a sea pulses need no wind speed and no
// fetch; the columns of both are ignored.
std::unique_ptr<SeaSources> LocalSeas(double index = kSeaWaterIndex);

// Compiles seas on a server, which keeps the tables of the last ones. Arguments are those of OpenServer.
absl::StatusOr<std::unique_ptr<SeaSources>> ServerSeas(const std::string& address, const Patience& patience = {},
                                                       const Credentials& credentials = {},
                                                       double index = kSeaWaterIndex);

}  // namespace albtpu::client
