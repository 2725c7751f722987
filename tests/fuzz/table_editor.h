// Random changes of a table file that leave it HDF5, sealed: a table by someone else's program, more or less.
#pragma once

#include <random>
#include <string>

namespace albtpu::fuzz {

// The file itself where HDF5 cannot open it.
std::string EditTable(const std::string& file, std::mt19937& random);

// The same with another content digest.
std::string WithDigest(const std::string& file, const std::string& digest);

}  // namespace albtpu::fuzz
