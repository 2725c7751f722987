#include "quality/annotated/annotated_folder.h"

#include <algorithm>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "annotate/answers/batch.h"
#include "annotate/run/file_jobs.h"
#include "annotate/run/file_progress.h"
#include "formats/files/file_access.h"
#include "formats/las/las_points.h"
#include "quality/annotated/point_sample.h"
#include "status/status_macros.h"

namespace albtpu::quality {
namespace fs = std::filesystem;

namespace {

// The LAS and LAZ files of a folder, or the file itself, are added to `paths`.
absl::Status AddFiles(const fs::path& folder_or_file, std::vector<fs::path>& paths) {
  std::error_code error;
  if (!fs::is_directory(folder_or_file, error)) {
    paths.push_back(folder_or_file);
    return absl::OkStatus();
  }
  const std::size_t before = paths.size();
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_or_file, error))
    if (formats::IsVisible(entry.path()) &&
        (annotate::HasExtension(entry.path(), ".las") || annotate::HasExtension(entry.path(), ".laz")))
      paths.push_back(entry.path());
  if (error)
    return absl::InvalidArgumentError(absl::StrCat(folder_or_file.string(), ": cannot be read: ", error.message()));
  if (paths.size() == before)
    return absl::NotFoundError(
        absl::StrCat(folder_or_file.string(), ": has no LAS or LAZ file; give the folder that albtpu-query las wrote"));
  return absl::OkStatus();
}

// Those of all of them, by name.
absl::StatusOr<std::vector<fs::path>> PathsOf(const std::vector<fs::path>& folders_or_files) {
  std::vector<fs::path> paths;
  for (const fs::path& each : folders_or_files) RETURN_IF_ERROR(AddFiles(each, paths));
  std::ranges::sort(paths, {}, [](const fs::path& path) { return std::pair(path.filename(), path); });
  return paths;
}

}  // namespace

absl::StatusOr<std::vector<fs::path>> FilesOfAnnotated(const std::vector<fs::path>& folders_or_files) {
  ASSIGN_OR_RETURN(const std::vector<fs::path> paths, PathsOf(folders_or_files));
  std::vector<fs::path> files = paths;
  for (const fs::path& path : paths) files.push_back(annotate::SummaryPath(path));
  return files;
}

absl::StatusOr<std::vector<AnnotatedLasFile>> OpenAnnotated(const fs::path& folder_or_file) {
  return OpenAnnotated(std::vector{folder_or_file});
}

absl::StatusOr<std::vector<AnnotatedLasFile>> OpenAnnotated(const std::vector<fs::path>& folders_or_files) {
  ASSIGN_OR_RETURN(std::vector<AnnotatedLasFile> files, OpenAnnotatedOrNone(folders_or_files));
  if (files.empty())
    return absl::FailedPreconditionError(
        absl::StrCat(folders_or_files.front().string(), ": no file has points; give the outputs of albtpu-query las"));
  return files;
}

absl::StatusOr<std::vector<AnnotatedLasFile>> OpenAnnotatedOrNone(const std::vector<fs::path>& folders_or_files) {
  ASSIGN_OR_RETURN(const std::vector<fs::path> paths, PathsOf(folders_or_files));
  const auto twice = std::ranges::adjacent_find(paths);
  if (twice != paths.end())
    return absl::InvalidArgumentError(absl::StrCat(twice->string(), ": is given twice; give each file once"));
  std::vector<AnnotatedLasFile> files;
  std::size_t of_datum = 0;  // The first file that states a vertical datum; the last one where none does.
  for (const fs::path& path : paths) {
    ASSIGN_OR_RETURN(const formats::LasReader reader, formats::LasReader::Open(path));
    if (reader.header().point_count == 0) {
      annotate::Note(absl::StrCat(path.string(), ": has no points, and is left out"));
      continue;
    }
    ASSIGN_OR_RETURN(AnnotatedLasFile file, AnnotatedLasFile::Open(path));
    files.push_back(std::move(file));
    if (files[of_datum].vertical_name().empty()) of_datum = files.size() - 1;
    const AnnotatedLasFile &first = files.front(), &datum = files[of_datum], &last = files.back();
    const auto differ_from = [&](const AnnotatedLasFile& other, const std::string& what, const std::string& in_other,
                                 const std::string& in_last, const std::string& remedy) {
      return absl::InvalidArgumentError(absl::StrCat(last.path().string(), ": its ", what, " is ", in_last, " (in ",
                                                     other.path().string(), " it is ", in_other, "); ", remedy));
    };
    const auto differ = [&](const std::string& what, const std::string& in_first, const std::string& in_last,
                            const std::string& remedy) { return differ_from(first, what, in_first, in_last, remedy); };
    if (last.crs_name() != first.crs_name())
      return differ("coordinate system", first.crs_name(), last.crs_name(), "report each system apart");
    if (last.vertical_name() != datum.vertical_name() && !last.vertical_name().empty())
      return differ_from(datum, "vertical datum", datum.vertical_name(), last.vertical_name(),
                         "report each datum apart");
    if (last.metres_per_unit() != first.metres_per_unit()) {
      const auto unit = [](double metres) { return absl::StrFormat("%.10g m", metres); };
      return differ("unit of x and y", unit(first.metres_per_unit()), unit(last.metres_per_unit()),
                    "report each unit apart");
    }
    if (last.coverage() != first.coverage()) {
      return differ("coverage", std::string(annotate::CoverageName(first.coverage())),
                    std::string(annotate::CoverageName(last.coverage())), "annotate all files with one --coverage");
    }
    if (last.table_digest() != first.table_digest())
      return differ("table", first.table_digest(), last.table_digest(), "annotate all files by one table");
  }
  const auto sampled = files.size() > 1 ? std::make_shared<SampledFiles>() : nullptr;
  for (AnnotatedLasFile& file : files) file.CompareWith(sampled);
  return files;
}

}  // namespace albtpu::quality
