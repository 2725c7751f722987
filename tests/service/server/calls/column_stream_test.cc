#include <gmock/gmock.h>
#include <grpcpp/generic/generic_stub.h>

#include <chrono>
#include <future>
#include <latch>
#include <optional>

#include "service/client/wire.h"
#include "service/server/ground/limits.h"
#include "tests/service/known_seas.h"
#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

using ::testing::HasSubstr;

// Holds all threads of the workers, as long requests of other callers would.
class BusyWorkers {
 public:
  BusyWorkers() {
    for (int i = 0; i < kThreads; ++i) {
      arena_.enqueue([this] {
        begun_.count_down();
        free_.wait();
        ended_.count_down();
      });
    }
    begun_.wait();
  }
  ~BusyWorkers() {
    free_.count_down();
    ended_.wait();
  }

 private:
  const int kThreads = tbb::info::default_concurrency();
  tbb::task_arena arena_{kThreads, 0};
  std::latch begun_{kThreads}, free_{1}, ended_{kThreads};
};

class StreamColumns : public ServedTables {
 protected:
  using Stream = grpc::ClientReaderWriter<v1::StreamColumnsRequest, v1::StreamColumnsResponse>;

  static v1::StreamColumnsRequest Request(const v1::PulseColumns& pulses) {
    v1::StreamColumnsRequest request;
    *request.mutable_query()->mutable_pulses() = pulses;
    return request;
  }

  // Requests of equal length differ by their depth.
  static v1::StreamColumnsRequest Request(std::size_t count, float depth) {
    v1::PulseColumns pulses = WireColumns(count);
    pulses.set_depth(Column({depth}));
    return Request(pulses);
  }

  std::unique_ptr<Stream> Open() {
    context_.set_wait_for_ready(true);
    return stub_->StreamColumns(&context_);
  }

  void ExpectAnswerOf(const v1::StreamColumnsRequest& request, const v1::StreamColumnsResponse& response) {
    EXPECT_EQ(response.answer().SerializeAsString(), Ask(request.query()).SerializeAsString());
  }

  grpc::ClientContext context_;
};

TEST_F(StreamColumns, AnswersEachRequestInOrderLikeASeparateCall) {
  const auto stream = Open();
  std::vector<v1::StreamColumnsRequest> requests;
  for (int i = 0; i < 12; ++i) {  // Short and long requests are handled on different threads.
    requests.push_back(Request(i % 3 == 0 ? 5 : 20000, static_cast<float>(i)));
    requests.back().mutable_query()->mutable_options()->set_table(i % 2 == 0 ? "survey" : "twice/1");
    requests.back().mutable_query()->mutable_options()->set_standard_errors(i % 4 == 0);
    if (i % 4 != 1) continue;
    requests.back().mutable_query()->clear_options();
    *requests.back().mutable_query()->mutable_sea() = client::ToWire(testing::WindSea(4 + i % 3));
  }
  auto written = std::async(std::launch::async, [&] {
    for (const v1::StreamColumnsRequest& request : requests) stream->Write(request);
    stream->WritesDone();
  });
  v1::StreamColumnsResponse response;
  for (const v1::StreamColumnsRequest& request : requests) {
    ASSERT_TRUE(stream->Read(&response));
    ExpectAnswerOf(request, response);
  }
  EXPECT_FALSE(stream->Read(&response));
  EXPECT_TRUE(stream->Finish().ok());
}

TEST_F(StreamColumns, MayEndWithoutARequest) {
  const auto stream = Open();
  stream->WritesDone();
  EXPECT_TRUE(stream->Finish().ok());
}

TEST_F(StreamColumns, ReadsNoRequestsWhileItsAnswersAreNotRead) {
  constexpr int kMany = 200;  // 200 answers have 300 MB, more than any window of HTTP/2 or TCP.
  const v1::StreamColumnsRequest request = [] {
    v1::StreamColumnsRequest r = Request(kMaxPulses, 3);
    for (v1::Quantity q : {v1::QUANTITY_THU, v1::QUANTITY_TVU, v1::QUANTITY_BIAS_VERTICAL})
      r.mutable_query()->add_quantities(q);
    return r;
  }();
  grpc::CompletionQueue events;
  const auto stream = stub_->AsyncStreamColumns(&context_, &events, nullptr);
  void* tag;
  bool ok;
  ASSERT_TRUE(events.Next(&tag, &ok) && ok);
  int written = 0;
  for (; written < kMany; ++written) {
    stream->Write(request, nullptr);
    // A write that takes longer waits for the server, which waits for a reader. On a very slow machine the test ends
    // the loop too early, which proves less but does not fail.
    const auto patience = std::chrono::system_clock::now() + std::chrono::seconds(2);
    if (events.AsyncNext(&tag, &ok, patience) == grpc::CompletionQueue::TIMEOUT) break;
    ASSERT_TRUE(ok);
  }
  EXPECT_LT(written, kMany / 4);

  // Nothing is lost: every request is answered once answers are read. The pending write finishes meanwhile.
  v1::StreamColumnsResponse response;
  for (int read = 0; read <= written;) {
    stream->Read(&response, &response);
    do ASSERT_TRUE(events.Next(&tag, &ok) && ok);
    while (tag != &response);
    ++read;
    EXPECT_EQ(response.answer().pulse_count(), static_cast<int>(kMaxPulses));
  }
  context_.TryCancel();
  grpc::Status status;
  stream->Finish(&status, nullptr);
  events.Shutdown();
  while (events.Next(&tag, &ok)) {
  }
}

