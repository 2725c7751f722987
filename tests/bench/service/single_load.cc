#include <grpcpp/generic/generic_stub.h>

#include <vector>

#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/client/answer_reader.h"
#include "service/client/wire.h"
#include "tests/bench/service/load.h"
#include "tests/bench/service/raw_peer.h"

namespace albtpu::bench {
namespace {

// One message for each pulse of the line.
std::vector<grpc::ByteBuffer> Requests(const Load& load) {
  v1::StreamColumnsRequest wanted;
  client::ToWire({}, load.answers.columns(), *wanted.mutable_query());
  std::vector<grpc::ByteBuffer> requests;
  for (std::size_t i = 0; i < load.line.size(); ++i) {
    ColumnMessage message;
    message.Add(wanted.query());
    client::AddPulses(load.line.pulses(i, 1), message);
    message.Nest(v1::StreamColumnsRequest::kQueryFieldNumber, 0);
    requests.push_back(message.Finish());
  }
  return requests;
}

}  // namespace

void AskRawSingle(const Load& load, Record& record) {
  RawConnection connection(load.address);
  std::vector<Clock::time_point> begin(load.in_flight);
  std::size_t sent = 0;
  const auto send = [&] {
    begin[sent % begin.size()] = Clock::now();
    connection.Send(load.line.pulses(sent++ % load.line.size(), 1));
  };
  while (sent < begin.size()) send();
  std::vector<double> latencies;
  while (latencies.size() < sent) {
    connection.Receive(1, load.answers.columns(latencies.size() % load.line.size()));
    latencies.push_back(Seconds(Clock::now() - begin[latencies.size() % begin.size()]));
    if (record.going_on() || sent < load.line.size()) send();
  }
  record.Add(latencies.size(), latencies);
}

void AskStreamSingle(const Load& load, Record& record) {
  enum Event : std::uintptr_t { kStarted = 1, kWritten, kClosed, kRead, kFinished };
  const auto tag = [](Event event) { return reinterpret_cast<void*>(static_cast<std::uintptr_t>(event)); };
  const std::vector<grpc::ByteBuffer> requests = Requests(load);
  grpc::GenericStub stub(ChannelTo(load.address));
  grpc::ClientContext context;
  grpc::CompletionQueue events;
  const auto stream = stub.PrepareCall(&context, "/albtpu.v1.UncertaintyService/StreamColumns", &events);
  stream->StartCall(tag(kStarted));
  std::vector<Clock::time_point> begin(load.in_flight);
  std::vector<double> latencies;
  std::size_t sent = 0;
  grpc::ByteBuffer response;
  grpc::Status status;
  bool writing = true, closed = false;
  for (void* event = nullptr; event != tag(kFinished);) {
    bool ok = false;
    events.Next(&event, &ok);
    if (event == tag(kRead) && !ok) stream->Finish(&status, tag(kFinished));
    if (event == tag(kRead) && ok) {
      const auto read =
          client::ReadStreamedAnswer(response, {}, 1, load.answers.columns(latencies.size() % requests.size()));
      Check(read.ok(), read.status().ToString());
      latencies.push_back(Seconds(Clock::now() - begin[latencies.size() % begin.size()]));
    }
    if (event == tag(kStarted) || (event == tag(kRead) && ok)) stream->Read(&response, tag(kRead));
    if (event == tag(kStarted) || event == tag(kWritten)) writing = false;
    if (writing || closed) continue;
    const bool more = record.going_on() || sent < requests.size();
    if (more && sent - latencies.size() < begin.size()) {
      begin[sent % begin.size()] = Clock::now();
      stream->Write(requests[sent++ % requests.size()], tag(kWritten));
      writing = true;
    } else if (!more) {
      stream->WritesDone(tag(kClosed));
      closed = true;
    }
  }
  Check(status.ok() && latencies.size() == sent, status.error_message());
  record.Add(latencies.size(), latencies);
}

}  // namespace albtpu::bench
