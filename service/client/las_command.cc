#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "service/client/commands.h"
#include "service/client/exit_status.h"
#include "service/client/las_annotation.h"
#include "service/client/las_options.h"

namespace albtpu::client {
namespace {

// What to do when no point is of a class that was asked for.
std::string ClassHint(const Job& job, const LasOptions& options, const AnnotatedLas& annotated) {
  const int least_class = *options.classes.begin();
  const bool never = annotated.point_format < kFirstModernFormat && kLegacyClassMask < least_class;
  return absl::StrCat(job.input.string(), ": no point of class ", absl::StrJoin(options.classes, " or "),
                      never ? absl::StrCat(", nor can there be in point format ", annotated.point_format,
                                           ", whose classes end at ", kLegacyClassMask)
                            : "",
                      ": name the bathymetric ones of this file by --classes (it has ",
                      annotated.summary.ClassesText(), ")");
}

// Whether later files can fare better than this one did.
bool IsOfOneFile(const absl::Status& status) {
  return !absl::IsUnavailable(status) && !absl::IsAborted(status) && !absl::IsDeadlineExceeded(status);
}

// The files of one run, one after the other.
class Annotator {
 public:
  Annotator(const LasOptions& options, const LasAnnotation& annotation, UncertaintySource& source)
      : options_(options), annotation_(annotation), source_(source) {}

  absl::Status Annotate(const Job& job) {
    absl::StatusOr<AnnotatedLas> annotated =
        AnnotateLas(job.input, job.output, options_.shared.existing, annotation_, source_);
    if (!annotated.ok()) return annotated.status();
    const LasSummary& summary = annotated->summary;
    const bool none = summary.points() > 0 && summary.outcomes().total() == 0;
    // One file without the class is a slip of the flag; among many it may be dry land.
    if (none && options_.output_folder.empty()) {
      return absl::FailedPreconditionError(ClassHint(job, options_, *annotated) + "; nothing was written");
    }
    if (none) Note(ClassHint(job, options_, *annotated) + "; all its points get no-data");
    if (absl::Status status = annotated->file.Commit(); !status.ok()) return status;
    SayResolution(annotated->point_format);
    Note(absl::StrCat(job.output.string(), ":\n", summary.Text()));
    points_ += summary.points();
    bathymetric_ += summary.outcomes().total();
    return absl::OkStatus();
  }

  bool found_no_bathymetry() const { return points_ > 0 && bathymetric_ == 0; }

 private:
  // Once a run: all its files are mostly of one kind.
  void SayResolution(int point_format) {
    if (point_format >= kFirstModernFormat || resolution_said_) return;
    Note(absl::StrCat("point format ", point_format,
                      ": scan angles are whole degrees, so that incidence is known to 0.5 degrees"));
    resolution_said_ = true;
  }

  const LasOptions& options_;
  const LasAnnotation& annotation_;
  UncertaintySource& source_;
  bool resolution_said_ = false;
  std::uint64_t points_ = 0, bathymetric_ = 0;
};

absl::Status RunLas(const LasOptions& options) {
  const absl::StatusOr<std::vector<Job>> jobs = Jobs(options);
  if (!jobs.ok()) return jobs.status();
  const absl::StatusOr<LasAnnotation> annotation = Annotation(options);
  if (!annotation.ok()) return annotation.status();
  const absl::StatusOr<std::unique_ptr<UncertaintySource>> source = OpenSource(options.shared.source);
  if (!source.ok()) return source.status();
  const TableSummary& table = (*source)->table();
  Note(absl::StrCat("table ", table.id, " ", table.version, ", digest ", table.digest));
  Annotator annotator(options, *annotation, **source);
  std::size_t failed = 0;
  for (const Job& job : *jobs) {
    absl::Status status = annotator.Annotate(job);
    if (status.ok()) continue;
    if (jobs->size() == 1 || !IsOfOneFile(status)) return status;
    Report(status);
    ++failed;
  }
  if (failed > 0) {
    return absl::FailedPreconditionError(
        absl::StrCat(failed, " of ", jobs->size(), " files failed: see above; the others are written"));
  }
  if (annotator.found_no_bathymetry()) {
    return absl::FailedPreconditionError(absl::StrCat("no file has a point of class ",
                                                      absl::StrJoin(options.classes, " or "),
                                                      ": name the bathymetric ones by --classes"));
  }
  return absl::OkStatus();
}

}  // namespace

void AddLasCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<LasOptions>();
  CLI::App* command = program.add_subcommand(
      "las", "Repeat a LAS file (1.2 to 1.4) with total_thu and total_tvu on each bathymetric point");
  AddLasOptions(*command, *options);
  command->callback([options, &run] { run = [options] { return RunLas(*options); }; });
}

}  // namespace albtpu::client
