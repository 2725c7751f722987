#include "sea/files/sea_file.h"

#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "sea/files/ndbc_bulk.h"
#include "sea/files/ndbc_spectra.h"
#include "sea/files/ndbc_table.h"
#include "sea/files/sea_csv.h"
#include "sea/files/swan_spectra.h"
#include "sea/files/text_lines.h"
#include "sea/files/ww3_points.h"
#include "status/status_macros.h"

namespace albtpu {
namespace {

absl::StatusOr<std::string> ReadText(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (error || !std::filesystem::exists(status)) return absl::NotFoundError("does not exist; check the path");
  if (!std::filesystem::is_regular_file(status))
    return absl::FailedPreconditionError("is not a regular file; give a file of the sea");
  std::ifstream file(path, std::ios::binary);
  std::string bytes;
  char piece[1 << 16];
  while (file.read(piece, sizeof piece) || file.gcount() > 0) {
    bytes.append(piece, static_cast<std::size_t>(file.gcount()));
    if (bytes.size() > kMaxSeaBytes)
      return absl::InvalidArgumentError(absl::StrCat("has more than ", kMaxSeaBytes, " bytes; split the file"));
  }
  if (!file.eof()) return absl::UnavailableError("cannot be read; check its permissions");
  if (IsGzip(bytes)) {
    ASSIGN_OR_RETURN(bytes, Inflated(bytes));
  }
  // The byte order mark with which some programs begin UTF-8 files.
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);
  return bytes;
}

// The first line that is not blank and no comment of a CSV file.
std::string_view FirstLine(std::string_view text) {
  TextLines lines(text);
  while (const auto line = lines.Next()) {
    const std::vector<std::string_view> words = Words(*line);
    if (words.empty() || words[0] == "#" || (words[0].starts_with('#') && !words[0].starts_with("#Y"))) continue;
    return *line;
  }
  return text.substr(0, text.find('\n'));
}

absl::Status OfAnotherKind(std::string_view text, std::string_view first_line) {
  if (text.empty()) return absl::InvalidArgumentError("is empty; get another copy of the file");
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    return absl::InvalidArgumentError("is UTF-16 text; save it as UTF-8");
  if (text.starts_with("CDF") || text.starts_with("\x89HDF"))
    return absl::InvalidArgumentError(
        "is a NetCDF file (this reads text); read it in Python with xarray and wavespectra");
  return absl::InvalidArgumentError(
      absl::StrCat("begins with ", Quoted(first_line),
                   " (expected a file of NDBC, WAVEWATCH III or SWAN, or CSV with the columns f,E or k,S); give the "
                   "spectra in one of these forms"));
}

// The file beside `path` that belongs to it, if it exists.
absl::StatusOr<std::optional<std::string>> ReadBeside(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  absl::StatusOr<std::string> text = ReadText(path);
  if (!text.ok())
    return absl::Status(text.status().code(),
                        absl::StrCat("beside it, ", path.filename().string(), ": ", text.status().message()));
  return std::optional(*std::move(text));
}

// Where the letter of the quantity stands in a name of NDBC's history: before the year; npos in other names.
std::size_t LetterBeforeYear(const std::string& name) {
  const auto is_digit = [&](std::size_t i) { return i < name.size() && name[i] >= '0' && name[i] <= '9'; };
  for (std::size_t i = name.size(); i-- > 0;)
    if (std::strchr("wdijk", name[i]) != nullptr && is_digit(i + 1) && is_digit(i + 2) && is_digit(i + 3) &&
        is_digit(i + 4))
      return i;
  return name.npos;
}

absl::StatusOr<SeaSeries> ReadNdbcFiles(const std::filesystem::path& path, std::string_view energy,
                                        std::string_view first_line) {
  std::filesystem::path spread = path, direction = path;
  if (first_line.find("(freq_1)") != first_line.npos) {
    spread.replace_extension(".swr2");
    direction.replace_extension(".swdir2");
  } else {
    std::string name = path.filename().string();
    const std::size_t letter = LetterBeforeYear(name);
    if (letter == name.npos) return ReadNdbcSpectra({.energy = energy});
    if (name[letter] != 'w') {
      name[letter] = 'w';
      return absl::InvalidArgumentError(
          absl::StrCat("has directions or spreads (its name says so); give the file of energy, ", name));
    }
    name[letter] = 'k';
    spread.replace_filename(name);
    name[letter] = 'i';
    direction.replace_filename(name);
  }
  ASSIGN_OR_RETURN(const auto r2, ReadBeside(spread));
  ASSIGN_OR_RETURN(const auto alpha2, ReadBeside(direction));
  return ReadNdbcSpectra({.energy = energy,
                          .spread = r2,
                          .direction = alpha2,
                          .spread_name = spread.filename().string(),
                          .direction_name = direction.filename().string()});
}

}  // namespace

absl::StatusOr<SeaSeries> ReadSeaText(std::string_view text, const SeaFileOptions& options) {
  const std::string_view first_line = FirstLine(text);
  if (IsNdbcTable(first_line)) return ReadNdbcSpectra({.energy = text});
  if (IsNdbcBulk(first_line)) return ReadNdbcBulk(text, options.anemometer_height);
  if (IsWw3Points(first_line)) return ReadWw3Points(text);
  if (IsSwanSpectra(first_line)) return ReadSwanSpectra(text);
  if (IsSeaCsv(first_line)) return ReadSeaCsv(text);
  return OfAnotherKind(text, first_line);
}

absl::StatusOr<SeaSeries> ReadSeaFile(const std::filesystem::path& path, const SeaFileOptions& options) {
  ASSIGN_OR_RETURN(const std::string text, ReadText(path));
  const std::string_view first_line = FirstLine(text);
  if (IsNdbcTable(first_line)) return ReadNdbcFiles(path, text, first_line);
  return ReadSeaText(text, options);
}

}  // namespace albtpu
