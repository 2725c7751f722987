#include "tables/default_tables.h"

#include <gtest/gtest.h>
#include <stdlib.h>

namespace albtpu {
namespace {

TEST(DefaultTables, AreInstalledBesideTheProgram) {
  unsetenv("ALBTPU_TABLES");
  const std::filesystem::path program = std::filesystem::canonical("/proc/self/exe");
  EXPECT_EQ(DefaultTablesDirectory(), program.parent_path().parent_path() / "share/albtpu/tables");
}

TEST(DefaultTables, AreInTheFolderThatTheEnvironmentNames) {
  setenv("ALBTPU_TABLES", "/somewhere/else", 1);
  EXPECT_EQ(DefaultTablesDirectory(), "/somewhere/else");
  setenv("ALBTPU_TABLES", "", 1);
  EXPECT_EQ(DefaultTablesDirectory().filename(), "tables");
  unsetenv("ALBTPU_TABLES");
}

TEST(WaterTable, IsTheInstalledOneUnlessTheEnvironmentNamesAnother) {
  unsetenv("ALBTPU_WATER_TABLE");
  const std::filesystem::path program = std::filesystem::canonical("/proc/self/exe");
  EXPECT_EQ(InstalledWaterTable(), program.parent_path().parent_path() / "share/albtpu/water/water_column.h5");
  EXPECT_EQ(WaterTablePath(), InstalledWaterTable());
  setenv("ALBTPU_WATER_TABLE", "/somewhere/else.h5", 1);
  EXPECT_EQ(WaterTablePath(), "/somewhere/else.h5");
  unsetenv("ALBTPU_WATER_TABLE");
}

}  // namespace
}  // namespace albtpu
