#include "tests/bench/service/load.h"

#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <memory>

#include "albtpu/v1/uncertainty_service.grpc.pb.h"
#include "service/client/answer_reader.h"
#include "service/client/server_source.h"
#include "service/client/wire.h"
#include "tests/bench/service/raw_peer.h"

namespace albtpu::bench {
namespace {

// One caller, which queries repeatedly: calls `ask(place)` for the line in batches of `batch` pulses.
template <typename Ask>
void AskInTurn(const Load& load, Record& record, std::size_t batch, Ask ask) {
  std::vector<double> latencies;
  std::size_t place = 0;
  while (record.going_on() || latencies.size() * batch < load.line.size()) {  // Every pulse at least once.
    const Clock::time_point begin = Clock::now();
    ask(place);
    latencies.push_back(Seconds(Clock::now() - begin));
    place = (place + batch) % load.line.size();
  }
  record.Add(batch * latencies.size(), latencies);
}

void AskRawQuestion(const Load& load, Record& record, const Question& question) {
  RawConnection connection(load.address, question);
  AskInTurn(load, record, load.batch, [&](std::size_t place) {
    connection.Send(load.line, place, load.batch);
    connection.Receive(load.answers, place, load.batch);
  });
}

// Calls `ask(source)`, which gives a status, for the whole line.
template <typename Ask>
void AskSource(const Load& load, Record& record, Ask ask) {
  const auto source = client::OpenServer(load.address, "");
  Check(source.ok(), source.status().ToString());
  AskInTurn(load, record, load.line.size(), [&](std::size_t) {
    const absl::Status status = ask(**source);
    Check(status.ok(), status.ToString());
  });
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

// A channel with its own connection, comparable with a plain TCP connection. Channels to one server otherwise share
// one.
std::shared_ptr<grpc::Channel> ChannelTo(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  arguments.SetInt(GRPC_ARG_ENABLE_RETRIES, 0);  // No policy uses retries, and they cost an eighth of a short call.
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

// Makes unary calls of a method of the service, `in_flight` at a time, each for the next `batch` pulses. `request`
// writes a message; `read` reads the response.
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

double OwnProcessorTime() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// The fields utime and stime of proc(5), which are in clock ticks.
double ProcessorTimeOf(int pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string word;
  std::getline(file, word, ')');
  for (int field = 3; field < 14; ++field) file >> word;
  double user = 0, system = 0;
  file >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

void Record::Add(std::size_t pulses, const std::vector<double>& latencies) {
  const std::lock_guard lock(mutex_);
  pulses_ += pulses;
  latencies_.insert(latencies_.end(), latencies.begin(), latencies.end());
}

double Record::Latency(double quantile) {
  if (latencies_.empty()) return 0;
  const auto nth =
      latencies_.begin() + static_cast<std::ptrdiff_t>(quantile * static_cast<double>(latencies_.size() - 1));
  std::nth_element(latencies_.begin(), nth, latencies_.end());
  return *nth;
}

void AskRaw(const Load& load, Record& record) { AskRawQuestion(load, record, kSeaSurface); }
void AskRawBudget(const Load& load, Record& record) { AskRawQuestion(load, record, kBudget); }

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
  AskSource(load, record, [&](client::UncertaintySource& source) {
    return source.Answer({}, load.line.pulses(0, load.line.size()), load.answers.columns());
  });
}

void AskBudget(const Load& load, Record& record) {
  const BudgetPulses pulses = BudgetPulsesOf(load.line.wind_speed(), load.line.columns(0, load.line.size()));
  AskSource(load, record, [&](client::UncertaintySource& source) {
    return source.AnswerBudget(OptionsOfBudget(), pulses, load.answers.budget());
  });
}

void AskRawSingle(const Load& load, Record& record) {
  RawConnection connection(load.address, kSeaSurface);
  std::vector<Clock::time_point> begin(load.in_flight);
  std::size_t sent = 0;
  const auto send = [&] {
    begin[sent % begin.size()] = Clock::now();
    connection.Send(load.line, sent++ % load.line.size(), 1);
  };
  while (sent < begin.size()) send();
  std::vector<double> latencies;
  while (latencies.size() < sent) {
    connection.Receive(load.answers, latencies.size() % load.line.size(), 1);
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
