// service_bench serve-raw TABLE.h5
// service_bench PEER --address A --table TABLE.h5 --server-pid P [--batch N] [--callers N] [--in-flight N]
//               [--seconds S] [--beside N]
//
// Asks a server for a time, checks the answers against the table, and prints one JSON object: pulses and calls
// a second, the latency of calls (s), and the processor time of client and server for each pulse (s).
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "albtpu/v1/uncertainty_service.grpc.pb.h"
#include "service/client/answer_reader.h"
#include "service/client/server_source.h"
#include "service/client/wire.h"
#include "service/kept_memory.h"
#include "tables/table_io.h"
#include "tests/bench/flight_line.h"
#include "tests/bench/load_record.h"
#include "tests/bench/raw_peer.h"

namespace albtpu::bench {
namespace {

// Of a flight line: some megabytes, so that columns come from memory as those of a survey do.
constexpr std::size_t kBatches = 16;

struct Options {
  std::string peer, address, table;
  int server_pid = 0;
  std::size_t batch = 65536;
  int callers = 2, in_flight = 64, beside = 0;
  double seconds = 2;
};

// One caller: asks again and again. `ask(pulses, answers)` is called for the line in batches of `batch`.
template <typename Ask>
void AskInTurn(Record& record, const FlightLine& line, AnswerMemory& answers, std::size_t batch, Ask ask) {
  std::vector<double> latencies;
  std::size_t place = 0;
  while (record.going_on() || latencies.size() * batch < line.size()) {  // Each answer once at least.
    const Clock::time_point begin = Clock::now();
    ask(line.pulses(place, batch), answers.columns(place));
    latencies.push_back(Seconds(Clock::now() - begin));
    place = (place + batch) % line.size();
  }
  record.Add(batch * latencies.size(), latencies);
}

// A connection of its own, as a bare TCP connection is; channels to one server share one otherwise.
std::shared_ptr<grpc::Channel> ChannelTo(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

std::unique_ptr<v1::UncertaintyService::Stub> StubTo(const std::string& address) {
  return v1::UncertaintyService::NewStub(ChannelTo(address));
}

class Load {
 public:
  Load(const Options& options, const FlightLine& line, AnswerMemory& answers)
      : options_(options), line_(line), answers_(answers) {}

  void Run(const std::string& peer, Record& record) {
    if (peer == "raw") return Raw(record);
    if (peer == "raw-single") return RawSingle(record);
    if (peer == "columns") return Columns(record);
    if (peer == "stream") return Stream(record);
    if (peer == "rows") return Rows(record);
    if (peer == "single") return Single(record);
    if (peer == "stream-single") return StreamSingle(record);
    Check(false, "no peer '" + peer + "'");
  }

 private:
  void Raw(Record& record) {
    RawConnection connection(options_.address);
    AskInTurn(record, line_, answers_, options_.batch,
              [&](const PulseColumns& pulses, const AnswerColumns& answers) {
                connection.Send(pulses);
                connection.Receive(pulses.size, answers);
              });
  }

  void Columns(Record& record) {
    grpc::GenericStub stub(ChannelTo(options_.address));
    AskInTurn(record, line_, answers_, options_.batch,
              [&](const PulseColumns& pulses, const AnswerColumns& answers) {
                v1::QueryColumnsRequest wanted;
                client::ToWire({}, answers, wanted);
                ColumnMessage request;
                request.Add(wanted);
                client::AddPulses(pulses, request);
                grpc::ByteBuffer response = Ask(stub, request.Finish());
                const auto read = client::ReadAnswer(response, {}, pulses.size, answers);
                Check(read.ok(), read.status().ToString());
              });
  }

  static grpc::ByteBuffer Ask(grpc::GenericStub& stub, const grpc::ByteBuffer& request) {
    grpc::ClientContext context;
    grpc::CompletionQueue finished;
    const auto call =
        stub.PrepareUnaryCall(&context, "/albtpu.v1.UncertaintyService/QueryColumns", request, &finished);
    call->StartCall();
    grpc::ByteBuffer response;
    grpc::Status status;
    call->Finish(&response, &status, nullptr);
    void* tag;
    bool ok;
    finished.Next(&tag, &ok);
    Check(status.ok(), status.error_message());
    return response;
  }

  // All pulses of the line at a time, 65 536 a message.
  void Stream(Record& record) {
    auto source = client::OpenServer(options_.address, "");
    Check(source.ok(), source.status().ToString());
    AskInTurn(record, line_, answers_, line_.size(),
              [&](const PulseColumns& pulses, const AnswerColumns& answers) {
                const absl::Status status = (*source)->Answer({}, pulses, answers);
                Check(status.ok(), status.ToString());
              });
  }

  static v1::QueryPulsesRequest RowRequest(const PulseColumns& pulses) {
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
    return request;
  }

  void Rows(Record& record) {
    const auto stub = StubTo(options_.address);
    v1::QueryPulsesResponse response;
    AskInTurn(record, line_, answers_, options_.batch,
              [&](const PulseColumns& pulses, const AnswerColumns& answers) {
                grpc::ClientContext context;
                const grpc::Status status = stub->QueryPulses(&context, RowRequest(pulses), &response);
                Check(status.ok(), status.error_message());
                for (std::size_t i = 0; i < pulses.size; ++i) {
                  ReadRow(response.uncertainties(static_cast<int>(i)), i, answers);
                }
              });
  }

  static void ReadRow(const v1::PulseUncertainty& row, std::size_t i, const AnswerColumns& answers) {
    answers.outcomes[i] = static_cast<std::uint8_t>(row.outcome());
    answers.outcome_axes[i] = static_cast<std::uint8_t>(row.axis());
    answers.values[0][i] = row.sea_surface().refraction_along_wind();
    answers.values[1][i] = row.sea_surface().refraction_cross_wind();
    answers.values[2][i] = row.sea_surface().thu();
    answers.values[3][i] = row.sea_surface().tvu();
  }

  // One pulse a message, so many in flight on one connection.
  void RawSingle(Record& record) {
    const PulseColumns pulse = line_.pulses(0, 1);
    AnswerMemory answer(1);
    RawConnection connection(options_.address);
    std::vector<double> latencies;
    std::vector<Clock::time_point> begin(static_cast<std::size_t>(options_.in_flight));
    for (Clock::time_point& time : begin) {
      time = Clock::now();
      connection.Send(pulse);
    }
    for (std::size_t i = 0; record.going_on(); i = (i + 1) % begin.size()) {
      connection.Receive(1, answer.columns());
      latencies.push_back(Seconds(Clock::now() - begin[i]));
      begin[i] = Clock::now();
      connection.Send(pulse);
    }
    record.Add(latencies.size(), latencies);
  }

  struct SingleCall {
    grpc::ClientContext context;
    v1::QueryPulsesResponse response;
    grpc::Status status;
    Clock::time_point begin;
    std::unique_ptr<grpc::ClientAsyncResponseReader<v1::QueryPulsesResponse>> reader;
  };

  // One pulse a call, so many in flight on one connection.
  void Single(Record& record) {
    const auto stub = StubTo(options_.address);
    const v1::QueryPulsesRequest request = RowRequest(line_.pulses(0, 1));
    grpc::CompletionQueue finished;
    const auto start = [&] {
      auto* call = new SingleCall;
      call->begin = Clock::now();
      call->reader = stub->AsyncQueryPulses(&call->context, request, &finished);
      call->reader->Finish(&call->response, &call->status, call);
    };
    for (int i = 0; i < options_.in_flight; ++i) start();
    std::vector<double> latencies;
    for (int under_way = options_.in_flight; under_way > 0;) {
      void* tag;
      bool ok;
      finished.Next(&tag, &ok);
      const std::unique_ptr<SingleCall> call(static_cast<SingleCall*>(tag));
      Check(call->status.ok(), call->status.error_message());
      latencies.push_back(Seconds(Clock::now() - call->begin));
      if (record.going_on()) {
        start();
      } else {
        --under_way;
      }
    }
    record.Add(latencies.size(), latencies);
  }

  // One pulse a message of one stream, so many in flight.
  void StreamSingle(Record& record) {
    enum Event : std::uintptr_t { kStarted = 1, kWritten, kClosed, kRead, kFinished };
    const auto tag = [](Event event) { return reinterpret_cast<void*>(static_cast<std::uintptr_t>(event)); };
    const PulseColumns pulse = line_.pulses(0, 1);
    AnswerMemory answer(1);
    v1::StreamColumnsRequest wanted;
    client::ToWire({}, answer.columns(), *wanted.mutable_query());
    ColumnMessage message;
    message.Add(wanted.query());
    client::AddPulses(pulse, message);
    message.Nest(v1::StreamColumnsRequest::kQueryFieldNumber, 0);
    const grpc::ByteBuffer request = message.Finish();

    grpc::GenericStub stub(ChannelTo(options_.address));
    grpc::ClientContext context;
    grpc::CompletionQueue events;
    const auto stream = stub.PrepareCall(&context, "/albtpu.v1.UncertaintyService/StreamColumns", &events);
    stream->StartCall(tag(kStarted));
    std::vector<Clock::time_point> begin(static_cast<std::size_t>(options_.in_flight));
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
        const auto read = client::ReadStreamedAnswer(response, {}, 1, answer.columns());
        Check(read.ok(), read.status().ToString());
        latencies.push_back(Seconds(Clock::now() - begin[latencies.size() % begin.size()]));
      }
      if (event == tag(kStarted) || (event == tag(kRead) && ok)) stream->Read(&response, tag(kRead));
      if (event == tag(kStarted) || event == tag(kWritten)) writing = false;
      if (writing || closed) continue;
      if (record.going_on() && sent - latencies.size() < begin.size()) {
        begin[sent++ % begin.size()] = Clock::now();
        stream->Write(request, tag(kWritten));
        writing = true;
      } else if (!record.going_on()) {
        stream->WritesDone(tag(kClosed));
        closed = true;
      }
    }
    Check(status.ok() && latencies.size() == sent, status.error_message());
    record.Add(latencies.size(), latencies);
  }

