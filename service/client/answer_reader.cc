#include "service/client/answer_reader.h"

#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/wire_format_lite.h>
#include <grpcpp/support/proto_buffer_reader.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "service/client/wire.h"
#include "service/wire_values.h"
#include "status/status_macros.h"

namespace albtpu::client {
namespace {

namespace v1 = albtpu::v1;
using google::protobuf::internal::WireFormatLite;
using google::protobuf::io::CodedInputStream;
using Response = v1::QueryColumnsResponse;

constexpr int kTop = 0;  // Stands for the response itself where a field number is expected.

// A column of the message: its position there, and its destination.
struct Column {
  int message;  // The field of the response that contains it, or kTop.
  int field;
  std::size_t element_size;
  void* destination;  // Null if the column is not requested.
  std::string name;
  bool found = false;
};

std::vector<Column> Columns(const Query& query, const AnswerColumns& answers) {
  const auto name = [](int message, int field) {
    const auto* in =
        message == kTop ? Response::descriptor() : Response::descriptor()->FindFieldByNumber(message)->message_type();
    return in->FindFieldByNumber(field)->name();
  };
  std::vector<Column> columns;
  const auto add = [&](int message, int field, auto* destination) {
    columns.push_back({message, field, sizeof *destination, destination, name(message, field)});
  };
  add(kTop, Response::kOutcomesFieldNumber, answers.outcomes);
  add(kTop, Response::kOutcomeAxesFieldNumber, answers.outcome_axes);
  for (int i = 0; i < static_cast<int>(kQuantityCount); ++i) {  // Field i + 1 is quantity i.
    add(Response::kSeaSurfaceFieldNumber, i + 1, answers.values[i]);
    add(Response::kSeaSurfaceStandardErrorFieldNumber, i + 1, answers.standard_errors[i]);
  }
  add(Response::kS44FieldNumber, v1::S44Columns::kBestOrdersFieldNumber, answers.best_s44_orders);
  if (query.s44_order.has_value()) {
    add(Response::kS44FieldNumber, v1::S44Columns::kRemainingThuFieldNumber, answers.remaining_thu);
    add(Response::kS44FieldNumber, v1::S44Columns::kRemainingTvuFieldNumber, answers.remaining_tvu);
  }
  return columns;
}

bool HoldsColumns(int field) {
  return field == Response::kSeaSurfaceFieldNumber || field == Response::kSeaSurfaceStandardErrorFieldNumber ||
         field == Response::kS44FieldNumber;
}

class Reader {
 public:
  Reader(CodedInputStream& input, std::size_t pulse_count, std::vector<Column> columns)
      : input_(input), pulse_count_(pulse_count), columns_(std::move(columns)) {}

  // Reads to the end of the input, or of the limit pushed on it.
  absl::StatusOr<Response> Read() {
    google::protobuf::io::StringOutputStream rest(&rest_);
    {
      google::protobuf::io::CodedOutputStream writer(&rest);
      RETURN_IF_ERROR(ReadFields(kTop, writer));
    }
    for (const Column& column : columns_)
      if (column.destination != nullptr && !column.found) return WrongLength(column, 0);
    Response response;
    if (!response.ParseFromString(rest_)) return Unreadable();
    return response;
  }

 private:
  static absl::Status Unreadable() { return absl::InternalError("answered bytes that are not a valid message"); }

  absl::Status WrongLength(const Column& column, std::size_t size) const {
    return absl::InternalError(absl::StrCat("answered ", size, " bytes of ", column.name, " for ", pulse_count_,
                                            " pulses; expected ", column.element_size, " for each"));
  }

  absl::Status ReadFields(int message, google::protobuf::io::CodedOutputStream& rest) {
    while (const std::uint32_t tag = input_.ReadTag()) {
      const int field = WireFormatLite::GetTagFieldNumber(tag);
      const auto column = std::find_if(columns_.begin(), columns_.end(),
                                       [&](const Column& c) { return c.message == message && c.field == field; });
      const bool nested = message == kTop && HoldsColumns(field);
      absl::Status status;
      if (column == columns_.end() && !nested) {
        const bool skipped =
            message == kTop ? WireFormatLite::SkipField(&input_, tag, &rest) : WireFormatLite::SkipField(&input_, tag);
        if (!skipped) return Unreadable();
        continue;
      }
      std::uint32_t size;
      const bool has_length = WireFormatLite::GetTagWireType(tag) == WireFormatLite::WIRETYPE_LENGTH_DELIMITED;
      if (!has_length || !input_.ReadVarint32(&size)) return Unreadable();
      if (nested) {
        const CodedInputStream::Limit limit = input_.PushLimit(static_cast<int>(size));
        status = ReadFields(field, rest);
        input_.PopLimit(limit);
      } else {
        status = ReadColumn(*column, size);
      }
      if (!status.ok()) return status;
    }
    return input_.ConsumedEntireMessage() ? absl::OkStatus() : Unreadable();
  }

