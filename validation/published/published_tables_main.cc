// Writes the lookup tables of published numbers:
//   albtpu_published_tables validation/paper tables/shipped
#include <filesystem>
#include <iostream>

#include "tables/file/table_io.h"
#include "validation/published/published_tables.h"

namespace {

absl::Status Write(const absl::StatusOr<albtpu::UncertaintyTable>& table, const std::filesystem::path& path) {
  if (!table.ok()) return table.status();
  return albtpu::WriteTable(*table, path, albtpu::Existing::kReplace);
}

absl::Status WriteAll(const std::filesystem::path& paper, const std::filesystem::path& output) {
  const absl::StatusOr<albtpu::PublishedAngles> table_4 = albtpu::ReadTable4(paper);
  if (!table_4.ok()) return table_4.status();
  absl::Status status = Write(albtpu::MeasuredTable(*table_4), output / "birkebak2018_measured.h5");
  if (status.ok()) status = Write(albtpu::ModelTable(), output / "birkebak2018_model.h5");
  return status;
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
