// Answers to the methods that take many pulses, from message to message as they travel. Reading and writing a
// long message takes as long as answering it: all three are one piece of work.
#pragma once

#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/status.h>

#include "service/server/observe/outcome_tally.h"
#include "service/server/tables/table_catalog.h"

namespace albtpu::server {

// Writes `response` and counts its pulses in `tally` if the status is OK. Bytes that are no message of the
// method are INVALID_ARGUMENT.
using ByteAnswer = grpc::Status (*)(const TableCatalog& catalog, const grpc::ByteBuffer& request,
                                    grpc::ByteBuffer& response, OutcomeTally& tally);

grpc::Status AnswerQueryPulses(const TableCatalog& catalog, const grpc::ByteBuffer& request,
                               grpc::ByteBuffer& response, OutcomeTally& tally);
grpc::Status AnswerQueryColumns(const TableCatalog& catalog, const grpc::ByteBuffer& request,
                                grpc::ByteBuffer& response, OutcomeTally& tally);
grpc::Status AnswerStreamColumns(const TableCatalog& catalog, const grpc::ByteBuffer& request,
                                 grpc::ByteBuffer& response, OutcomeTally& tally);  // One exchange.

}  // namespace albtpu::server
