#include "annotate/csv/csv_annotation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "annotate/answers/answer_counts.h"
#include "formats/csv/csv_reader.h"
#include "formats/files/ordered_pipeline.h"
#include "formats/text/text.h"
#include "status/status_macros.h"

namespace albtpu::annotate {
namespace {

// Memory that is reused from block to block.
struct Chunk {
  explicit Chunk(AnswerStyle style) : summary(style) {}

  // The sizes of a record in the block. Blank records have no pulse.
  struct Row {
    std::uint32_t text_size, ending_size;
    bool blank, has_azimuth;
  };

  formats::CsvBlock block;  // Input.
  std::string annotated;    // Output.
  std::uint64_t bytes_read = 0;
  std::uint64_t pulse_count = 0;
  UncertaintySummary summary;

  std::vector<Row> rows;
  CsvPulseBatches pulses;
  struct Half {
    AnswerBatch answers;
    CsvAircraftBatch aircraft;  // Of totals; so is the next.
    TotalBatch totals;
  };
  std::array<Half, 2> halves;  // Of the pulses without and with an azimuth.
  TotalSummary totals;
};

// Annotates the records of a block.
class BlockWork {
 public:
  // `total` and `aircraft` are null without a total.
  BlockWork(const formats::CsvReader& reader, const CsvPulses& columns, AnswerStyle style, std::string default_ending,
            const AnswerSource& source, const CsvTotal* total, const CsvAircraft* aircraft)
      : total_(total),
        aircraft_(aircraft),
        name_(reader.name()),
        columns_(columns),
        style_(style),
        cells_(style),
        selection_(cells_.selection()),
        default_ending_(std::move(default_ending)),
        source_(source) {
    UncertaintySummary::Select(selection_);
    if (total_ != nullptr) SelectForTotals(selection_);
  }

  absl::Status operator()(Chunk& chunk) const {
    RETURN_IF_ERROR(Decode(chunk));
    chunk.summary = UncertaintySummary(style_);
    chunk.totals = {};
    for (const bool has_azimuth : {true, false}) RETURN_IF_ERROR(Answer(chunk, has_azimuth));
    Encode(chunk);
    return absl::OkStatus();
  }

 private:
  absl::Status Decode(Chunk& chunk) const {
    formats::CsvRecords records(name_, chunk.block);
    formats::CsvRecord record;
    columns_.Clear(chunk.pulses);
    if (aircraft_ != nullptr)
      for (Chunk::Half& half : chunk.halves) aircraft_->Clear(half.aircraft);
    chunk.rows.clear();
    while (true) {
      ASSIGN_OR_RETURN(const bool more, records.Next(record));
      if (!more) break;
      bool has_azimuth = false;
      if (!record.blank()) {
        ASSIGN_OR_RETURN(has_azimuth, columns_.Append(record, chunk.pulses));
        if (aircraft_ != nullptr) RETURN_IF_ERROR(aircraft_->Append(record, chunk.halves[has_azimuth].aircraft));
      }
      chunk.rows.push_back({static_cast<std::uint32_t>(record.text.size()),
                            static_cast<std::uint32_t>(record.line_ending.size()), record.blank(), has_azimuth});
    }
    chunk.pulse_count = chunk.pulses.with_azimuth.size + chunk.pulses.without_azimuth.size;
    return absl::OkStatus();
  }

  absl::Status Answer(Chunk& chunk, bool has_azimuth) const {
    const PulseBatch& pulses = chunk.pulses[has_azimuth];
    auto& [answers, aircraft, totals] = chunk.halves[has_azimuth];
    RETURN_IF_ERROR(AnswerPulses(source_, style_.query(), pulses, selection_, answers));
    if (total_ != nullptr) {
      RefuseInvalid(aircraft, pulses.size, answers);
      AddWater(total_->plan.water, pulses, answers, totals.water);
    }
    if (pulses.size == 0) return absl::OkStatus();
    chunk.summary.Add(pulses, answers);
    if (total_ == nullptr) return absl::OkStatus();
    if (!total_->wind_spectrum.empty()) {
      answers.sea_axes = aircraft.sea_axes;
      if (total_->plan.waves_unseen()) WaveHeightsOfWinds(pulses, total_->wind_spectrum, answers.wave_heights);
    }
    ForgetAxes(aircraft, answers);
    ComputeTotals(total_->plan, pulses, answers, aircraft.columns, totals);
    for (std::size_t i = 0; i < pulses.size; ++i) {
      if (!aircraft.undirected[i]) continue;
      for (const std::size_t entry : {0, 1, 3, 4, 5}) totals.covariance[entry][i] = NAN;
    }
    chunk.totals.Add(pulses, answers, totals);
    chunk.totals.Add(SampleSources(total_->plan, pulses, aircraft.columns, totals));
    return absl::OkStatus();
  }

