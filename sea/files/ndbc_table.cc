#include "sea/files/ndbc_table.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "sea/files/sea_csv.h"
#include "sea/files/text_lines.h"
#include "sea/sea_time.h"
#include "status/status_macros.h"

namespace albtpu {
NdbcDate NdbcDateColumns(std::span<const std::string_view> header) {
  if (header.size() < 4) return {};
  std::string_view year = header[0];
  if (year.starts_with('#')) year.remove_prefix(1);
  if ((year != "YY" && year != "YYYY") || header[1] != "MM" || header[2] != "DD" || header[3] != "hh") return {};
  return {.count = header.size() > 4 && header[4] == "mm" ? std::size_t{5} : std::size_t{4}};
}

std::optional<double> NdbcTime(std::span<const std::string_view> words, NdbcDate date) {
  if (words.size() < date.count) return std::nullopt;
  std::array<int, 5> parts{};
  for (std::size_t i = 0; i < date.count; ++i) {
    const auto part = ParseCount(words[i]);
    if (!part) return std::nullopt;
    parts[i] = *part;
  }
  const int year = words[0].size() == 2 ? 1900 + parts[0] : parts[0];
  return SecondsOf({.year = year, .month = parts[1], .day = parts[2], .hour = parts[3], .minute = parts[4]});
}

namespace {

using Frequencies = std::shared_ptr<const std::vector<double>>;

struct Quantity {
  NdbcQuantity quantity;
  const char* in_header;  // in real time
  const char* name;
  double largest;  // in the unit of the history
};

constexpr std::array kQuantities = {
    Quantity{NdbcQuantity::kEnergy, "spec_1", "spectral density", kMaxDensity},
    Quantity{NdbcQuantity::kFirstDirection, "alpha1_1", "alpha1", 360},
    Quantity{NdbcQuantity::kDirection, "alpha2_1", "alpha2", 360},
    Quantity{NdbcQuantity::kFirstSpread, "r1_1", "r1", 100},
    Quantity{NdbcQuantity::kSpread, "r2_1", "r2", 100},
};

const Quantity& Described(NdbcQuantity quantity) { return kQuantities[static_cast<std::size_t>(quantity)]; }

bool IsSpread(NdbcQuantity quantity) {
  return quantity == NdbcQuantity::kSpread || quantity == NdbcQuantity::kFirstSpread;
}

class NdbcReader {
 public:
  NdbcReader(std::string_view text, NdbcQuantity expected) : lines_(text), expected_(Described(expected)) {}

  absl::StatusOr<NdbcTable> Read() {
    const auto first = lines_.Next();
    if (!first) return lines_.CutError();
    RETURN_IF_ERROR(ReadHeader(*first));
    while (const auto line = lines_.Next()) {
      const std::vector<std::string_view> words = Words(*line);
      if (words.empty() || words.front().starts_with('#')) continue;
      RETURN_IF_ERROR(ReadRow(words));
    }
    if (lines_.cut()) return lines_.CutError();
    if (table_.rows.empty())
      return absl::InvalidArgumentError("it has a header and no record; get another copy of the file");
    if (!table_.real_time && expected_.quantity == NdbcQuantity::kEnergy && !has_decimals_)
      return absl::InvalidArgumentError(
          "its values are whole numbers (those of directions and spreads are); give the file of energy, with "
          "w before "
          "the year in its name");
    if (!table_.real_time && IsSpread(expected_.quantity) && largest_ > 0 && largest_ <= 1)
      return absl::InvalidArgumentError(absl::StrCat("its largest ", expected_.name, " is ", largest_,
                                                     " (the history has hundredths, up to 100); multiply ",
                                                     expected_.name, " by 100"));
    return std::move(table_);
  }

 private:
  absl::Status ReadHeader(std::string_view line) {
    const std::vector<std::string_view> words = Words(line);
    date_ = NdbcDateColumns(words);
    if (date_.count == 0)
      return lines_.Error("begins with ", Quoted(line),
                          " (expected the header of an NDBC file); get another copy of the file");
    table_.real_time = line.find("(freq_1)") != line.npos;
    if (!table_.real_time) return ReadFrequencies(words);
    for (const Quantity& quantity : kQuantities) {
      if (std::find(words.begin(), words.end(), quantity.in_header) == words.end()) continue;
      if (quantity.quantity == expected_.quantity) return absl::OkStatus();
      return lines_.Error("the file has ", quantity.name, " (expected ", expected_.name,
                          "); give the .data_spec file, with .swr2 and .swdir2 beside it");
    }
    return lines_.Error("names no quantity (expected ", expected_.in_header, "); get another copy of the file");
  }

  absl::Status ReadFrequencies(const std::vector<std::string_view>& words) {
    std::vector<double> frequencies;
    for (std::size_t i = date_.count; i < words.size(); ++i) RETURN_IF_ERROR(AddFrequency(words[i], frequencies));
    return Keep(frequencies);
  }