  absl::Status ReadColumn(Column& column, std::size_t size) {
    const int length = static_cast<int>(size);
    if (column.destination == nullptr) return input_.Skip(length) ? absl::OkStatus() : Unreadable();
    if (size != pulse_count_ * column.element_size) return WrongLength(column, size);
    column.found = true;
    return input_.ReadRaw(column.destination, length) ? absl::OkStatus() : Unreadable();
  }

  CodedInputStream& input_;
  const std::size_t pulse_count_;
  std::vector<Column> columns_;
  std::string rest_;
};

void FillWithNaN(float* column, std::size_t count) {
  if (column != nullptr) std::fill_n(column, count, std::numeric_limits<float>::quiet_NaN());
}

absl::StatusOr<Response> ReadFrom(CodedInputStream& input, const Query& query, std::size_t pulse_count,
                                  const AnswerColumns& answers) {
  absl::StatusOr<Response> head = Reader(input, pulse_count, Columns(query, answers)).Read();
  if (!head.ok()) return head;
  const v1::Coverage coverage = ToWire(query.coverage);
  absl::Status status;
  if (head->coverage() != coverage)
    status = absl::InternalError(absl::StrCat("answered coverage ", head->coverage(), "; expected ", coverage));
  status.Update(CheckNumbers(answers.outcomes, pulse_count, "outcomes", 1, v1::Outcome_MAX));
  status.Update(CheckNumbers(answers.outcome_axes, pulse_count, "outcome axes", 0, v1::Axis_MAX));
  status.Update(CheckNumbers(answers.best_s44_orders, pulse_count, "best orders", 0, v1::S44Order_MAX));
  if (!status.ok()) return status;
  if (!query.s44_order.has_value()) {  // Without an order there is no remaining budget.
    FillWithNaN(answers.remaining_thu, pulse_count);
    FillWithNaN(answers.remaining_tvu, pulse_count);
  }
  return head;
}

}  // namespace

absl::Status CheckNumbers(const std::uint8_t* column, std::size_t count, const char* name, int first, int last) {
  if (column == nullptr) return absl::OkStatus();
  std::uint8_t least = 255, most = 0;  // The loop has no early exit, so that the compiler vectorizes it.
  for (std::size_t i = 0; i < count; ++i) {
    least = std::min(least, column[i]);
    most = std::max(most, column[i]);
  }
  const auto known = [&](std::uint8_t number) { return number >= first && number <= last; };
  if (count == 0 || (known(least) && known(most))) return absl::OkStatus();
  const std::uint8_t* unknown = std::find_if_not(column, column + count, known);
  return absl::InternalError(
      absl::StrCat("answered ", *unknown, " among the ", name, ", a number that this program does not know"));
}

absl::StatusOr<Response> ReadAnswer(grpc::ByteBuffer& bytes, const Query& query, std::size_t pulse_count,
                                    const AnswerColumns& answers) {
  grpc::ProtoBufferReader reader(&bytes);
  CodedInputStream input(&reader);
  return ReadFrom(input, query, pulse_count, answers);
}

absl::StatusOr<Response> ReadStreamedAnswer(grpc::ByteBuffer& bytes, const Query& query, std::size_t pulse_count,
                                            const AnswerColumns& answers) {
  grpc::ProtoBufferReader reader(&bytes);
  CodedInputStream input(&reader);
  std::uint32_t size;
  const std::uint32_t tag =
      WireFormatLite::MakeTag(v1::StreamColumnsResponse::kAnswerFieldNumber, WireFormatLite::WIRETYPE_LENGTH_DELIMITED);
  if (!reader.status().ok() || input.ReadTag() != tag || !input.ReadVarint32(&size))
    return absl::InternalError("answered a message without an answer");
  input.PushLimit(static_cast<int>(size));
  return ReadFrom(input, query, pulse_count, answers);
}

}  // namespace albtpu::client
