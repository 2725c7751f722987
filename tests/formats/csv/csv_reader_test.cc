#include "formats/csv/csv_reader.h"

#include <gmock/gmock.h>

#include "absl/strings/str_cat.h"
#include "tests/temporary_folder.h"

namespace albtpu::formats {
namespace {

using albtpu::testing::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A copy of a record, independent of the memory of its block.
struct OwnRecord {
  std::string text, line_ending;
  std::size_t line;
  std::vector<std::string> cells;
  bool blank;
};

// All records, of the header and of the blocks.
absl::StatusOr<std::vector<OwnRecord>> Read(const std::string& text) {
  const TemporaryFolder folder;
  absl::StatusOr<CsvReader> reader = CsvReader::Open(folder.Write("in.csv", text));
  absl::StatusOr<CsvBlock> block = reader->ReadHeader();
  if (!block.ok()) return block.status();
  std::vector<OwnRecord> records;
  std::string repeated;
  for (absl::StatusOr<bool> more = true; *more;) {
    CsvRecords in_block(reader->name(), *block);
    CsvRecord record;
    for (absl::StatusOr<bool> next = true; *next;) {
      next = in_block.Next(record);
      if (!next.ok()) return next.status();
      if (!*next) break;
      OwnRecord own{std::string(record.text), std::string(record.line_ending), record.line, {}, record.blank()};
      for (std::size_t i = 0; i < record.cell_count(); ++i) own.cells.push_back(record.Cell(i));
      records.push_back(own);
    }
    repeated += block->text;
    more = reader->Read(*block);
    if (!more.ok()) return more.status();
  }
  EXPECT_EQ(repeated, text);
  EXPECT_EQ(reader->bytes_read(), text.size());
  return records;
}

std::vector<OwnRecord> ReadAll(const std::string& text) { return Read(text).value(); }
absl::Status ErrorOf(const std::string& text) { return Read(text).status(); }

TEST(CsvReader, SplitsAtCommas) {
  const std::vector<OwnRecord> records = ReadAll("a,b,c\n1,,3\n");
  ASSERT_EQ(records.size(), 2u);
  EXPECT_THAT(records[0].cells, ElementsAre("a", "b", "c"));
  EXPECT_THAT(records[1].cells, ElementsAre("1", "", "3"));
}

TEST(CsvReader, KeepsTheBytesAndUnquotesTheCells) {
  const std::string text = "\"one, two\",\"say \"\"hi\"\"\",\"two\nlines\"";
  const std::vector<OwnRecord> records = ReadAll(text + "\r\nnext,,\n");
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[0].text, text);
  EXPECT_EQ(records[0].line_ending, "\r\n");
  EXPECT_THAT(records[0].cells, ElementsAre("one, two", "say \"hi\"", "two\nlines"));
  EXPECT_EQ(records[1].line, 3u);
  EXPECT_EQ(records[1].line_ending, "\n");
}

TEST(CsvReader, ExcludesTheByteOrderMarkFromTheFirstCell) {
  const std::vector<OwnRecord> records = ReadAll("\xEF\xBB\xBF\"a\",b\n1,2");
  EXPECT_EQ(records[0].text, "\xEF\xBB\xBF\"a\",b");
  EXPECT_THAT(records[0].cells, ElementsAre("a", "b"));
  EXPECT_THAT(records[1].cells, ElementsAre("1", "2"));
  EXPECT_EQ(records[1].line_ending, "");
}

TEST(CsvReader, RecognizesBlankLines) {
  const std::vector<OwnRecord> records = ReadAll("a\n\r\n1\n");
  ASSERT_EQ(records.size(), 3u);
  EXPECT_TRUE(records[1].blank);
  EXPECT_EQ(records[1].line_ending, "\r\n");
  EXPECT_TRUE(ReadAll("").empty());
}

TEST(CsvReader, ReturnsCompleteRecordsInManyBlocks) {
  std::string text = "a,b\n";
  for (int i = 0; i < 300000; ++i)
    absl::StrAppend(&text, i, i % 1000 == 0 ? ",\"two\nlines, \"\"quoted\"\"\"\r\n" : ",plain\n");
  const std::vector<OwnRecord> records = ReadAll(text);
  ASSERT_EQ(records.size(), 300001u);
  std::size_t line = 2;
  for (int i = 0; i < 300000; ++i) {
    const OwnRecord& record = records[i + 1];
    ASSERT_EQ(record.line, line);
    ASSERT_THAT(record.cells, ElementsAre(std::to_string(i), i % 1000 == 0 ? "two\nlines, \"quoted\"" : "plain"));
    line += i % 1000 == 0 ? 2 : 1;
  }
}

TEST(CsvReader, NamesTheLineOfAnUnclosedQuote) {
  EXPECT_THAT(std::string(ErrorOf("a\nb\n\"c\nd\n").message()), HasSubstr("in.csv line 3: "));
  std::string long_record = "a\n\"";
  long_record.append(CsvReader::kLongestRecord, 'x');
  EXPECT_THAT(std::string(ErrorOf(long_record).message()), HasSubstr("line 2"));
}

TEST(CsvReader, NamesTheCellWithTextAfterItsQuote) {
  EXPECT_THAT(std::string(ErrorOf("a,b\n1,\"2\"3\n").message()), HasSubstr("line 2, column 2"));
  EXPECT_THAT(std::string(ErrorOf("a,b\n1,\"2\"\r3\n").message()), HasSubstr("line 2, column 2"));
  EXPECT_THAT(std::string(ErrorOf("a,b\n\"1\"\r,2\n").message()), HasSubstr("line 2, column 1"));
  EXPECT_THAT(std::string(ErrorOf("a,b\n1,\"2\"\r").message()), HasSubstr("line 2, column 2"));
}

TEST(CsvReader, SaysWhichFileCannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_THAT(std::string(CsvReader::Open(folder / "no.csv").status().message()),
              HasSubstr("no.csv: No such file or directory"));
  EXPECT_THAT(std::string(CsvReader::Open(folder / "").status().message()), HasSubstr("is a folder"));
}

}  // namespace
}  // namespace albtpu::formats
