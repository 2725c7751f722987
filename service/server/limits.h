// Every limit of the server, with its reason.
#pragma once

#include <chrono>
#include <cstddef>

namespace albtpu::server {

// The default limit of gRPC on the messages that a client takes: no answer may pass it, nor need a request.
inline constexpr std::size_t kMaxMessageBytes = std::size_t{4} << 20;

// Pulses in one message. The largest answer in columns has 59 bytes a pulse: outcome and axis (2), six
// quantities and their standard errors (48), S-44 (9).
inline constexpr std::size_t kMaxPulses = 65536;
static_assert(kMaxPulses * 59 < kMaxMessageBytes);

// Pulses in one message of `QueryPulses` that asks for standard errors. In rows an answer has at most 52
// bytes a pulse (message 2, outcome 2, absent azimuth 2, six quantities 32, S-44 14), and 84 with standard
// errors.
inline constexpr std::size_t kMaxPulsesWithStandardErrors = 32768;
static_assert(kMaxPulses * 52 < kMaxMessageBytes);
static_assert(kMaxPulsesWithStandardErrors * 84 < kMaxMessageBytes);

// Requests up to this length are answered at once, on the thread that received them: some 12 000 pulses of four
// columns, half a millisecond, to which handing them over to a worker and back would add a third; 49 000 of
// one column at the most. Longer ones wait for a worker, so that they never stand in the way of short ones.
inline constexpr std::size_t kMaxInlineBytes = std::size_t{192} << 10;

// Calls under way that may wait for a worker, all connections together: beyond them calls fail with
// RESOURCE_EXHAUSTED. A stream counts as long as it is open; calls that are answered at once do not. A call
// holds up to 12 MiB (a stream: the request that is answered, the one after it and an answer), all of them
// 1.5 GiB; a worker holds 8 MiB more.
inline constexpr int kMaxBulkCalls = 128;

// Calls under way on one connection; further ones wait in the client.
inline constexpr int kMaxCallsPerConnection = 64;

// How long calls under way may go on after SIGTERM, within the 30 s of grace that Kubernetes gives.
inline constexpr std::chrono::seconds kDrainTime{10};

}  // namespace albtpu::server