TEST_F(StreamColumns, FreesEverythingWhenItsCallerCancels) {
  for (int i = 0; i < 10; ++i) {
    grpc::ClientContext context;
    const auto stream = stub_->StreamColumns(&context);
    stream->Write(Request(kMaxPulses, 1));
    stream->Write(Request(kMaxPulses, 2));
    v1::StreamColumnsResponse response;
    if (i % 2 == 0) {
      ASSERT_TRUE(stream->Read(&response));
    }
    context.TryCancel();
    EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::CANCELLED);
  }
  const auto begin = std::chrono::steady_clock::now();
  server_->Drain();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, kDrainTime / 2);
}

TEST_F(StreamColumns, IsIdleWhileItsCallerIsAndNotWhileTheServerIsBusy) {
  server_ = OrDie(Start("127.0.0.1:0", std::chrono::seconds(1)));
  channel_ = ChannelTo(server_->address());
  stub_ = v1::UncertaintyService::NewStub(channel_);
  std::optional<BusyWorkers> others(std::in_place);
  const auto waiting = Open();
  waiting->Write(Request(20000, 1));
  // The time after which the server ends streams passes at least three times.
  for (int i = 0; i < 3; ++i) {
    grpc::ClientContext context;
    EXPECT_EQ(stub_->StreamColumns(&context)->Finish().error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  }
  others.reset();
  v1::StreamColumnsResponse response;
  ASSERT_TRUE(waiting->Read(&response)) << waiting->Finish().error_message();
  EXPECT_EQ(response.answer().pulse_count(), 20000);
  EXPECT_EQ(waiting->Finish().error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);  // Now it is its caller who is idle.
}

TEST_F(StreamColumns, IsRefusedWhenTooManyAreOpen) {
  // A client holds back more streams than one connection allows, so several connections are needed.
  std::vector<std::unique_ptr<v1::UncertaintyService::Stub>> stubs;
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
  std::vector<std::unique_ptr<Stream>> streams;
  v1::StreamColumnsResponse response;
  for (int i = 0; i < kMaxBulkCalls; ++i) {
    if (i % kMaxCallsPerConnection == 0) {
      grpc::ChannelArguments arguments;
      arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
      arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
      stubs.push_back(v1::UncertaintyService::NewStub(
          grpc::CreateCustomChannel(server_->address(), grpc::InsecureChannelCredentials(), arguments)));
    }
    contexts.push_back(std::make_unique<grpc::ClientContext>());
    streams.push_back(stubs.back()->StreamColumns(contexts.back().get()));
    streams.back()->Write(Request(1, 1));
    ASSERT_TRUE(streams.back()->Read(&response));
  }
  const auto refused = Open();
  EXPECT_FALSE(refused->Read(&response));
  const grpc::Status status = refused->Finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_THAT(status.error_message(), HasSubstr("try again"));
  // Short requests do not count.
  EXPECT_TRUE(StatusOf(Request(1, 1).query()).ok());

  for (const auto& stream : streams) {
    stream->WritesDone();
    EXPECT_TRUE(stream->Finish().ok());
  }
  grpc::ClientContext context;
  const auto admitted = stub_->StreamColumns(&context);
  admitted->Write(Request(1, 1));
  EXPECT_TRUE(admitted->Read(&response));
  admitted->WritesDone();
  EXPECT_TRUE(admitted->Finish().ok());
}

TEST_F(StreamColumns, AndOtherMethodsRejectBytesThatAreNotAMessage) {
  for (const std::string method : {"QueryPulses", "QueryColumns", "StreamColumns", "GetTable", "ListTables"}) {
    grpc::GenericStub generic(channel_);
    grpc::ClientContext context;
    context.set_wait_for_ready(true);
    grpc::CompletionQueue events;
    const grpc::Slice slice("\x0a\x7fshort");  // A field of 127 bytes, of which there are 5.
    const auto call = generic.PrepareUnaryCall(&context, "/albtpu.v1.UncertaintyService/" + method,
                                               grpc::ByteBuffer(&slice, 1), &events);
    call->StartCall();
    grpc::ByteBuffer response;
    grpc::Status status;
    call->Finish(&response, &status, nullptr);
    void* tag;
    bool ok;
    ASSERT_TRUE(events.Next(&tag, &ok));
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << method;
    EXPECT_THAT(status.error_message(), HasSubstr("do not parse"));
  }
}

}  // namespace
}  // namespace albtpu::server
