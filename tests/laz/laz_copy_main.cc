// Copies the points of a LAS or LAZ file into a file of either kind, and everything else with them.
//
// Usage: albtpu_laz_copy IN OUT [--chunk-size N|variable] [--table front|end|none]
// OUT is compressed if its name ends in .laz.
#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "tests/laz/laz_bytes.h"

namespace albtpu::testing {
namespace {

int Run(const std::string& in, const std::string& out, const LazForm& form) {
  std::ifstream source(in, std::ios::binary);
  const std::string file{std::istreambuf_iterator<char>(source), std::istreambuf_iterator<char>()};
  if (file.size() < 227) {
    std::fprintf(stderr, "%s is not a LAS or LAZ file\n", in.c_str());
    return 1;
  }
  const auto parts = TakeApart(file);
  if (!parts.ok()) {
    std::fprintf(stderr, "%s: %s\n", in.c_str(), std::string(parts.status().message()).c_str());
    return 1;
  }
  std::ofstream target(out, std::ios::binary);
  const std::string copy = out.ends_with(".laz") ? AsLaz(*parts, form) : AsLas(*parts);
  target.write(copy.data(), static_cast<std::streamsize>(copy.size()));
  return target.flush() ? 0 : 1;
}

}  // namespace
}  // namespace albtpu::testing

int main(int argc, char** argv) {
  using albtpu::testing::TableForm;
  CLI::App app("Copies a LAS or LAZ file into one of either kind.");
  std::string in, out, chunk_size = "50000";
  albtpu::testing::LazForm form;
  const std::map<std::string, TableForm> tables = {
      {"front", TableForm::kInFront}, {"end", TableForm::kAtEnd}, {"none", TableForm::kNone}};
  app.add_option("IN", in)->required();
  app.add_option("OUT", out)->required();
  app.add_option("--chunk-size", chunk_size, "Points of a chunk, or variable.");
  app.add_option("--table", form.table, "Where the file says its chunk table is, if it has one.")
      ->transform(CLI::CheckedTransformer(tables));
  CLI11_PARSE(app, argc, argv);
  if (chunk_size == "variable") {
    form.chunk_size = albtpu::laz::kVariableChunks;
  } else {
    const char* end = chunk_size.data() + chunk_size.size();
    if (std::from_chars(chunk_size.data(), end, form.chunk_size).ptr != end || form.chunk_size == 0) {
      std::fprintf(stderr, "--chunk-size is %s (expected a number above 0, or variable)\n", chunk_size.c_str());
      return 2;
    }
  }
  return albtpu::testing::Run(in, out, form);
}
