// The retries of a client when a server is not available.
#pragma once

#include <chrono>

namespace albtpu::client {

// How often a query is retried when the server becomes unavailable. The pauses between the retries double each time;
// the defaults add up to 12.7 s. Every answer received resets the count.
struct Patience {
  int retries = 7;
  std::chrono::milliseconds first_pause{100};
};

}  // namespace albtpu::client
