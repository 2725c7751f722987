// The inputs with which fuzzing of the readers in sea/files and of the survey file begins.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace albtpu::fuzz {

// By target.
std::map<std::string, std::vector<std::string>> SeaSeeds();

}  // namespace albtpu::fuzz
