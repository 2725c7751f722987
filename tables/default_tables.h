// The places of the tables and other data of an installation.
#pragma once

#include <filesystem>

namespace albtpu {

// The value of the environment variable `ALBTPU_TABLES`. If it is empty or not set, PREFIX/share/albtpu/tables for a
// program that runs as PREFIX/bin/NAME. The folder need not exist.
std::filesystem::path DefaultTablesDirectory();

// The table of the water column: the value of the environment variable `ALBTPU_WATER_TABLE`. If it is empty or not set,
// the installed one. The file need not exist.
std::filesystem::path WaterTablePath();

// PREFIX/share/albtpu/water/water_column.h5 for a program that runs as PREFIX/bin/NAME. The file need not exist.
std::filesystem::path InstalledWaterTable();

// PREFIX/share/albtpu for a program that runs as PREFIX/bin/NAME. The folder need not exist.
std::filesystem::path InstalledDataDirectory();

}  // namespace albtpu
