// From serialized request to serialized response: the handlers of the methods that take many pulses, and the queries of
// `QueryPulses` and `CompileSea`.
#pragma once

#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/status.h>

#include "absl/status/status.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/server/calls/sea_request.h"
#include "service/server/observe/metric_collectors.h"

namespace albtpu::server {

// Queries pulses in rows, one message for each pulse, for `QueryPulses`.

// Counts the answers in `tally`. Rows are copied into columns and queried as those, so both give the same bits. Fails
// as documented for `QueryPulses`.
absl::Status QueryRows(AnswerSources& sources, const v1::QueryPulsesRequest& request, v1::QueryPulsesResponse& response,
                       OutcomeTally& tally);

// Handlers of the methods, from serialized request to serialized response. Parsing and serializing a long message take
// as long as the query itself, so a worker does all three; gRPC answers bytes that do not parse by UNIMPLEMENTED.

// If the status is OK, `response` is set and its pulses are counted in `tally`. Bytes that do not parse as the request
// message of the method are INVALID_ARGUMENT. If `sources.wanted()` has a value afterwards, nothing has happened: the
// request is to be handled again when that sea is compiled.
using MessageHandler = grpc::Status (*)(AnswerSources& sources, const grpc::ByteBuffer& request,
                                        grpc::ByteBuffer& response, OutcomeTally& tally);

grpc::Status HandleQueryPulses(AnswerSources& sources, const grpc::ByteBuffer& request, grpc::ByteBuffer& response,
                               OutcomeTally& tally);
grpc::Status HandleQueryColumns(AnswerSources& sources, const grpc::ByteBuffer& request, grpc::ByteBuffer& response,
                                OutcomeTally& tally);
grpc::Status HandleQueryBudget(AnswerSources& sources, const grpc::ByteBuffer& request, grpc::ByteBuffer& response,
                               OutcomeTally& tally);

grpc::Status HandleListTables(AnswerSources& sources, const grpc::ByteBuffer& request, grpc::ByteBuffer& response,
                              OutcomeTally& tally);
grpc::Status HandleGetTable(AnswerSources& sources, const grpc::ByteBuffer& request, grpc::ByteBuffer& response,
                            OutcomeTally& tally);
grpc::Status HandleCompileSea(AnswerSources& sources, const grpc::ByteBuffer& request, grpc::ByteBuffer& response,
                              OutcomeTally& tally);

// Handles one request of a stream.
grpc::Status HandleStreamColumns(AnswerSources& sources, const grpc::ByteBuffer& request, grpc::ByteBuffer& response,
                                 OutcomeTally& tally);

// The table of a sea, for `CompileSea`.

// Fails as documented for `CompileSea`.
absl::Status DescribeSea(AnswerSources& sources, const v1::CompileSeaRequest& request,
                         v1::CompileSeaResponse& response);

}  // namespace albtpu::server
