// albtpu_synthetic_table OUT.h5 [--id ID] [--version VERSION] [--factor F] [--published] [--sea]
//
// Writes the table of synthetic_table.h, for tests of programs that need a table file; with --sea, that of one sea. An
// existing file is replaced.
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "tables/file/table_io.h"
#include "tests/tables/synthetic_table.h"

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  albtpu::testing::SyntheticOptions options;
  std::string output;
  bool of_sea = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const auto value = [&] { return i + 1 < arguments.size() ? arguments[++i] : std::string(); };
    if (arguments[i] == "--id")
      options.id = value();
    else if (arguments[i] == "--version")
      options.version = value();
    else if (arguments[i] == "--factor")
      options.factor = std::strtod(value().c_str(), nullptr);
    else if (arguments[i] == "--published")
      options.published = true;
    else if (arguments[i] == "--sea")
      of_sea = true;
    else
      output = arguments[i];
  }
  if (output.empty()) {
    std::cerr << "albtpu_synthetic_table: no output: name a file to write\n";
    return 2;
  }
  using albtpu::testing::SyntheticSea, albtpu::testing::SyntheticTable;
  const absl::Status status =
      albtpu::WriteTable(of_sea ? SyntheticSea() : SyntheticTable(options), output, albtpu::Existing::kReplace);
  if (!status.ok()) std::cerr << "albtpu_synthetic_table: " << status.message() << "\n";
  return status.ok() ? 0 : 1;
}
