#include "tables/default_tables.h"

#include <cstdlib>
#include <system_error>

namespace albtpu {

std::filesystem::path InstalledDataDirectory() {
  std::error_code error;  // Without /proc, the path is relative to the current folder.
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path() / "share" / "albtpu";
}

std::filesystem::path DefaultTablesDirectory() {
  if (const char* folder = std::getenv("ALBTPU_TABLES"); folder != nullptr && *folder != '\0') return folder;
  return InstalledDataDirectory() / "tables";
}

std::filesystem::path WaterTablePath() {
  if (const char* path = std::getenv("ALBTPU_WATER_TABLE"); path != nullptr && *path != '\0') return path;
  return InstalledWaterTable();
}

std::filesystem::path InstalledWaterTable() { return InstalledDataDirectory() / "water" / "water_column.h5"; }

}  // namespace albtpu
