#include "tables/file/table_io.h"

#include <gmock/gmock.h>

#include <string>
#include <thread>
#include <vector>

#include "tests/tables/synthetic_table.h"
#include "tests/temporary_folder.h"

namespace albtpu {
namespace {

namespace fs = std::filesystem;
using ::albtpu::testing::PartsOf;
using ::albtpu::testing::ReadFile;
using ::albtpu::testing::SyntheticSea;
using ::albtpu::testing::SyntheticTable;
using ::albtpu::testing::TableParts;
using ::albtpu::testing::TemporaryFolder;
using ::albtpu::testing::TinyTable;
using ::testing::HasSubstr;
using ::testing::StartsWith;

void ExpectSame(const UncertaintyTable& a, const UncertaintyTable& b) {
  for (AxisId axis : kAxes) {
    EXPECT_EQ(a.axis(axis).nodes(), b.axis(axis).nodes());
    EXPECT_EQ(a.axis(axis).scale(), b.axis(axis).scale());
  }
  for (Quantity quantity : kQuantities) {
    const Variable *from = a.variable(quantity), *to = b.variable(quantity);
    ASSERT_EQ(from == nullptr, to == nullptr);
    if (from == nullptr) continue;
    EXPECT_EQ(from->values, to->values);
    EXPECT_EQ(from->standard_errors, to->standard_errors);
    EXPECT_EQ(from->scale, to->scale);
  }
  EXPECT_EQ(a.provenance().id, b.provenance().id);
  EXPECT_EQ(a.provenance().version, b.provenance().version);
  EXPECT_EQ(a.provenance().title, b.provenance().title);
  EXPECT_EQ(a.provenance().campaign, b.provenance().campaign);
  EXPECT_EQ(a.provenance().attributes, b.provenance().attributes);
  EXPECT_EQ(a.digest(), b.digest());
}

void ExpectRoundTrip(const UncertaintyTable& table) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteTable(table, folder / "t.h5", Existing::kKeep).ok());
  const absl::StatusOr<UncertaintyTable> read = ReadTable(folder / "t.h5");
  ExpectSame(table, *read);
}

TEST(TableIo, ReadsBackWhatItHasWritten) {
  ExpectRoundTrip(SyntheticTable());
  ExpectRoundTrip(SyntheticTable({.published = true}));
  ExpectRoundTrip(TinyTable());
  ExpectRoundTrip(TinyTable(Scale::kLog));
}

TEST(TableIo, KeepsTheKindOfTheTable) {
  ExpectRoundTrip(SyntheticSea());
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteTable(SyntheticSea(), folder / "sea.h5", Existing::kKeep).ok());
  EXPECT_TRUE(ReadTable(folder / "sea.h5")->is_of_one_sea());
  EXPECT_TRUE(ReadTable(folder / "sea.h5", kOneSea).ok());
  const absl::Status refused = ReadTable(folder / "sea.h5", kSeaSurface).status();
  EXPECT_EQ(refused.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(refused.message()), HasSubstr("is a table of kind 'one_sea': expected kind 'sea_surface'"));
  ASSERT_TRUE(WriteTable(SyntheticTable(), folder / "winds.h5", Existing::kKeep).ok());
  EXPECT_FALSE(ReadTable(folder / "winds.h5")->is_of_one_sea());
}

TEST(TableIo, KeepsTheTypesOfAttributes) {
  TableParts parts = PartsOf(TinyTable());
  parts.provenance.title = "";
  parts.provenance.campaign = "";
  parts.provenance.attributes = {{"text", std::string("Höhe über See")},
                                 {"no_text", std::string()},
                                 {"integer", std::int64_t{-9'007'199'254'740'993}},
                                 {"real", 0.1},
                                 {"list", std::vector<double>{1, 2.5}},
                                 {"one", std::vector<double>{1}},
                                 {"none", std::vector<double>{}}};
  ExpectRoundTrip(*parts.Create());
}

// HDF5 stores attributes above 64 KiB in another place.
TEST(TableIo, KeepsALongCampaign) {
  TableParts parts = PartsOf(TinyTable());
  parts.provenance.campaign = std::string(300'000, '#') + "\n";
  parts.provenance.attributes["list"] = std::vector<double>(20'000, 0.5);
  ExpectRoundTrip(*parts.Create());
}

TEST(TableIo, WritesTheSameTableAsTheSameBytes) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteTable(SyntheticTable(), folder / "a.h5", Existing::kKeep).ok());
  ASSERT_TRUE(WriteTable(TinyTable(), folder / "other.h5", Existing::kKeep).ok());
  ASSERT_TRUE(WriteTable(*ReadTable(folder / "a.h5"), folder / "b.h5", Existing::kKeep).ok());
  EXPECT_EQ(ReadFile(folder / "a.h5"), ReadFile(folder / "b.h5"));
}

TEST(TableIo, KeepsAnExistingFileUnlessAskedToReplaceIt) {
  const TemporaryFolder folder;
  folder.Write("t.h5", "precious");
  EXPECT_EQ(WriteTable(TinyTable(), folder / "t.h5", Existing::kKeep).code(), absl::StatusCode::kAlreadyExists);
  EXPECT_EQ(ReadFile(folder / "t.h5"), "precious");
  EXPECT_TRUE(WriteTable(TinyTable(), folder / "t.h5", Existing::kReplace).ok());
  EXPECT_TRUE(ReadTable(folder / "t.h5").ok());
}

// HDF5 looks on disk for a file with the name of a file in memory.
TEST(TableIo, WorksWhateverFilesAreInTheCurrentFolder) {
  const TemporaryFolder folder;
  for (const std::string name : {"table", "tables", "survey.h5"}) folder.Write(name, "something else");
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  ExpectRoundTrip(TinyTable());
  fs::current_path(before);
}

TEST(TableIo, NamesAMissingFile) {
  const absl::Status status = ReadTable("no/such.h5").status();
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(status.message(), "no/such.h5: no such file");
}

TEST(TableIo, RefusesFoldersAndDevices) {
  const TemporaryFolder folder;
  for (const fs::path& path : {folder.path(), fs::path("/dev/zero")}) {
    const absl::Status status = ReadTable(path).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kDataLoss);
    EXPECT_THAT(std::string(status.message()), HasSubstr("is not a regular file"));
  }
}

// Which damage has which message: seal_test.cc.
TEST(TableIo, BeginsTheReportOfADamagedFileWithItsPath) {
  const TemporaryFolder folder;
  const fs::path path = folder / "t.h5";
  ASSERT_TRUE(WriteTable(TinyTable(), path, Existing::kKeep).ok());
  const std::string whole = ReadFile(path);
  for (const auto& [bytes, message] : {std::pair(std::string(), "is empty"),
                                       {whole.substr(512), "is an HDF5 file without the seal"},
                                       {whole.substr(0, whole.size() - 1), "is truncated: "},
                                       {whole + "x", "is damaged: it has"}}) {
    folder.Write("t.h5", bytes);
    const absl::Status status = ReadTable(path).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kDataLoss);
    EXPECT_THAT(std::string(status.message()), StartsWith(path.string() + ": " + message));
  }
}

TEST(TableIo, ReadsAndWritesFromManyThreads) {
  const TemporaryFolder folder;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&folder, i] {
      const fs::path path = folder / (std::to_string(i) + ".h5");
      const UncertaintyTable table = SyntheticTable({.factor = 1.0 + i});
      ASSERT_TRUE(WriteTable(table, path, Existing::kKeep).ok());
      const absl::StatusOr<UncertaintyTable> read = ReadTable(path);
      EXPECT_EQ(read->digest(), table.digest());
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace albtpu
