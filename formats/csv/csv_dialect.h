// How a CSV file separates its cells and writes its numbers. Spreadsheets of countries with a decimal comma write
//
//     depth;wind_speed                depth,wind_speed                  depth,wind_speed
//     4,5;6                and not    4.5,6                  , or       "4,5",6
//
// The header, whose names are no numbers, shows the separator: comma, semicolon or tab. The numbers below show the
// decimal mark. All readers of CSV take both from here.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace albtpu::formats {

struct CsvDialect {
  char separator = ',';
  char decimal = '.';  // Or a comma.

  bool is_usual() const { return separator == ',' && decimal == '.'; }
  // "columns separated by semicolons, decimal commas"
  std::string Text() const;
};

// The first record of a text, or the whole text if it does not end, whatever separates its cells.
std::string_view FirstRecordOf(std::string_view text);

// The separator of the first record of a file: of commas, semicolons and tabs outside of quotes, the one of which there
// are most; a comma if there is none. Fails where two are equally frequent. `name` is the file, for messages.
absl::StatusOr<char> SeparatorOf(std::string_view name, std::string_view header);

// The decimal mark of the numbers in `text`, complete records: a comma if cells such as 4,5 have one; nullopt where no
// number has a fraction. Fails where both marks occur, because 4,500 may be more than four thousand then; where commas
// separate cells, it is a point then. `line` is the
// first one of the text.
absl::StatusOr<std::optional<char>> DecimalOf(std::string_view name, std::string_view text, std::size_t line,
                                              char separator);

// The value of a cell with a decimal point, for parsing; `buffer` may hold it. nullopt if it has the other mark.
std::optional<std::string_view> WithPoint(std::string_view cell, const CsvDialect& dialect, std::string& buffer);

// Writes the number that `text` has from `begin` on, with a decimal point, in the dialect: quoted if its mark is the
// separator.
void ToDialect(const CsvDialect& dialect, std::size_t begin, std::string& text);

}  // namespace albtpu::formats
