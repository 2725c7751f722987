// Messages that are long columns and little else, written once: each column has memory of its own, which the
// transport takes over, so that nothing is copied on the way.
#pragma once

#include <google/protobuf/message_lite.h>
#include <grpcpp/support/byte_buffer.h>

#include <cstddef>
#include <vector>

namespace albtpu {

// The bytes of a protobuf message in the making, field by field.
//
// Example, a `QueryColumnsRequest` of depths:
//   ColumnMessage request;
//   request.Add(options_and_quantities);  // A QueryColumnsRequest without pulses.
//   const std::size_t pulses = request.Mark();
//   std::memcpy(request.AddColumn(PulseColumns::kDepthFieldNumber, 4 * n), depth, 4 * n);
//   request.Nest(QueryColumnsRequest::kPulsesFieldNumber, pulses);
//   grpc::ByteBuffer bytes = request.Finish();
class ColumnMessage {
 public:
  // All fields that are set in `message`.
  void Add(const google::protobuf::MessageLite& message);

  // A field of type bytes. The result is where to write them, before or after further fields are added; it is
  // aligned for floats.
  char* AddColumn(int field, std::size_t size);

  // Makes one field, a message, of all fields that were added since `mark`.
  std::size_t Mark() const { return slices_.size(); }
  void Nest(int field, std::size_t mark);

  grpc::ByteBuffer Finish() const { return grpc::ByteBuffer(slices_.data(), slices_.size()); }

 private:
  std::vector<grpc::Slice> slices_;
};

}  // namespace albtpu