  const Options& options_;
  const FlightLine& line_;
  AnswerMemory& answers_;
};

int Ask(const Options& options, const ColumnInterpolator& table) {
  const bool single = options.peer.ends_with("single");
  const FlightLine line(kBatches * options.batch);
  const int callers = single ? 1 : options.callers;
  std::vector<AnswerMemory> answers(static_cast<std::size_t>(callers + options.beside),
                                    AnswerMemory(line.size()));
  const double client_before = OwnProcessorTime(), server_before = ProcessorTimeOf(options.server_pid);
  const Clock::time_point begin = Clock::now();
  Record record(options.seconds), bulk(options.seconds);
  std::vector<std::thread> threads;
  for (int i = 0; i < callers + options.beside; ++i) {
    const bool is_counted = i < callers;
    threads.emplace_back([&, i, is_counted] {
      Load(options, line, answers[static_cast<std::size_t>(i)])
          .Run(is_counted ? options.peer : "stream", is_counted ? record : bulk);
    });
  }
  for (std::thread& thread : threads) thread.join();
  const double elapsed = Seconds(Clock::now() - begin);
  const auto pulses = static_cast<double>(record.pulses());
  const nlohmann::json report = {
      {"peer", options.peer},
      {"pulses_per_second", pulses / elapsed},
      {"calls_per_second", static_cast<double>(record.calls()) / elapsed},
      {"latency", {{"p50", record.Latency(0.5)}, {"p99", record.Latency(0.99)}, {"max", record.Latency(1)}}},
      {"client_cpu_per_pulse", (OwnProcessorTime() - client_before) / pulses},
      {"server_cpu_per_pulse", (ProcessorTimeOf(options.server_pid) - server_before) / pulses},
      {"bulk_pulses_per_second", static_cast<double>(bulk.pulses()) / elapsed}};
  AnswerMemory expected(line.size());
  table.Answer({}, line.pulses(), 0, line.size(), expected.columns());
  for (int i = single ? callers : 0; i < callers + options.beside; ++i) {
    answers[static_cast<std::size_t>(i)].ExpectSame(expected);
  }
  std::cout << report.dump() << "\n";
  return 0;
}

int Main(int argc, char** argv) {
  Options options;
  CLI::App app("Asks a server of uncertainties as fast as it answers.", "service_bench");
  app.add_option("peer", options.peer,
                 "serve-raw, raw, raw-single, columns, stream, rows, single or stream-single")
      ->required();
  app.add_option("--table", options.table, "The table that answers")->required();
  app.add_option("--address", options.address, "HOST:PORT of albtpu-serve, PORT of serve-raw");
  app.add_option("--server-pid", options.server_pid, "Whose processor time to count");
  app.add_option("--batch", options.batch, "Pulses of one message");
  app.add_option("--callers", options.callers, "Threads that ask");
  app.add_option("--in-flight", options.in_flight, "Single pulses at a time");
  app.add_option("--beside", options.beside, "Further threads that stream, not counted");
  app.add_option("--seconds", options.seconds, "For how long");
  CLI11_PARSE(app, argc, argv);
  const auto table = ReadTable(options.table);
  Check(table.ok(), table.status().ToString());
  const ColumnInterpolator interpolator(*table);
  if (options.peer != "serve-raw") return Ask(options, interpolator);
  ServeRaw(interpolator);
  return 0;
}

}  // namespace
}  // namespace albtpu::bench

int main(int argc, char** argv) {
  albtpu::KeepFreedMemory();
  return albtpu::bench::Main(argc, argv);
}
