// albtpu_fuzz_seeds FOLDER
//
// Writes FOLDER/TARGET/NUMBER, the inputs that each fuzz target begins with.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>

#include "tables/file/seal.h"
#include "tables/file/table_encoding.h"
#include "tests/fuzz/seeds.h"
#include "tests/tables/synthetic_table.h"

namespace {

std::vector<std::string> TableSeeds() {
  using namespace albtpu;
  std::vector<std::string> seeds;
  for (const UncertaintyTable& table :
       {testing::TinyTable(), testing::TinyTable(Scale::kLog), testing::TinyTable(Scale::kLinear)}) {
    seeds.push_back(EncodeTable(table).value());
  }
  return seeds;
}

// Sealed files that hold next to nothing, and what is none: the seal cares for no more.
std::vector<std::string> SealSeeds() {
  using albtpu::seal::kSize;
  std::vector<std::string> seeds;
  for (const std::string content : {"x", "\x89HDF\r\n\x1a\n and so on"}) {
    std::string file = std::string(kSize, '\0') + content;
    albtpu::seal::Apply(file);
    seeds.push_back(file);
    seeds.push_back(file.substr(0, kSize / 4));
    file[albtpu::seal::kVersionOffset] = 2;
    seeds.push_back(file);
    seeds.push_back(content);
  }
  return seeds;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "albtpu_fuzz_seeds: no folder: name the one to write to\n";
    return 2;
  }
  using namespace albtpu::fuzz;
  const std::map<std::string, std::vector<std::string>> seeds = {
      {"campaign", CampaignSeeds()}, {"columns", ColumnSeeds()}, {"csv", CsvSeeds()},
      {"csv_file", CsvSeeds()},      {"las", LasSeeds()},        {"las_head", LasSeeds()},
      {"seal", SealSeeds()},         {"table", TableSeeds()}};
  for (const auto& [target, inputs] : seeds) {
    const std::filesystem::path folder = std::filesystem::path(argv[1]) / target;
    std::filesystem::create_directories(folder);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      std::ofstream(folder / std::to_string(i), std::ios::binary) << inputs[i];
    }
  }
  return 0;
}
