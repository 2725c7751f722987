#include <grpcpp/generic/generic_stub.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "albtpu/v1/uncertainty_service.grpc.pb.h"
#include "service/client/answer_reader.h"
#include "service/client/server_source.h"
#include "service/client/wire.h"
#include "tests/bench/service/load.h"
#include "tests/bench/service/raw_peer.h"

namespace albtpu::bench {
namespace {

// One caller, which queries repeatedly: calls `ask(pulses, answers)` for the line in batches of `batch` pulses.
template <typename Ask>
void AskInTurn(Record& record, const FlightLine& line, AnswerMemory& answers, std::size_t batch, Ask ask) {
  std::vector<double> latencies;
  std::size_t place = 0;
  while (record.going_on() || latencies.size() * batch < line.size()) {  // Every pulse at least once.
    const Clock::time_point begin = Clock::now();
    ask(line.pulses(place, batch), answers.columns(place));
    latencies.push_back(Seconds(Clock::now() - begin));
    place = (place + batch) % line.size();
  }
  record.Add(batch * latencies.size(), latencies);
}

struct UnaryCall {
  grpc::ClientContext context;
  grpc::ByteBuffer response;
  grpc::Status status;
  Clock::time_point begin;
  std::size_t place;
  std::unique_ptr<grpc::GenericClientAsyncResponseReader> reader;
};

grpc::ByteBuffer RowRequest(const PulseColumns& pulses) {
  v1::QueryPulsesRequest request;
  for (std::size_t i = 0; i < pulses.size; ++i) {
    const Pulse pulse = PulseAt(pulses, i);
    v1::Pulse& row = *request.add_pulses();
    row.set_wind_speed(pulse.wind_speed);
    row.set_incidence(pulse.incidence);
    row.set_azimuth(*pulse.azimuth);
    row.set_footprint(pulse.footprint);
    row.set_depth(pulse.depth);
  }
  ColumnMessage message;
  message.Add(request);
  return message.Finish();
}

void ReadRow(const v1::PulseUncertainty& row, std::size_t i, const AnswerColumns& answers) {
  answers.outcomes[i] = static_cast<std::uint8_t>(row.outcome());
  answers.outcome_axes[i] = static_cast<std::uint8_t>(row.axis());
  answers.values[0][i] = row.sea_surface().refraction_along_wind();
  answers.values[1][i] = row.sea_surface().refraction_cross_wind();
  answers.values[2][i] = row.sea_surface().thu();
  answers.values[3][i] = row.sea_surface().tvu();
}

}  // namespace

std::shared_ptr<grpc::Channel> ChannelTo(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  arguments.SetInt(GRPC_ARG_ENABLE_RETRIES,
                   0);  // No policy uses retries, and they cost an eighth of a short call.
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

void AskRaw(const Load& load, Record& record) {
  RawConnection connection(load.address);
  AskInTurn(record, load.line, load.answers, load.batch, [&](const PulseColumns& pulses, const AnswerColumns& answers) {
    connection.Send(pulses);
    connection.Receive(pulses.size, answers);
  });
}

void AskInCalls(const Load& load, Record& record, const std::string& method,
                const std::function<grpc::ByteBuffer(const PulseColumns&)>& request,
                const std::function<void(grpc::ByteBuffer& response, const AnswerColumns&)>& read) {
  std::vector<std::unique_ptr<grpc::GenericStub>> stubs;
  while (stubs.size() < load.connections) stubs.push_back(std::make_unique<grpc::GenericStub>(ChannelTo(load.address)));
  grpc::CompletionQueue finished;
  std::size_t started = 0;
  const auto start = [&] {
    auto* call = new UnaryCall;
    call->begin = Clock::now();
    call->place = started * load.batch % load.line.size();
    grpc::GenericStub& stub = *stubs[started++ % stubs.size()];
    call->reader = stub.PrepareUnaryCall(&call->context, "/albtpu.v1.UncertaintyService/" + method,
                                         request(load.line.pulses(call->place, load.batch)), &finished);
    call->reader->StartCall();
    call->reader->Finish(&call->response, &call->status, call);
  };
  while (started < load.in_flight) start();
  std::vector<double> latencies;
  while (latencies.size() < started) {
    void* tag;
    bool ok;
    finished.Next(&tag, &ok);
    const std::unique_ptr<UnaryCall> call(static_cast<UnaryCall*>(tag));
    Check(call->status.ok(), call->status.error_message());
    if (record.going_on() || started * load.batch < load.line.size()) start();
    read(call->response, load.answers.columns(call->place));
    latencies.push_back(Seconds(Clock::now() - call->begin));
  }
  record.Add(load.batch * latencies.size(), latencies);
}

void AskColumns(const Load& load, Record& record) {
  v1::QueryColumnsRequest wanted;
  client::ToWire({}, load.answers.columns(), wanted);
  const auto request = [&](const PulseColumns& pulses) {
    ColumnMessage message;
    message.Add(wanted);
    client::AddPulses(pulses, message);
    return message.Finish();
  };
  AskInCalls(load, record, "QueryColumns", request, [&](grpc::ByteBuffer& response, const AnswerColumns& answers) {
    const auto read = client::ReadAnswer(response, {}, load.batch, answers);
    Check(read.ok(), read.status().ToString());
  });
}

void AskRows(const Load& load, Record& record) {
  AskInCalls(load, record, "QueryPulses", RowRequest, [&](grpc::ByteBuffer& response, const AnswerColumns& answers) {
    v1::QueryPulsesResponse rows;
    const grpc::Status status = grpc::SerializationTraits<v1::QueryPulsesResponse>::Deserialize(&response, &rows);
    Check(status.ok(), status.error_message());
    for (int i = 0; i < rows.uncertainties_size(); ++i)
      ReadRow(rows.uncertainties(i), static_cast<std::size_t>(i), answers);
  });
}

void AskStream(const Load& load, Record& record) {
  auto source = client::OpenServer(load.address, "");
  Check(source.ok(), source.status().ToString());
  AskInTurn(record, load.line, load.answers, load.line.size(),
            [&](const PulseColumns& pulses, const AnswerColumns& answers) {
              const absl::Status status = (*source)->Answer({}, pulses, answers);
              Check(status.ok(), status.ToString());
            });
}

}  // namespace albtpu::bench
