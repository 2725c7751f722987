#include "formats/csv/csv_dialect.h"

#include <gmock/gmock.h>

#include "formats/csv/csv_reader.h"
#include "tests/temporary_folder.h"

namespace albtpu::formats {
namespace {

using albtpu::testing::TemporaryFolder;
using ::testing::HasSubstr;

CsvDialect Of(const std::string& text) { return DialectOf("in.csv", text).value(); }
std::string ErrorOfDialect(const std::string& text) {
  return std::string(DialectOf("in.csv", text).status().message());
}

TEST(CsvDialect, IsThatOfHeaderAndNumbers) {
  const struct {
    const char* text;
    char separator, decimal;
  } kFiles[] = {
      {"", ',', '.'},
      {"depth", ',', '.'},
      {"a,b\n1.5,2\n", ',', '.'},
      {"a,b\n1,2\n", ',', '.'},
      {"a;b\n1,5;2\n", ';', ','},
      {"a;b\n1.5;2\n", ';', '.'},
      {"a;b\n1;2\n", ';', '.'},
      {"a\tb\r\n-1,5e3\t2\r\n", '\t', ','},
      {"a\tb\n1.5\t2\n", '\t', '.'},
      {"a,b\n\"1,5\",2\n", ',', ','},
      {"place,b\n\"1,5\",2.5\n", ',', '.'},
      {"a,\tb\n1.5,\t2\n", ',', '.'},
      {"\"a,b\";\"c\"\n,5;2\n", ';', ','},
      {"depth;wind, at 10 m;x\n1;2;3,25\n", ';', ','},
      {"time;level\n2016-05-11T14:00:00.5Z;1,5\n", ';', ','},  // A date is no number.
      {"name;level\nA,B;1.5\n1,2,3;2.5\n", ';', '.'},          // Neither is a list.
  };
  for (const auto& file : kFiles) {
    SCOPED_TRACE(file.text);
    EXPECT_EQ(Of(file.text).separator, file.separator);
    EXPECT_EQ(Of(file.text).decimal, file.decimal);
  }
}

TEST(CsvDialect, IsNotGuessed) {
  EXPECT_THAT(ErrorOfDialect("a;b,c\n1;2,3\n"), HasSubstr("in.csv line 1: has as many commas as semicolons"));
  EXPECT_THAT(ErrorOfDialect("a;b\n1,5;2\n3;2.5\n"),
              HasSubstr("in.csv: has a number with a comma in line 2 and one with a point in line 3"));
  EXPECT_THAT(ErrorOfDialect("a;b\n1,500;2.5\n"), HasSubstr("in line 2 and one with a point in line 2"));
}

TEST(CsvDialect, GivesNumbersTheirPoint) {
  std::string buffer;
  const CsvDialect comma = {';', ','};
  EXPECT_EQ(WithPoint("1,5", comma, buffer), "1.5");
  EXPECT_EQ(WithPoint("15", comma, buffer), "15");
  EXPECT_EQ(WithPoint("1.5", comma, buffer), std::nullopt);
  EXPECT_EQ(WithPoint("1.5", {}, buffer), "1.5");
}

TEST(CsvDialect, WritesNumbers) {
  const auto written = [](const CsvDialect& dialect, const char* number) {
    std::string text = std::string("1.5") + dialect.separator;
    const std::size_t begin = text.size();
    text += number;
    ToDialect(dialect, begin, text);
    return text;
  };
  EXPECT_EQ(written({}, "2.25"), "1.5,2.25");
  EXPECT_EQ(written({';', ','}, "2.25"), "1.5;2,25");
  EXPECT_EQ(written({'\t', ','}, "2"), "1.5\t2");
  EXPECT_EQ(written({',', ','}, "2.25"), "1.5,\"2,25\"");
  EXPECT_EQ(written({',', ','}, "2"), "1.5,2");
}

TEST(CsvReader, ReadsInTheDialectOfTheFile) {
  const TemporaryFolder folder;
  absl::StatusOr<CsvReader> reader = CsvReader::Open(folder.Write("in.csv", "\"a;b\";c\n\"x;y\";1,5\n"));
  CsvBlock block = reader->ReadHeader().value();
  CsvRecord record;
  ASSERT_TRUE(CsvRecords("in.csv", block).Next(record).value());
  EXPECT_EQ(record.cell_count(), 2u);
  EXPECT_EQ(record.Cell(0), "a;b");
  ASSERT_TRUE(reader->Read(block).value());
  CsvRecords records("in.csv", block);
  ASSERT_TRUE(records.Next(record).value());
  EXPECT_EQ(record.Cell(0), "x;y");
  EXPECT_EQ(record.Cell(1), "1,5");
  EXPECT_EQ(record.dialect.Text(), "columns separated by semicolons, decimal commas");
}

}  // namespace
}  // namespace albtpu::formats
