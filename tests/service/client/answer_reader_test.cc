#include "service/client/answer_reader.h"

#include <gtest/gtest.h>

#include "tests/service/client/column_memory.h"

namespace albtpu::client {
namespace {

namespace v1 = albtpu::v1;

// A valid answer for one pulse.
v1::QueryColumnsResponse GoodResponse() {
  v1::QueryColumnsResponse response;
  response.set_coverage(v1::COVERAGE_TWO_SIGMA);
  response.set_outcomes("\1");
  response.set_outcome_axes(std::string(1, '\0'));
  auto& columns = *response.mutable_sea_surface();
  for (std::string* column :
       {columns.mutable_refraction_along_wind(), columns.mutable_refraction_cross_wind(), columns.mutable_thu(),
        columns.mutable_tvu(), columns.mutable_bias_along_beam(), columns.mutable_bias_vertical()})
    *column = std::string(4, '\0');
  return response;
}

TEST(AnswerReader, RejectsAnswersThatViolateTheProtocol) {
  AnswerMemory memory(1);
  AnswerColumns requested = memory.columns();
  requested.standard_errors = {};
  requested.best_s44_orders = nullptr;
  requested.remaining_thu = requested.remaining_tvu = nullptr;
  const auto read = [&](const v1::QueryColumnsResponse& response) {
    const grpc::Slice slice(response.SerializeAsString());
    grpc::ByteBuffer bytes(&slice, 1);
    return ReadAnswer(bytes, {}, 1, requested);
  };
  EXPECT_TRUE(read(GoodResponse()).ok());
  auto response = GoodResponse();
  response.set_coverage(v1::COVERAGE_P95);
  EXPECT_FALSE(read(response).ok());
  response = GoodResponse();
  response.set_outcomes("\1\1");
  EXPECT_FALSE(read(response).ok());
  for (const char* outcome : {"\7", "\xff"}) {
    response = GoodResponse();
    response.set_outcomes(outcome);
    EXPECT_FALSE(read(response).ok());
  }
  response = GoodResponse();
  response.set_outcome_axes("\7");
  EXPECT_FALSE(read(response).ok());
  response = GoodResponse();
  response.mutable_sea_surface()->set_tvu("short");
  EXPECT_FALSE(read(response).ok());
  requested.standard_errors[0] = memory.columns().standard_errors[0];
  EXPECT_FALSE(read(GoodResponse()).ok());  // The answer has no standard errors.
}

TEST(AnswerReader, RejectsBytesThatAreNotAMessage) {
  AnswerMemory memory(1);
  const std::string good = GoodResponse().SerializeAsString();
  for (const std::string& text :
       {good.substr(0, good.size() - 1), good + "\x0a", good + "\x38", std::string("\x20\1")}) {
    const grpc::Slice slice(text);
    grpc::ByteBuffer bytes(&slice, 1), streamed(&slice, 1);
    AnswerColumns requested;
    requested.outcomes = memory.columns().outcomes;
    EXPECT_EQ(ReadAnswer(bytes, {}, 1, requested).status().code(), absl::StatusCode::kInternal);
    EXPECT_EQ(ReadStreamedAnswer(streamed, {}, 1, requested).status().code(), absl::StatusCode::kInternal);
  }
  grpc::ByteBuffer nothing;
  EXPECT_FALSE(ReadStreamedAnswer(nothing, {}, 1, memory.columns()).ok());
}

TEST(AnswerReader, ReturnsOtherFieldsAndSkipsUnknownOnes) {
  v1::QueryColumnsResponse response = GoodResponse();
  response.mutable_table()->set_digest("cafe");
  // Fields of a later version, in the message itself and in a nested message of columns.
  response.GetReflection()->MutableUnknownFields(&response)->AddLengthDelimited(100, "later");
  v1::SeaSurfaceColumns& columns = *response.mutable_sea_surface();
  columns.GetReflection()->MutableUnknownFields(&columns)->AddVarint(100, 7777);
  AnswerMemory memory(1);
  AnswerColumns requested;
  requested.values[Index(Quantity::kThu)] = memory.columns().values[Index(Quantity::kThu)];
  *requested.values[Index(Quantity::kThu)] = 1;
  const grpc::Slice slice(response.SerializeAsString());
  grpc::ByteBuffer bytes(&slice, 1);
  const auto head = ReadAnswer(bytes, {}, 1, requested);
  EXPECT_EQ(head->table().digest(), "cafe");
  EXPECT_EQ(head->outcomes(), "");
  EXPECT_EQ(*requested.values[Index(Quantity::kThu)], 0);
}

}  // namespace
}  // namespace albtpu::client
