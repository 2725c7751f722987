// Writes messages that consist mainly of long columns. Each column has its own memory, which the transport takes over,
// so that nothing is copied.
#pragma once

#include <google/protobuf/message_lite.h>
#include <grpcpp/support/byte_buffer.h>

#include <cstddef>
#include <vector>

namespace albtpu {

// Builds the bytes of a protobuf message field by field.
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
  // Adds all fields that are set in `message`.
  void Add(const google::protobuf::MessageLite& message);

  // Adds a field of type bytes and returns its memory, aligned for floats. It may be written before or after further
  // fields are added.
  char* AddColumn(int field, std::size_t size);

  // Nest() turns all fields added since `mark` into one field, a message.
  std::size_t Mark() const { return slices_.size(); }
  void Nest(int field, std::size_t mark);

  grpc::ByteBuffer Finish() const { return grpc::ByteBuffer(slices_.data(), slices_.size()); }

 private:
  std::vector<grpc::Slice> slices_;
};

}  // namespace albtpu
