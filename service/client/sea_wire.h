// Seas as messages, and their summaries from a server.
#pragma once

#include "albtpu/v1/sea.pb.h"
#include "service/seas/known_sea.h"
#include "service/seas/sea_summary.h"

namespace albtpu::client {

// Every number of the sea, bit for bit. The server checks the limits of sea.proto.
albtpu::v1::SeaState ToWire(const KnownSea& sea);

SeaSummary FromWire(const albtpu::v1::SeaSummary& sea);

}  // namespace albtpu::client
