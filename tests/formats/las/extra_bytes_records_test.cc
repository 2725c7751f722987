// Files with several Extra Bytes records, which LAS 1.4 does not allow and programs write.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "formats/las/las_extra_bytes.h"
#include "formats/las/las_reader.h"
#include "formats/las/las_writer.h"
#include "tests/formats/las/las_builder.h"
#include "tests/temporary_folder.h"

namespace albtpu::formats {
namespace {

using albtpu::testing::BuildLas;
using albtpu::testing::ExtraBytesEntry;
using albtpu::testing::LasRecord;
using albtpu::testing::LasSpec;
using albtpu::testing::ReadFile;
using albtpu::testing::TemporaryFolder;
using ::testing::HasSubstr;

// An entry of a float by its name, or of a byte in lower case.
std::string Entries(const std::string& names) {
  std::string entries;
  for (const char name : names)
    entries += ExtraBytesEntry(static_cast<std::uint8_t>(name >= 'a' ? 1 : 9), 0, std::string(1, name));
  return entries;
}

struct Case {
  std::vector<std::string> vlrs, evlrs;  // Names of each record.
  std::size_t extra_bytes;
  std::string list;     // Names; empty: refused.
  std::string message;  // Of the refusal.
};

class ExtraBytesRecords : public ::testing::Test {
 protected:
  absl::StatusOr<LasReader> Open(const Case& of) {
    LasSpec spec;
    spec.points.resize(3);
    spec.extra_bytes = of.extra_bytes;
    spec.vlrs.push_back({"someone", 1, "in front"});
    for (const std::string& names : of.vlrs) {
      spec.vlrs.push_back({"LASF_Spec", 4, Entries(names)});
      spec.vlrs.push_back({"someone", 2, "between"});
    }
    spec.evlrs.push_back({"someone", 3, "behind the points"});
    for (const std::string& names : of.evlrs) spec.evlrs.push_back({"LASF_Spec", 4, Entries(names)});
    spec.evlrs.push_back({"someone", 4, "at the end"});
    return LasReader::Open(folder_.Write("in.las", BuildLas(spec)));
  }

  TemporaryFolder folder_;
};

const std::vector<Case>& Cases() {
  static const std::vector<Case> cases = {
      {{"AB"}, {}, 8, "AB", ""},
      {{"A", "B"}, {}, 8, "AB", ""},
      {{"Ab", "c", "D"}, {}, 10, "AbcD", ""},
      {{"A"}, {"B"}, 8, "AB", ""},
      {{}, {"AB"}, 8, "AB", ""},
      {{"A"}, {"A"}, 4, "A", ""},       // Written twice.
      {{"A", "AB"}, {}, 8, "AB", ""},   // Written anew and added to.
      {{"AB", "A"}, {}, 12, "AB", ""},  // The last four bytes are not described.
      {{"A", "b"}, {}, 9, "Ab", ""},
      {{"", "A"}, {}, 4, "A", ""},
      {{"A", "B"}, {}, 4, "", "8 bytes are described, points have 4 extra bytes"},
      {{"A", "BC"}, {}, 8, "", "contradict each other (12 bytes"},  // The second may replace the first.
      {{"AB", "BA"}, {}, 16, "", "a name is described twice"},
      {{"A", "Ba"}, {"B"}, 16, "", "in 3 records that contradict"},
  };
  return cases;
}

TEST_F(ExtraBytesRecords, AreOneListIfTheyAreConsistent) {
  for (const Case& of : Cases()) {
    const absl::StatusOr<LasReader> reader = Open(of);
    ASSERT_TRUE(reader.ok()) << reader.status();
    const absl::StatusOr<std::string> list = ReadExtraBytesRecord(*reader);
    EXPECT_EQ(list.ok(), !of.list.empty()) << list.status();
    if (list.ok()) {
      EXPECT_EQ(*list, Entries(of.list));
    } else {
      EXPECT_THAT(list.status().message(), HasSubstr(of.message));
      EXPECT_THAT(list.status().message(), HasSubstr("keep the right one"));
    }
  }
}

TEST_F(ExtraBytesRecords, AreWrittenAsOne) {
  for (const Case& of : Cases()) {
    const absl::StatusOr<LasReader> reader = Open(of);
    const std::vector<AppendedFloat> appended = AppendedFloats({});
    const absl::StatusOr<LasHead> head = AnnotatedHead(*reader, appended, LasKind::kLas);
    ASSERT_EQ(head.ok(), !of.list.empty()) << head.status();
    if (!head.ok()) continue;
    // The points are as many as before, with eight more bytes each.
    const std::filesystem::path path = folder_ / "out.las";
    {
      auto output = OutputFile::Create(path, Existing::kReplace);
      ASSERT_TRUE(output.ok()) << output.status();
      LasWriter writer(*reader, *head, *output);
      const LasHeader& header = reader->header();
      std::string records;
      for (std::size_t i = 0; i < header.point_count; ++i)
        records += *reader->ReadAt(header.offset_to_points + i * header.record_length, header.record_length) +
                   std::string(8, '\0');
      ASSERT_TRUE(writer.Begin().ok());
      ASSERT_TRUE(writer.Write(records, header.point_count).ok());
      ASSERT_TRUE(writer.End(header.end_of_points(), reader->file_size()).ok());
      ASSERT_TRUE(output->Commit().ok());
    }
    const absl::StatusOr<LasReader> written = LasReader::Open(path);
    ASSERT_TRUE(written.ok()) << written.status();
    const auto count = [](const std::vector<VlrEntry>& entries, std::string_view user) {
      return std::ranges::count_if(entries, [&](const VlrEntry& entry) { return entry.user_id == user; });
    };
    EXPECT_EQ(count(written->vlrs(), "LASF_Spec"), 1);
    EXPECT_EQ(count(written->vlrs(), "someone"), count(reader->vlrs(), "someone"));
    EXPECT_EQ(count(written->evlrs(), "LASF_Spec"), 0);
    EXPECT_EQ(count(written->evlrs(), "someone"), 2);
    EXPECT_EQ(written->evlrs().back().end(), written->file_size());
    const auto data = [](const LasReader& file, const VlrEntry& entry) {
      return *file.ReadAt(entry.data_offset, entry.data_size);
    };
    EXPECT_EQ(data(*written, written->evlrs().front()), "behind the points");
    EXPECT_EQ(data(*written, written->evlrs().back()), "at the end");
    const std::string list = *ReadExtraBytesRecord(*written);
    EXPECT_EQ(list.substr(0, Entries(of.list).size()), Entries(of.list));
    const auto offsets = FloatOffsets("out.las", list, written->header().extra_bytes());
    EXPECT_EQ(offsets->at("sea_thu"), of.extra_bytes);
    EXPECT_EQ(offsets->at("sea_tvu"), of.extra_bytes + 4);
  }
}

}  // namespace
}  // namespace albtpu::formats
