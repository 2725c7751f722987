#include "service/column_message.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>
#include <grpc/slice.h>

#include <array>
#include <cstdint>

namespace albtpu {
namespace {

using google::protobuf::internal::WireFormatLite;
using google::protobuf::io::CodedOutputStream;

// The header of a field of type bytes or message: field number and length.
grpc::Slice Header(int field, std::size_t size) {
  std::array<std::uint8_t, 10> bytes;  // Each of the two takes at most 5 bytes.
  std::uint8_t* end = CodedOutputStream::WriteTagToArray(
      WireFormatLite::MakeTag(field, WireFormatLite::WIRETYPE_LENGTH_DELIMITED), bytes.data());
  end = CodedOutputStream::WriteVarint32ToArray(static_cast<std::uint32_t>(size), end);
  return grpc::Slice(bytes.data(), static_cast<std::size_t>(end - bytes.data()));
}

}  // namespace

void ColumnMessage::Add(const google::protobuf::MessageLite& message) {
  slices_.emplace_back(message.SerializeAsString());
}

char* ColumnMessage::AddColumn(int field, std::size_t size) {
  slices_.push_back(Header(field, size));
  const grpc_slice column = grpc_slice_malloc_large(size);  // Never stored inside the slice object, which moves.
  slices_.emplace_back(column, grpc::Slice::STEAL_REF);
  return reinterpret_cast<char*>(column.data.refcounted.bytes);
}

void ColumnMessage::Nest(int field, std::size_t mark) {
  const auto begin = slices_.begin() + static_cast<std::ptrdiff_t>(mark);
  std::size_t size = 0;
  for (auto slice = begin; slice != slices_.end(); ++slice) size += slice->size();
  slices_.insert(begin, Header(field, size));
}

}  // namespace albtpu
