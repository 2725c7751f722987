// Where the tables and other data of an installation are.
#pragma once

#include <filesystem>

namespace albtpu {

// The environment variable `ALBTPU_TABLES` unless it is empty; else PREFIX/share/albtpu/tables of the program
// that runs as PREFIX/bin/NAME. The folder need not exist.
std::filesystem::path DefaultTablesDirectory();

// PREFIX/share/albtpu of the program that runs as PREFIX/bin/NAME. The folder need not exist.
std::filesystem::path InstalledDataDirectory();

}  // namespace albtpu