  // Pulses whose numbers of the aircraft are not valid have no number, as in the answers of a service.
  static void RefuseInvalid(const CsvAircraftBatch& aircraft, std::size_t size, AnswerBatch& answers) {
    BudgetInputs inputs{.size = size};
    for (const BudgetInput input : kAircraftInputs) inputs[input] = aircraft.columns[input];
    std::vector<std::uint8_t> invalid(size);
    FindInvalid(inputs, invalid.data());
    for (std::size_t i = 0; i < size; ++i) {
      if (invalid[i] == 0 || !answers.interpolated(i)) continue;
      answers.outcomes[i] = static_cast<std::uint8_t>(static_cast<int>(Outcome::kInvalid) + 1);
      answers.outcome_axes[i] = 0;
      for (std::vector<float>& values : answers.values)
        if (!values.empty()) values[i] = NAN;
    }
  }

  // Where the direction of a beam is not known, the error of the sea is taken as the same in all directions.
  void ForgetAxes(const CsvAircraftBatch& aircraft, AnswerBatch& answers) const {
    const std::vector<bool>& undirected = aircraft.undirected;
    if (std::ranges::find(undirected, true) == undirected.end()) return;
    std::vector<float>& axes = answers.sea_axes;
    if (axes.empty()) axes.assign(1, total_->plan.sea_axis.value_or(NAN));
    if (axes.size() == 1) axes.assign(undirected.size(), float{axes[0]});
    for (std::size_t i = 0; i < undirected.size(); ++i)
      if (undirected[i]) axes[i] = NAN;
  }

  static void AppendNumber(const formats::CsvDialect& dialect, float value, std::string& to) {
    const std::size_t begin = to.size();
    formats::AppendFloat(value, to);
    formats::ToDialect(dialect, begin, to);
  }

  void AppendTotal(const formats::CsvDialect& dialect, const AnswerBatch& answers, const TotalBatch& totals,
                   std::size_t i, std::string& to) const {
    const auto number = [&](float value) {
      to += dialect.separator;
      if (std::isfinite(value)) AppendNumber(dialect, value, to);
    };
    number(totals.thu[i]);
    number(totals.tvu[i]);
    if (total_->details) {
      const auto part = [&](float value) { number(std::isfinite(totals.thu[i]) ? value : NAN); };
      for (const auto* column : {&totals.thu_air, &totals.tvu_air, &totals.thu_sea, &totals.tvu_sea})
        part((*column)[i]);
      if (total_->plan.water.has_share()) {
        part(totals.thu_water[i]);
        part(totals.tvu_water[i]);
      }
      if (total_->plan.has_extra())
        for (const float added : {totals.extra.thu, totals.extra.tvu}) part(added);
      for (const std::vector<float>& entry : totals.covariance) part(entry[i]);
    }
    number(answers[Quantity::kBiasAlongBeam][i]);
    number(answers[Quantity::kBiasVertical][i]);
    (to += dialect.separator) += OutcomeName(answers, i);
    if (!style_.s44_order.has_value()) return;
    to += dialect.separator;
    if (totals.best_orders[i] > 0) to += Name(kS44Orders[totals.best_orders[i] - 1]);
  }

  void Encode(Chunk& chunk) const {
    std::string_view rest = chunk.block.text;
    std::string& to = chunk.annotated;
    const formats::CsvDialect& dialect = chunk.block.dialect;
    to.clear();
    std::size_t with = 0, without = 0;
    for (const Chunk::Row& row : chunk.rows) {
      to.append(rest.substr(0, row.text_size));
      if (!row.blank) {
        const Chunk::Half& half = chunk.halves[row.has_azimuth];
        const std::size_t i = row.has_azimuth ? with++ : without++;
        if (total_ != nullptr) {
          AppendTotal(dialect, half.answers, half.totals, i, to);
        } else {
          cells_.Visit(
              half.answers, i,
              [&](float number) {
                to += dialect.separator;
                AppendNumber(dialect, number, to);
              },
              [&](std::string_view text) { (to += dialect.separator) += text; }, [&] { to += dialect.separator; });
        }
      }
      const std::string_view ending = rest.substr(row.text_size, row.ending_size);
      to.append(ending.empty() ? std::string_view(default_ending_) : ending);
      rest.remove_prefix(row.text_size + row.ending_size);
    }
  }

