// The places of the tables and other data of an installation.
#pragma once

#include <filesystem>

namespace albtpu {

// The value of the environment variable `ALBTPU_TABLES`. If it is empty or not set, PREFIX/share/albtpu/tables for a
// program that runs as PREFIX/bin/NAME. The folder need not exist.
std::filesystem::path DefaultTablesDirectory();

// PREFIX/share/albtpu for a program that runs as PREFIX/bin/NAME. The folder need not exist.
std::filesystem::path InstalledDataDirectory();

}  // namespace albtpu
