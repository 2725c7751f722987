#include <gmock/gmock.h>

#include <fstream>
#include <future>

#include "service/server/tables/table_catalog.h"
#include "tests/service/server/served_tables.h"
#include "tests/tables/water/shipped_water.h"

namespace albtpu::server {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Kind = TableCatalog::Change::Kind;

class LiveTablesTest : public ::testing::Test {
 protected:
  LiveTablesTest() {
    Put("quick.h5", 1);
    Put("survey/1.h5", 1);
    tables_.emplace(OrDie(TableCatalog::Load(folder_.path(), "")));
  }

  // Replaces the file atomically, as tables are written.
  void Put(const std::string& file, double factor) {
    std::filesystem::create_directories((folder_ / file).parent_path());
    const absl::Status written =
        WriteTable(testing::SyntheticTable({.factor = factor}), folder_ / file, Existing::kReplace);
    ASSERT_TRUE(written.ok()) << written;
  }

  void Spoil(const std::string& file) { std::ofstream(folder_ / file) << "not a table"; }

  LiveTables::ReloadResult Reload() {
    std::promise<LiveTables::ReloadResult> result;
    tables_->Reload([&result](const LiveTables::ReloadResult& value) { result.set_value(value); });
    return result.get_future().get();
  }

  static std::map<std::string, Kind> Kinds(const LiveTables::ReloadResult& result) {
    std::map<std::string, Kind> kinds;
    for (const TableCatalog::Change& change : OrDie(result)) kinds[change.name] = change.kind;
    return kinds;
  }

  std::string DigestOf(std::string_view name) { return OrDie(tables_->current()->Find(name))->table.digest(); }

  testing::TemporaryFolder folder_;
  std::optional<LiveTables> tables_;
};

TEST_F(LiveTablesTest, ShareUnchangedTables) {
  const auto before = tables_->current();
  EXPECT_EQ(Kinds(Reload()), (std::map<std::string, Kind>{{"quick", Kind::kKept}, {"survey/1", Kind::kKept}}));
  const auto after = tables_->current();
  EXPECT_NE(after, before);
  EXPECT_EQ(after->entries(), before->entries());  // The same objects.
}

TEST_F(LiveTablesTest, LoadNewAndChangedTablesAndDropRemovedOnes) {
  Put("bay.h5", 2);
  Put("survey/1.h5", 3);
  std::filesystem::remove(folder_ / "quick.h5");
  const std::string survey = DigestOf("survey");
  EXPECT_EQ(Kinds(Reload()), (std::map<std::string, Kind>{
                                 {"bay", Kind::kLoaded}, {"survey/1", Kind::kLoaded}, {"quick", Kind::kRemoved}}));
  EXPECT_NE(DigestOf("survey"), survey);
  EXPECT_EQ(tables_->current()->Find("quick").status().code(), absl::StatusCode::kNotFound);
}

TEST_F(LiveTablesTest, UseTheNewestVersionUnlessOneIsNamed) {
  const std::string first = DigestOf("survey");
  Put("survey/2.h5", 2);
  ASSERT_TRUE(Reload().ok());
  EXPECT_NE(DigestOf("survey"), first);
  EXPECT_EQ(DigestOf("survey/1"), first);
}

TEST_F(LiveTablesTest, AllStayWhenOneTableIsDamaged) {
  const auto before = tables_->current();
  Put("survey/2.h5", 2);
  Spoil("quick.h5");
  Spoil("worse.h5");
  const LiveTables::ReloadResult result = Reload();
  EXPECT_THAT(std::string(result.status().message()), AllOf(HasSubstr("quick.h5"), HasSubstr("worse.h5")));
  EXPECT_EQ(tables_->current(), before);

  Put("quick.h5", 4);
  std::filesystem::remove(folder_ / "worse.h5");
  EXPECT_TRUE(Reload().ok());
  EXPECT_EQ(OrDie(tables_->current()->Find("survey"))->name, "survey/2");
}

TEST_F(LiveTablesTest, StayWhenTheFolderIsInvalid) {
  const auto before = tables_->current();
  Put("survey.h5", 1);  // Beside survey/1.h5.
  EXPECT_FALSE(Reload().ok());
  std::filesystem::remove_all(folder_.path());
  EXPECT_FALSE(Reload().ok());
  std::filesystem::create_directory(folder_.path());
  EXPECT_FALSE(Reload().ok());
  EXPECT_EQ(tables_->current(), before);
}

TEST_F(LiveTablesTest, StayWhenTheGivenDefaultIsMissing) {
  tables_.reset();
  tables_.emplace(OrDie(TableCatalog::Load(folder_.path(), "quick")));
  std::filesystem::remove(folder_ / "quick.h5");
  EXPECT_THAT(std::string(Reload().status().message()), HasSubstr("quick"));
  EXPECT_TRUE(tables_->current()->Find("").ok());
}

TEST_F(LiveTablesTest, LoadTheTableOfTheWaterAgain) {
  const testing::TemporaryFolder elsewhere;
  const std::filesystem::path path = elsewhere / "water.h5";
  const auto version = [&] { return tables_->current()->water()->table.table().provenance().version; };
  ASSERT_TRUE(testing::WriteWaterTable("2", path).ok());
  TableCatalog catalog = OrDie(TableCatalog::Load(folder_.path(), ""));
  EXPECT_EQ(catalog.water(), nullptr);
  EXPECT_FALSE(catalog.AddWater(folder_ / "quick.h5").ok());
  ASSERT_TRUE(catalog.AddWater(path).ok());
  tables_.emplace(std::move(catalog));

  const auto before = tables_->current();
  EXPECT_EQ(Kinds(Reload()).size(), 2);  // Requests cannot name it, and clients of 0.1.0 do not expect it.
  EXPECT_EQ(tables_->current()->water(), before->water());
  ASSERT_TRUE(testing::WriteWaterTable("3", path).ok());
  ASSERT_TRUE(Reload().ok());
  EXPECT_EQ(version(), "3");
  std::ofstream(path) << "not a table";
  Put("quick.h5", 2);
  EXPECT_THAT(std::string(Reload().status().message()), HasSubstr("water.h5"));
  EXPECT_EQ(version(), "3");
  std::filesystem::remove(path);
  EXPECT_FALSE(Reload().ok());
}

TEST_F(LiveTablesTest, LiveWhileACallHoldsThem) {
  const auto held = tables_->current();
  const TableCatalog::Entry* entry = OrDie(held->Find("quick"));
  Put("quick.h5", 2);
  ASSERT_TRUE(Reload().ok());
  const std::string digest = DigestOf("quick");
  tables_.reset();
  EXPECT_NE(entry->table.digest(), digest);
  EXPECT_EQ(entry->table.digest(), OrDie(held->Find("quick"))->table.digest());
}

TEST_F(LiveTablesTest, NotifyEveryCaller) {
  std::promise<void> all_notified;
  std::atomic<int> notified = 0;
  for (int i = 0; i < 10; ++i) {
    tables_->Reload([&](const LiveTables::ReloadResult& result) {
      EXPECT_TRUE(result.ok());
      if (++notified == 10) all_notified.set_value();
    });
  }
  all_notified.get_future().get();
}

}  // namespace
}  // namespace albtpu::server
