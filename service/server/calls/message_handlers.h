// Handlers of the methods that take many pulses, from serialized request to serialized response. Parsing and
// serializing a long message take as long as the query itself, so a worker does all three.
#pragma once

#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/status.h>

#include "service/server/calls/answer_sources.h"
#include "service/server/observe/outcome_tally.h"

namespace albtpu::server {

// If the status is OK, `response` is set and its pulses are counted in `tally`. Bytes that do not parse as the request
// message of the method are INVALID_ARGUMENT. If `sources.wanted()` has a value afterwards, nothing has happened: the
// request is to be handled again when that sea is compiled.
using MessageHandler = grpc::Status (*)(AnswerSources& sources, const grpc::ByteBuffer& request,
                                        grpc::ByteBuffer& response, OutcomeTally& tally);

grpc::Status HandleQueryPulses(AnswerSources& sources, const grpc::ByteBuffer& request,
                               grpc::ByteBuffer& response, OutcomeTally& tally);
grpc::Status HandleQueryColumns(AnswerSources& sources, const grpc::ByteBuffer& request,
                                grpc::ByteBuffer& response, OutcomeTally& tally);
grpc::Status HandleQueryBudget(AnswerSources& sources, const grpc::ByteBuffer& request,
                               grpc::ByteBuffer& response, OutcomeTally& tally);

grpc::Status HandleCompileSea(AnswerSources& sources, const grpc::ByteBuffer& request,
                              grpc::ByteBuffer& response, OutcomeTally& tally);

// Handles one request of a stream.
grpc::Status HandleStreamColumns(AnswerSources& sources, const grpc::ByteBuffer& request,
                                 grpc::ByteBuffer& response, OutcomeTally& tally);

}  // namespace albtpu::server
