// The client queries servers that misbehave.
#include "service/client/column_exchange.h"

#include <gmock/gmock.h>
#include <grpcpp/grpcpp.h>

#include <atomic>
#include <functional>

#include "albtpu/v1/uncertainty_service.grpc.pb.h"
#include "service/client/server_source.h"
#include "tests/service/client/column_memory.h"

namespace albtpu::client {
namespace {

namespace v1 = albtpu::v1;
using ::testing::HasSubstr;

constexpr char kDigest[] = "cafe";

// A valid answer, in which the THU of each pulse is its depth, and the digest of the table is "cafe".
v1::StreamColumnsResponse GoodAnswer(const v1::StreamColumnsRequest& request) {
  const std::string& depth = request.query().pulses().depth();
  v1::StreamColumnsResponse response;
  v1::QueryColumnsResponse& answer = *response.mutable_answer();
  answer.mutable_table()->set_digest(kDigest);
  answer.set_coverage(v1::COVERAGE_TWO_SIGMA);
  answer.set_outcomes(std::string(depth.size() / 4, static_cast<char>(v1::OUTCOME_INTERPOLATED)));
  answer.set_outcome_axes(std::string(depth.size() / 4, '\0'));
  answer.mutable_sea_surface()->set_thu(depth);
  return response;
}

// Decides about the nth request (from 0) of all streams: OK sends the answer, which the function may modify; any other
// status ends the stream.
using Behaviour = std::function<grpc::Status(int n, v1::StreamColumnsResponse& response)>;

class Misbehaving : public v1::UncertaintyService::Service {
 public:
  explicit Misbehaving(Behaviour behaviour) : behaviour_(std::move(behaviour)) {
    grpc::ServerBuilder builder;
    int port = 0;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port);
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
    address_ = "127.0.0.1:" + std::to_string(port);
  }
  ~Misbehaving() override { server_->Shutdown(std::chrono::system_clock::now()); }

  grpc::Status GetTable(grpc::ServerContext*, const v1::GetTableRequest*, v1::GetTableResponse* response) override {
    if (++openings_ <= refused_openings) return {grpc::StatusCode::UNAVAILABLE, "going"};
    response->mutable_table()->mutable_reference()->set_name("quick");
    response->mutable_table()->mutable_reference()->set_digest(kDigest);
    return grpc::Status::OK;
  }

  grpc::Status StreamColumns(
      grpc::ServerContext*,
      grpc::ServerReaderWriter<v1::StreamColumnsResponse, v1::StreamColumnsRequest>* stream) override {
    v1::StreamColumnsRequest request;
    while (stream->Read(&request)) {
      v1::StreamColumnsResponse response = GoodAnswer(request);
      const grpc::Status status = behaviour_(requests_++, response);
      if (!status.ok()) return status.error_code() == grpc::StatusCode::OUT_OF_RANGE ? grpc::Status::OK : status;
      stream->Write(response);
      ++answers_;
    }
    return grpc::Status::OK;
  }

  const std::string& address() const { return address_; }
  int answers() const { return answers_; }

  int refused_openings = 0;  // The first calls of GetTable, this many, fail.

 private:
  const Behaviour behaviour_;
  std::atomic<int> openings_ = 0, requests_ = 0, answers_ = 0;
  std::unique_ptr<grpc::Server> server_;
  std::string address_;
};

const grpc::Status kGone(grpc::StatusCode::UNAVAILABLE, "power cut");
// Stands for a stream that ends with OK before everything is answered.
const grpc::Status kSilentEnd(grpc::StatusCode::OUT_OF_RANGE, "");

// A query of ten messages, in which each pulse has a different depth, its answers and its status.
struct TenMessages {
  explicit TenMessages(const Misbehaving& server, int retries = 3) {
    depth.resize(count);
    for (std::size_t i = 0; i < count; ++i) depth[i] = static_cast<float>(i);
    pulses.size = count;
    pulses.axis.fill(std::span(&one, 1));
    pulses.axis[Index(AxisId::kDepth)] = depth;
    AnswerColumns answers;
    thu.resize(count);
    answers.values[Index(Quantity::kThu)] = thu.data();
    const auto source = OpenServer(server.address(), "", {retries, std::chrono::milliseconds(1)});
    status = source.ok() ? (*source)->Answer({}, pulses, answers) : source.status();
  }

