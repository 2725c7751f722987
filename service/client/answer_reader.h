// Reads answers from the bytes of a message directly into the columns of the caller.
#pragma once

#include <google/protobuf/io/coded_stream.h>
#include <grpcpp/support/byte_buffer.h>

#include <cstddef>
#include <cstdint>

#include "absl/status/statusor.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "tables/query/column_query.h"
#include "tables/query/pulse_columns.h"

namespace albtpu::client {

// Reads a QueryColumnsResponse to `query` about `pulse_count` pulses. Fills the columns of `answers` that are not
// null and returns all other fields. Internal when the answer violates the protocol: its coverage is not that of the
// query, a column has the wrong length, or a number is not a known outcome, axis or order.
absl::StatusOr<albtpu::v1::QueryColumnsResponse> ReadAnswer(grpc::ByteBuffer& bytes, const Query& query,
                                                            std::size_t pulse_count, const AnswerColumns& answers);

// The same for a StreamColumnsResponse.
absl::StatusOr<albtpu::v1::QueryColumnsResponse> ReadStreamedAnswer(grpc::ByteBuffer& bytes, const Query& query,
                                                                    std::size_t pulse_count,
                                                                    const AnswerColumns& answers);

// Internal if one of `count` numbers of an answer, the `name`, is not within `first` to `last`. The column may be null.
absl::Status CheckNumbers(const std::uint8_t* column, std::size_t count, const char* name, int first, int last);

}  // namespace albtpu::client
