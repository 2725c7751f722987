#include "service/client/csv_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/service/client/temporary_folder.h"

namespace albtpu::client {
namespace {

using albtpu::testing::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<CsvRecord> ReadAll(const std::string& text) {
  const TemporaryFolder folder;
  absl::StatusOr<CsvReader> reader = CsvReader::Open(folder.Write("in.csv", text));
  EXPECT_TRUE(reader.ok()) << reader.status();
  std::vector<CsvRecord> records;
  for (CsvRecord record; reader->Read(record).value();) records.push_back(record);
  return records;
}

absl::Status ErrorOf(const std::string& text) {
  const TemporaryFolder folder;
  absl::StatusOr<CsvReader> reader = CsvReader::Open(folder.Write("in.csv", text));
  CsvRecord record;
  while (true) {
    const absl::StatusOr<bool> more = reader->Read(record);
    if (!more.ok()) return more.status();
    if (!*more) return absl::OkStatus();
  }
}

std::vector<std::string> Cells(const CsvRecord& record) {
  std::vector<std::string> cells;
  for (std::size_t i = 0; i < record.cell_count(); ++i) cells.push_back(record.Cell(i));
  return cells;
}

TEST(CsvReader, SplitsAtCommas) {
  const std::vector<CsvRecord> records = ReadAll("a,b,c\n1,,3\n");
  ASSERT_EQ(records.size(), 2u);
  EXPECT_THAT(Cells(records[0]), ElementsAre("a", "b", "c"));
  EXPECT_THAT(Cells(records[1]), ElementsAre("1", "", "3"));
}

TEST(CsvReader, KeepsTheBytesAndMeansTheCells) {
  const std::string text = "\"one, two\",\"say \"\"hi\"\"\",\"two\nlines\"";
  const std::vector<CsvRecord> records = ReadAll(text + "\r\nnext,,\n");
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[0].text, text);
  EXPECT_EQ(records[0].line_ending, "\r\n");
  EXPECT_THAT(Cells(records[0]), ElementsAre("one, two", "say \"hi\"", "two\nlines"));
  EXPECT_EQ(records[1].line, 3u);
  EXPECT_EQ(records[1].line_ending, "\n");
}

TEST(CsvReader, LeavesTheByteOrderMarkOutOfTheFirstCell) {
  const std::vector<CsvRecord> records = ReadAll("\xEF\xBB\xBF\"a\",b\n1,2");
  EXPECT_EQ(records[0].text, "\xEF\xBB\xBF\"a\",b");
  EXPECT_THAT(Cells(records[0]), ElementsAre("a", "b"));
  EXPECT_THAT(Cells(records[1]), ElementsAre("1", "2"));
  EXPECT_EQ(records[1].line_ending, "");
}

TEST(CsvReader, SeesBlankLines) {
  const std::vector<CsvRecord> records = ReadAll("a\n\r\n1\n");
  ASSERT_EQ(records.size(), 3u);
  EXPECT_TRUE(records[1].blank());
  EXPECT_EQ(records[1].line_ending, "\r\n");
  EXPECT_TRUE(ReadAll("").empty());
}

TEST(CsvReader, NamesTheLineOfAnOpenQuote) {
  EXPECT_THAT(std::string(ErrorOf("a\nb\n\"c\nd\n").message()), HasSubstr("in.csv line 3: "));
  EXPECT_THAT(std::string(ErrorOf("a\n\"" + std::string(CsvReader::kLongestRecord, 'x')).message()),
              HasSubstr("line 2"));
}

TEST(CsvReader, NamesTheCellWithTextBehindItsQuote) {
  EXPECT_THAT(std::string(ErrorOf("a,b\n1,\"2\"3\n").message()), HasSubstr("line 2, column 2"));
}

TEST(CsvReader, SaysWhatCannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_THAT(std::string(CsvReader::Open(folder / "no.csv").status().message()),
              HasSubstr("no.csv: No such file or directory"));
  EXPECT_THAT(std::string(CsvReader::Open(folder / "").status().message()), HasSubstr("is a folder"));
}

}  // namespace
}  // namespace albtpu::client