  static constexpr std::size_t count = 9 * kMostPulses + 1;
  const float one = 1;
  PulseColumns pulses;
  std::vector<float> depth, thu;
  absl::Status status;
};

TEST(ColumnExchange, OpensOnAnotherServerWhenTheFirstIsStopping) {
  Misbehaving server([](int, v1::StreamColumnsResponse&) { return grpc::Status::OK; });
  server.refused_openings = 3;
  EXPECT_TRUE(TenMessages(server).status.ok());
}

TEST(ColumnExchange, FailsToOpenWhenNoServerReturns) {
  Misbehaving server([](int, v1::StreamColumnsResponse&) { return grpc::Status::OK; });
  server.refused_openings = 4;
  EXPECT_THAT(std::string(TenMessages(server).status.message()), HasSubstr("going"));
}

TEST(ColumnExchange, AssignsAnswersToTheirPulses) {
  const Misbehaving server([](int, auto&) { return grpc::Status::OK; });
  const TenMessages query(server);
  EXPECT_TRUE(query.status.ok()) << query.status;
  EXPECT_TRUE(query.thu == query.depth);
  EXPECT_EQ(server.answers(), 10);
}

TEST(ColumnExchange, ContinuesAfterAnInterruptionAndTakesEachAnswerOnce) {
  for (const grpc::Status& end : {kGone, kSilentEnd}) {
    // One of every three requests is not answered.
    const Misbehaving server([&](int n, auto&) { return n % 3 == 2 ? end : grpc::Status::OK; });
    const TenMessages query(server);
    EXPECT_TRUE(query.status.ok()) << query.status;
    EXPECT_TRUE(query.thu == query.depth);
    EXPECT_EQ(server.answers(), 10);
  }
}

TEST(ColumnExchange, ResetsTheRetryCountAfterEachAnswer) {
  // One answer, then two failures: ten answers take twenty retries, but never more than two in a row.
  const Misbehaving server([](int n, auto&) { return n % 3 == 0 ? grpc::Status::OK : kGone; });
  const TenMessages query(server, 2);
  EXPECT_TRUE(query.status.ok()) << query.status;
  EXPECT_TRUE(query.thu == query.depth);
}

TEST(ColumnExchange, GivesUpAfterItsRetriesAndReportsItsProgress) {
  const Misbehaving server([](int n, auto&) { return n < 4 ? grpc::Status::OK : kGone; });
  const TenMessages query(server);
  EXPECT_EQ(query.status.code(), absl::StatusCode::kUnavailable);
  EXPECT_THAT(std::string(query.status.message()),
              HasSubstr("power cut (retried 3 times after 262144 of 589825 pulses)"));
}

TEST(ColumnExchange, DoesNotRetryPermanentErrors) {
  const Misbehaving server(
      [](int n, auto&) { return n < 4 ? grpc::Status::OK : grpc::Status(grpc::StatusCode::NOT_FOUND, "no"); });
  const TenMessages query(server);
  EXPECT_EQ(query.status.code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(server.answers(), 4);
}

TEST(ColumnExchange, NoticesThatTheTableChangedBetweenTwoAnswers) {
  const Misbehaving server([](int n, v1::StreamColumnsResponse& response) {
    if (n == 5) response.mutable_answer()->mutable_table()->set_digest("beef");
    return grpc::Status::OK;
  });
  const TenMessages query(server);
  EXPECT_EQ(query.status.code(), absl::StatusCode::kAborted);
  EXPECT_THAT(std::string(query.status.message()), HasSubstr("from digest cafe to beef"));
}

TEST(ColumnExchange, RejectsAnAnswerThatViolatesTheProtocol) {
  const Misbehaving server([](int n, v1::StreamColumnsResponse& response) {
    if (n == 5) response.mutable_answer()->mutable_sea_surface()->mutable_thu()->resize(7);
    return grpc::Status::OK;
  });
  const TenMessages query(server);
  EXPECT_EQ(query.status.code(), absl::StatusCode::kInternal);
  EXPECT_THAT(std::string(query.status.message()), HasSubstr("answered 7 bytes of thu for 65536 pulses"));
}

}  // namespace
}  // namespace albtpu::client
