// Writes the lookup tables of published numbers:
//   albtpu_published_tables validation/paper tables/shipped
#include <filesystem>
#include <iostream>

#include "status/status_macros.h"
#include "tables/file/table_io.h"
#include "validation/published/published_tables.h"

namespace {

absl::Status WriteAll(const std::filesystem::path& paper, const std::filesystem::path& output) {
  using namespace albtpu;
  ASSIGN_OR_RETURN(const PublishedAngles table_4, ReadTable4(paper));
  ASSIGN_OR_RETURN(const UncertaintyTable measured, MeasuredTable(table_4));
  ASSIGN_OR_RETURN(const UncertaintyTable model, ModelTable());
  RETURN_IF_ERROR(WriteTable(measured, output / "birkebak2018_measured.h5", Existing::kReplace));
  return WriteTable(model, output / "birkebak2018_model.h5", Existing::kReplace);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: albtpu_published_tables PAPER_FOLDER OUTPUT_FOLDER\n";
    return 2;
  }
  const absl::Status status = WriteAll(argv[1], argv[2]);
  if (status.ok()) return 0;
  std::cerr << "albtpu_published_tables: " << std::string(status.message()) << '\n';
  return 1;
}
