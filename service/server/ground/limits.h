// Every limit of the server, with its reason.
#pragma once

#include <chrono>
#include <cstddef>

namespace albtpu::server {

// Largest message. By default a gRPC client accepts no larger one, so no answer may exceed it, and no request needs to.
inline constexpr std::size_t kMaxMessageBytes = std::size_t{4} << 20;

// Maximum number of pulses in one message. The largest answer in columns has 59 bytes per pulse: outcome and axis (2),
// six quantities and their standard errors (48), S-44 (9).
inline constexpr std::size_t kMaxPulses = 65536;
static_assert(kMaxPulses * 59 < kMaxMessageBytes);

// Pulses in one message of `QueryPulses` that asks for standard errors. An answer in rows has at most 52 bytes per
// pulse (message 2, outcome 2, absent azimuth 2, six quantities 32, S-44 14), and 84 with standard errors.
inline constexpr std::size_t kMaxPulsesWithStandardErrors = 32768;
static_assert(kMaxPulses * 52 < kMaxMessageBytes);
static_assert(kMaxPulsesWithStandardErrors * 84 < kMaxMessageBytes);

// Bytes of the columns of an answer to `QueryBudget`: with all its quantities, 179 for each pulse. The rest is for
// everything else, most of it what was assumed of a sea.
inline constexpr std::size_t kMaxAnswerColumnBytes = kMaxMessageBytes - (std::size_t{64} << 10);

// Requests up to this length are handled at once, on the thread that received them. They hold about 12 000 pulses in
// four columns, at most 49 000 in one column, and take half a millisecond; handing them to a worker and back would add
// a third. Longer requests wait for a worker, so that they never delay short ones.
inline constexpr std::size_t kMaxInlineBytes = std::size_t{192} << 10;

// The same for `QueryBudget`, whose pulses take about four times as long.
inline constexpr std::size_t kMaxInlineBudgetBytes = kMaxInlineBytes / 4;

// Calls of all connections that may wait for a worker; further ones fail with RESOURCE_EXHAUSTED. A stream counts while
// it is open; calls that are handled at once do not count. A call holds up to 12 MiB (a stream: the request being
// handled, the next request and one answer), all of them 1.5 GiB. Each worker holds another 8 MiB, or 20 MiB for
// pulses in rows.
inline constexpr int kMaxBulkCalls = 128;

// Limits of a sea in a request. Spectra of buoys and models have 25 to 100 frequencies, the program's own over
// wavenumber 281. With six harmonics such a sea takes 57 KiB. A component costs up to a millisecond of the time to
// compile a sea; partitions of models have three to seven.
inline constexpr std::size_t kMaxSeaSamples = 512;
inline constexpr std::size_t kMaxSeaComponents = 16;

// Pairs of pulses and cells of one question on the correlation of a sea. A pair takes up to two milliseconds of a
// processor, a cell a third of one.
inline constexpr int kMaxSeparations = 256;
inline constexpr int kMaxCells = 64;

// Wrong fields of a sea that an error lists: its details are metadata, within kMaxMetadataBytes.
inline constexpr std::size_t kMaxSeaViolations = 8;

// Seas that may wait to be compiled; requests with further ones fail with RESOURCE_EXHAUSTED. A sea takes 10 to 40 ms
// of a processor, so none waits for longer than a second. Callers who wait for the same sea count once here, and each
// among the kMaxBulkCalls.
inline constexpr std::size_t kMaxWaitingSeas = 16;

// Tables of seas that are kept for later requests: some 110 of 2.3 MiB, four days of hourly seas. A stream over time
// uses one or two at a time. The number counts if tables become smaller. Tables of the server's in water of another
// index are kept among them: some 40 MiB for the largest.
inline constexpr std::size_t kMaxSeaTables = 512;
inline constexpr std::size_t kMaxSeaTableBytes = std::size_t{256} << 20;

// Waters that may wait to be compiled; requests with further ones fail with RESOURCE_EXHAUSTED. A water takes half a
// second of a processor, so none waits for longer than five seconds. Callers count as those of seas.
inline constexpr std::size_t kMaxWaitingWaters = 8;

// Waters that are kept for later requests, 66 KiB each: those of a few hundred surveys.
inline constexpr std::size_t kMaxWaters = 256;
inline constexpr std::size_t kMaxWaterBytes = std::size_t{32} << 20;

// Calls in progress on one connection; further ones wait in the client. A connection that sends more after it has
// acknowledged this limit is closed; before the acknowledgement gRPC 1.51 enforces no limit.
inline constexpr int kMaxCallsPerConnection = 64;

// Calls that one connection may have in memory: those in progress, and those that were answered or cancelled but not
// yet freed. A busy server has about as many of the latter. A connection with more calls is closed.
inline constexpr long kMaxCallsInMemory = 4 * kMaxCallsPerConnection;

// Calls that all connections together may have in memory. Each takes 12 to 26 KiB beside its messages, all of them less
// than a gigabyte. Above this limit the connection with the most calls is closed.
inline constexpr long kMaxTotalCallsInMemory = 512 * kMaxCallsPerConnection;

// How often the memory of the process is read (about 30 us each time), and the growth after which the calls of all
// connections are counted (20 us per connection). One core makes at most 100 000 calls a second: 25 MiB between two
// checks.
inline constexpr std::chrono::milliseconds kMemoryCheckInterval{20};
inline constexpr std::size_t kMemoryGrowth = std::size_t{16} << 20;

// Bytes read from a connection at a time. gRPC makes calls of all of them, each 15 bytes or longer, before it checks
// whether the connection is still open. gRPC's default, 4 MiB, is no faster.
inline constexpr int kMaxReadBytes = 64 << 10;

// Requests and answers of single calls that were handled at once and whose callers have not yet read the answer. Above
// this limit calls fail with RESOURCE_EXHAUSTED. Long calls do not count here: kMaxBulkCalls limits them. An answer
// that is not read within kMaxStreamIdle is dropped. When half of the memory is in use, which one or two connections
// can cause, it is dropped after the shorter time: 3 MB, the longest answer, take that long at 5 Mbit/s.
inline constexpr std::size_t kMaxUnreadBytes = std::size_t{256} << 20;
inline constexpr std::chrono::seconds kMaxUnreadTimeWhenCrowded{5};

// Metadata before a message: method, token and deadline take a few hundred bytes. gRPC's default in both directions.
inline constexpr int kMaxMetadataBytes = 8 << 10;

// Length of an error message, which may repeat a name from the request. It travels as metadata twice: escaped, at most
// three times as long, and in the details, a third longer.
inline constexpr std::size_t kMaxErrorBytes = 1024;
static_assert(kMaxErrorBytes * 3 + kMaxErrorBytes * 4 / 3 < kMaxMetadataBytes);

// Connections open at a time: about a hundred for each bulk call. A silent connection holds about 20 KiB of memory, all
// of them 320 MiB. The operating system's limit on open files may be lower.
inline constexpr int kMaxConnections = 16384;

// File descriptors that are not connections of callers: listening sockets, the log, tables being read, connections of
// the metrics endpoint.
inline constexpr int kOwnDescriptors = 64;

// The limits below close connections that serve no purpose, and bound the memory of all connections together.

// From the first byte to the end of the TLS and HTTP/2 handshakes. A distant client needs a few hundred milliseconds; a
// client that connects and stays silent is disconnected after this time.
inline constexpr std::chrono::seconds kMaxHandshake{10};

// A connection without a call. Clients reconnect when they have a query.
inline constexpr std::chrono::minutes kMaxConnectionIdle{5};

// After this time, which gRPC varies by a tenth, a client is asked to reconnect, so that replaced certificates and
// removed authorities take effect. Calls in progress may continue for kMaxCallTime; then they are cut, and our clients
// resume where they were.
inline constexpr std::chrono::minutes kMaxConnectionAge{60};
inline constexpr std::chrono::minutes kMaxCallTime{10};

// A silent peer is pinged after kKeepaliveTime and disconnected if it does not reply within kKeepaliveTimeout: its
// machine or network may have failed, which nothing else would report.
inline constexpr std::chrono::seconds kKeepaliveTime{60};
inline constexpr std::chrono::seconds kKeepaliveTimeout{20};

// The third ping of a client that comes sooner than this closes its connection: a ping costs more to answer than to
// send.
inline constexpr std::chrono::seconds kMinPingInterval{10};

// A stream that holds one of the kMaxBulkCalls places while its caller neither sends nor reads ends after this time. A
// single call whose answer is not read does so, too. --max-stream-idle sets another.
inline constexpr std::chrono::seconds kMaxStreamIdle{60};

// Memory that gRPC may use for all connections, including messages in transit: those of kMaxBulkCalls, and half a
// gigabyte for tens of thousands of connections. Near this limit calls are refused and idle connections closed.
inline constexpr std::size_t kMaxConnectionBytes = std::size_t{2} << 30;

// How long calls in progress may continue after SIGTERM; within the grace period of 30 s that Kubernetes gives.
inline constexpr std::chrono::seconds kDrainTime{10};

// How long a stream that ends after SIGTERM keeps back its status. gRPC closes the connection with the last status and
// does not read what the caller still sends, such as updates of its window. The operating system then resets the
// connection, and answers that the caller has not read are lost (RFC 9112, 9.6, describes this for HTTP/1.1).
inline constexpr std::chrono::seconds kTimeToReadAnswers{1};

// Length of a caller's `x-request-id`, which is logged. A UUID has 36 characters, a W3C trace context 55.
inline constexpr std::size_t kMaxRequestIdBytes = 64;

// Log lines about calls per second; further lines are counted and not written: a caller in a loop must not fill a disk.
inline constexpr int kMaxCallLinesPerSecond = 100;

// gRPC uses threads for reflection only: one for each open stream. Further streams fail with RESOURCE_EXHAUSTED. Tools
// ask one or two questions.
inline constexpr int kReflectionThreads = 16;

// One or two clients read the metrics every few seconds, for milliseconds each time. A client that sends no request or
// does not read the answer within the timeout is disconnected.
inline constexpr int kMetricsThreads = 16;
inline constexpr std::chrono::milliseconds kMetricsTimeout{1000};

}  // namespace albtpu::server
