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
// 1.5 GiB; a worker holds 8 MiB more, 20 MiB where pulses come in rows.
inline constexpr int kMaxBulkCalls = 128;

// Calls under way on one connection; further ones wait in the client. A connection that sends them all the same
// is closed if it has acknowledged this number: until then gRPC 1.51 knows no limit.
inline constexpr int kMaxCallsPerConnection = 64;

// Calls that a connection may have in memory: those under way, and those of which something is left, though
// they were answered or taken back. A busy server has as many of these; a connection that has more is ended.
inline constexpr long kMaxCallsInMemory = 4 * kMaxCallsPerConnection;

// And all connections together, 12 to 26 KiB each beside their messages: less than a gigabyte. Beyond it the
// connection with the most is ended.
inline constexpr long kMaxCallsOfAll = 512 * kMaxCallsPerConnection;

// How often the memory of the process is looked at, some 30 us each time, and after how much growth the calls
// of its connections are, 20 us for each. A core makes at most 100 000 calls a second: 25 MiB between two
// looks.
inline constexpr std::chrono::milliseconds kMemoryLook{20};
inline constexpr std::size_t kMemoryGrowth = std::size_t{16} << 20;

// What is read of a connection at a time: gRPC makes calls of all of it, of 15 bytes each at least, before it
// looks whether the connection still stands. The default of gRPC, 4 MiB, is no faster.
inline constexpr int kMaxReadBytes = 64 << 10;

// Of single calls that are answered at once, requests and answers whose callers have not read the answer:
// beyond them calls fail with RESOURCE_EXHAUSTED. Long calls are not among them: they have their places. An
// answer that is not read for kMaxStreamIdle is dropped; sooner when half of the room is taken, which a
// connection or two can do: 3 MB, the longest, pass within this time at 5 Mbit/s.
inline constexpr std::size_t kMaxUnreadBytes = std::size_t{256} << 20;
inline constexpr std::chrono::seconds kMaxUnreadWhenCrowded{5};

// What comes before a message: method, token, deadline take some hundred bytes. The default of gRPC, in both
// directions.
inline constexpr int kMaxMetadataBytes = 8 << 10;

// Of the message of an error, which may repeat a name from the request. Escaped it takes three times as much
// at most, in details a third more than it is: all of it passes as metadata.
inline constexpr std::size_t kMaxErrorBytes = 1024;
static_assert(kMaxErrorBytes * 3 + kMaxErrorBytes * 4 / 3 < kMaxMetadataBytes);

// Connections that are open at a time, a hundred for each bulk call; those that say nothing hold
// some 20 KiB of memory each, 320 MiB in all. The limit of the system on open files may be lower.
inline constexpr int kMaxConnections = 16384;

// Open files that are no connections of callers: sockets that listen, log, tables while they are read, those
// who ask for metrics.
inline constexpr int kOwnDescriptors = 64;

// No connection is kept that is of no use, and all together have limited memory.

// From the first byte to the end of the handshakes of TLS and HTTP/2. A client far away needs some hundred
// milliseconds; one that connects and is silent is gone after this.
inline constexpr std::chrono::seconds kMaxHandshake{10};

// A connection without a call. Clients connect anew when they have something to ask.
inline constexpr std::chrono::minutes kMaxConnectionIdle{5};

// Whoever has been connected for this long is asked to connect anew: then certificates that were replaced,
// and authorities that are trusted no more, have effect. gRPC spreads it by a tenth. What is under way goes on
// for kMaxCallTime more; then it is cut, and our clients go on where they were.
inline constexpr std::chrono::minutes kMaxConnectionAge{60};
inline constexpr std::chrono::minutes kMaxCallTime{10};

// A silent peer is asked for a sign of life, and given up without one: its machine or network has gone, and
// nobody else will say so.
inline constexpr std::chrono::seconds kKeepaliveTime{60};
inline constexpr std::chrono::seconds kKeepaliveTimeout{20};

// The third sign of life that a client asks for sooner than this closes its connection: pings cost more to
// answer than to send.
inline constexpr std::chrono::seconds kMinPingInterval{10};

// Nothing moves in a stream: the caller sends nothing, or does not read. It has one of kMaxBulkCalls places.
// Or the answer of a single call is not read.
inline constexpr std::chrono::seconds kMaxStreamIdle{60};

// What gRPC may hold for all connections, messages that come and go included: those of kMaxBulkCalls, and
// half a gigabyte for tens of thousands of connections. Near it calls are refused, idle connections closed.
inline constexpr std::size_t kMaxConnectionBytes = std::size_t{2} << 30;

// How long calls under way may go on after SIGTERM, within the 30 s of grace that Kubernetes gives.
inline constexpr std::chrono::seconds kDrainTime{10};

// Of a caller's `x-request-id`, which stands in the log: a UUID has 36, a trace context of W3C 55.
inline constexpr std::size_t kMaxRequestIdBytes = 64;

// Lines about calls in the log, a second; those beyond are counted, not written. Nobody reads more, and a
// caller in a loop must not fill a disk.
inline constexpr int kMaxCallLinesPerSecond = 100;

// gRPC gives each stream of reflection a thread for as long as it is open, and to nothing else; further ones
// fail with RESOURCE_EXHAUSTED. Tools ask one question or two.
inline constexpr int kReflectionThreads = 16;

// Those who ask for metrics: one or two, each for milliseconds, every few seconds. Who sends no request or
// does not read the answer is let go.
inline constexpr int kMetricsThreads = 16;
inline constexpr std::chrono::milliseconds kMetricsTimeout{1000};

}  // namespace albtpu::server
