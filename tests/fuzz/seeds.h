// Inputs to begin with, by target: made by the builders of the tests, so that they follow the formats.
#pragma once

#include <string>
#include <vector>

namespace albtpu::fuzz {

std::vector<std::string> CampaignSeeds();
std::vector<std::string> ColumnSeeds();
std::vector<std::string> CsvSeeds();
std::vector<std::string> LasSeeds();

}  // namespace albtpu::fuzz