  absl::Status AddFrequency(std::string_view word, std::vector<double>& frequencies) {
    const auto frequency = ParseNumber(word);
    if (!frequency || !(*frequency >= kLowestFrequency && *frequency <= kHighestFrequency))
      return lines_.Error(Quoted(word), " is no frequency in Hz; get another copy of the file");
    if (!frequencies.empty() && *frequency <= frequencies.back())
      return lines_.Error("frequency ", *frequency, " Hz is not above the one before, ", frequencies.back(),
                          " Hz; get another copy of the file");
    frequencies.push_back(*frequency);
    return absl::OkStatus();
  }

  absl::Status Keep(const std::vector<double>& frequencies) {
    if (frequencies_ && *frequencies_ == frequencies) return absl::OkStatus();
    if (frequencies.size() < 2 || frequencies.size() > kMaxFrequencies)
      return lines_.Error("has ", frequencies.size(), " frequencies (expected 2 to ", kMaxFrequencies,
                          "); get another copy of the file");
    values_ += frequencies.size();
    frequencies_ = std::make_shared<const std::vector<double>>(frequencies);
    return absl::OkStatus();
  }

  absl::Status ReadRow(const std::vector<std::string_view>& words) {
    const auto time = NdbcTime(words, date_);
    if (!time) return lines_.Error("does not begin with a date and time; get another copy of the file");
    NdbcRow row{.time = *time, .frequencies = nullptr, .values = {}};
    RETURN_IF_ERROR(table_.real_time ? ReadPairs(words, row) : ReadValues(words, row));
    row.frequencies = frequencies_;
    values_ += row.values.size();
    if (values_ > kMaxSeaValues || table_.rows.size() >= kMaxSeaRecords)
      return lines_.Error("is one record too many (at most ", kMaxSeaRecords, " with ", kMaxSeaValues,
                          " values in all); split the file");
    table_.rows.push_back(std::move(row));
    return absl::OkStatus();
  }

  absl::Status ReadValues(const std::vector<std::string_view>& words, NdbcRow& row) {
    if (words.size() != date_.count + frequencies_->size())
      return lines_.Error("has ", words.size() - date_.count, " values (expected ", frequencies_->size(),
                          "); get another copy of the file");
    for (std::size_t i = date_.count; i < words.size(); ++i) {
      has_decimals_ = has_decimals_ || words[i].find('.') != words[i].npos;
      RETURN_IF_ERROR(AddValue(words[i], row));
    }
    return absl::OkStatus();
  }

  absl::Status ReadPairs(const std::vector<std::string_view>& words, NdbcRow& row) {
    const std::size_t first = date_.count + (expected_.quantity == NdbcQuantity::kEnergy ? 1 : 0);  // Sep_Freq
    if (words.size() < first || (words.size() - first) % 2 != 0)
      return lines_.Error("has a value without frequency; get another copy of the file");
    std::vector<double> frequencies;
    for (std::size_t i = first; i < words.size(); i += 2) {
      std::string_view frequency = words[i + 1];
      if (!frequency.starts_with('(') || !frequency.ends_with(')') || frequency.size() < 3)
        return lines_.Error(Quoted(frequency), " is no frequency in parentheses; get another copy of the file");
      frequency = frequency.substr(1, frequency.size() - 2);
      RETURN_IF_ERROR(AddFrequency(frequency, frequencies));
      RETURN_IF_ERROR(AddValue(words[i], row));
    }
    return Keep(frequencies);
  }

  absl::Status AddValue(std::string_view word, NdbcRow& row) {
    constexpr double kMissing = 999;
    const auto value = ParseNumber(word);
    if (!value) return lines_.Error(Quoted(word), " is no number; get another copy of the file");
    if (*value == kMissing) {
      row.values.push_back(std::numeric_limits<double>::quiet_NaN());
      return absl::OkStatus();
    }
    const double in_history = table_.real_time && IsSpread(expected_.quantity) ? 100 * *value : *value;
    if (in_history < 0 || in_history > expected_.largest)
      return lines_.Error(Quoted(word), " is no ", expected_.name, " (expected 0 to ",
                          IsSpread(expected_.quantity) && table_.real_time ? 1 : expected_.largest,
                          "); check which file has which quantity");
    largest_ = std::max(largest_, *value);
    row.values.push_back(IsSpread(expected_.quantity) && !table_.real_time ? *value / 100 : *value);
    return absl::OkStatus();
  }

  TextLines lines_;
  const Quantity& expected_;
  NdbcDate date_;
  Frequencies frequencies_;
  NdbcTable table_{};
  std::size_t values_ = 0;
  bool has_decimals_ = false;
  double largest_ = 0;  // value, in the unit of the file
};

}  // namespace

bool IsNdbcTable(std::string_view first_line) {
  const std::vector<std::string_view> words = Words(first_line);
  const NdbcDate date = NdbcDateColumns(words);
  if (date.count == 0 || words.size() <= date.count) return false;
  return first_line.find("(freq_1)") != first_line.npos || ParseNumber(words[date.count]).has_value();
}

absl::StatusOr<NdbcTable> ReadNdbcTable(std::string_view text, NdbcQuantity expected) {
  return NdbcReader(text, expected).Read();
}

}  // namespace albtpu