  const CsvTotal* total_;
  const CsvAircraft* aircraft_;
  std::string name_;
  const CsvPulses& columns_;
  AnswerStyle style_;
  AnswerCells cells_;
  AnswerSelection selection_;
  std::string default_ending_;
  AnswerSource source_;
};

std::string AnnotatedHeader(const formats::CsvRecord& header, const std::string& ending,
                            const std::vector<std::string>& names) {
  std::string text(header.text);
  for (const std::string& name : names) absl::StrAppend(&text, std::string(1, header.dialect.separator), name);
  return text + ending;
}

// Copies all records after the header from `reader` to the file of `annotated`, with their answers.
absl::Status AnnotateRecords(formats::CsvReader& reader, const BlockWork& work, AnswerStyle style,
                             FileProgress::File& progress, AnnotatedCsv& annotated) {
  std::uint64_t written_pulses = 0;
  return formats::RunOrderedPipeline([&] { return Chunk(style); },
                                     [&](Chunk& chunk) {
                                       absl::StatusOr<bool> more = reader.Read(chunk.block);
                                       chunk.bytes_read = reader.bytes_read();
                                       return more;
                                     },
                                     [&](Chunk& chunk) { return work(chunk); },
                                     [&](Chunk& chunk) {
                                       annotated.summary.Merge(chunk.summary);
                                       annotated.totals.Merge(chunk.totals);
                                       annotated.input_bytes = chunk.bytes_read;
                                       written_pulses += chunk.pulse_count;
                                       progress.Reach(chunk.bytes_read, written_pulses);
                                       return annotated.file.Write(chunk.annotated);
                                     });
}

}  // namespace

FixedInputs OfTotal(FixedInputs fixed, std::optional<double> divergence, const formats::CsvRecord& header) {
  const auto is_known = [&](PulseInput input) {
    if (fixed[input].has_value()) return true;
    for (std::size_t i = 0; i < header.cell_count(); ++i) {
      std::string name = header.Cell(i);
      absl::StripAsciiWhitespace(&name);
      if (name == Name(input)) return true;
    }
    return false;
  };
  if (divergence.has_value() && !is_known(PulseInput::kDivergence) && !is_known(PulseInput::kFootprint))
    fixed[PulseInput::kDivergence] = static_cast<float>(*divergence);
  if (!is_known(PulseInput::kDivergence) || is_known(PulseInput::kFootprint)) fixed[PulseInput::kAltitude].reset();
  if (!is_known(PulseInput::kWindFrom) && !fixed.any_sea) fixed[PulseInput::kBeamAzimuth].reset();
  return fixed;
}

std::vector<std::string> TotalCells(const CsvTotal& total, const AnswerStyle& style) {
  std::vector<std::string> names = {"total_thu", "total_tvu"};
  if (total.details) {
    names.insert(names.end(), {"thu_air", "tvu_air", "thu_sea", "tvu_sea"});
    if (total.plan.water.has_share()) names.insert(names.end(), {"thu_water", "tvu_water"});
    if (total.plan.has_extra()) names.insert(names.end(), {"thu_extra", "tvu_extra"});
    for (const std::string_view entry : kCovarianceNames)
      names.push_back(absl::StrCat("covariance_", std::string(entry)));
  }
  names.insert(names.end(), {"bias_along_beam", "bias_vertical", "outcome"});
  if (style.s44_order.has_value()) names.push_back("s44_order_met");
  return names;
}

absl::StatusOr<AnnotatedCsv> AnnotateCsv(const std::filesystem::path& input, const std::filesystem::path& output,
                                         Existing existing, const FixedInputs& fixed, AnswerStyle style,
                                         const AnswerSource& source, FileProgress& progress, const CsvTotal* total) {
  RETURN_IF_ERROR(formats::CheckNotTheSameFile(input, output));
  ASSIGN_OR_RETURN(formats::CsvReader reader, formats::CsvReader::Open(input));
  ASSIGN_OR_RETURN(const formats::CsvBlock header_block, reader.ReadHeader());
  formats::CsvRecord header;
  RETURN_IF_ERROR(formats::CsvRecords(reader.name(), header_block).Next(header).status());
  const std::vector<std::string> appended = total != nullptr ? TotalCells(*total, style) : AnswerCells(style).names();
  const FixedInputs of_pulses = total != nullptr ? OfTotal(fixed, total->plan.divergence, header) : fixed;
  const bool took_divergence =
      of_pulses[PulseInput::kDivergence].has_value() && !fixed[PulseInput::kDivergence].has_value();
  ASSIGN_OR_RETURN(const CsvPulses columns, CsvPulses::Bind(input.string(), header, of_pulses, appended));
  std::optional<CsvAircraft> aircraft;
  if (total != nullptr) {
    ASSIGN_OR_RETURN(aircraft, CsvAircraft::Bind(input.string(), header, fixed));
  }
  ASSIGN_OR_RETURN(OutputFile file, OutputFile::Create(output, existing));

  AnnotatedCsv annotated{.input_bytes = reader.bytes_read(),
                         .summary = UncertaintySummary(style),
                         .totals = {},
                         .took_divergence = took_divergence,
                         .dialect = {},
                         .file = std::move(file)};
  FileProgress::File file_progress(progress, input.filename().string());
  const std::string ending = header.line_ending.empty() ? "\n" : std::string(header.line_ending);
  absl::Status status = annotated.file.Write(AnnotatedHeader(header, ending, appended));
  const BlockWork work(reader, columns, style, ending, source, total, aircraft.has_value() ? &*aircraft : nullptr);
  if (status.ok()) status = AnnotateRecords(reader, work, style, file_progress, annotated);
  RETURN_IF_ERROR(reader.CheckUnchanged());
  if (!status.ok()) return status;
  annotated.dialect = reader.dialect();
  return annotated;
}

}  // namespace albtpu::annotate
