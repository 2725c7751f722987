#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "survey/commands/commands.h"
#include "survey/commands/interpolation_error.h"
#include "survey/commands/las_options.h"
#include "survey/exit_status.h"
#include "survey/files/annotation_run.h"
#include "survey/las/las_annotation.h"

namespace albtpu::client {
namespace {

// The message for a file that has no point of the given classes.
std::string ClassHint(const Job& job, const LasOptions& options, const AnnotatedLas& annotated) {
  const int least_class = *options.classes.begin();
  const bool never = annotated.point_format < kFirstModernFormat && kLegacyClassMask < least_class;
  return absl::StrCat(
      job.input.string(), ": no point of class ", absl::StrJoin(options.classes, " or "), " (",
      never ? absl::StrCat("classes of point format ", annotated.point_format, " end at ", kLegacyClassMask,
                           "; ")
            : "",
      "the file has ", annotated.classes.Text(), "); name its bathymetric classes with --classes");
}

class LasFiles {
 public:
  LasFiles(const LasOptions& options, const LasAnnotation& annotation, UncertaintySource& source)
      : options_(options), annotation_(annotation), source_(source) {}

  absl::StatusOr<AnnotatedFile> Annotate(const Job& job, FileProgress& progress) {
    absl::StatusOr<AnnotatedLas> annotated =
        AnnotateLas(job.input, job.output, options_.existing, annotation_, source_, progress);
    if (!annotated.ok()) return annotated.status();
    const std::uint64_t points = annotated->classes.points();
    const std::uint64_t bathymetric = annotated->summary.outcomes().total();
    const bool none = points > 0 && bathymetric == 0;
    // A single file without the class points to a wrong --classes; among many files it may be dry land.
    if (none && options_.files.output_folder.empty()) {
      return absl::FailedPreconditionError(ClassHint(job, options_, *annotated) + "; nothing was written");
    }
    if (none) Note(ClassHint(job, options_, *annotated) + "; all its points get no-data");
    NoteResolution(annotated->point_format);
    points_ += points;
    bathymetric_ += bathymetric;
    return AnnotatedFile{std::move(annotated->file),
                         Findings{.input_bytes = annotated->input_bytes,
                                  .input = {{"point_format", annotated->point_format},
                                            {"points", points},
                                            {"points_by_class", annotated->classes.Json()}},
                                  .answers = annotated->summary.Json()},
                         absl::StrCat("\n  ", points, " points; bathymetric: ", annotated->summary.Text())};
  }

  bool found_no_bathymetry() const { return points_ > 0 && bathymetric_ == 0; }

 private:
  // Once for all files, which mostly have the same point format.
  void NoteResolution(int point_format) {
    if (point_format >= kFirstModernFormat || resolution_noted_) return;
    Note(absl::StrCat("point format ", point_format,
                      ": scan angles are whole degrees, so incidence is known to 0.5 degrees"));
    resolution_noted_ = true;
  }

  const LasOptions& options_;
  const LasAnnotation& annotation_;
  UncertaintySource& source_;
  bool resolution_noted_ = false;
  std::uint64_t points_ = 0, bathymetric_ = 0;
};

absl::Status RunLas(const LasOptions& options) {
  const absl::StatusOr<LasAnnotation> annotation = Annotation(options);
  if (!annotation.ok()) return annotation.status();
  const absl::StatusOr<std::vector<Job>> jobs = FindJobs("las", ".las", options.files);
  if (!jobs.ok()) return jobs.status();
  const absl::StatusOr<std::unique_ptr<UncertaintySource>> source = OpenSource(options.source);
  if (!source.ok()) return source.status();
  if (options.style.standard_errors) Note(InterpolationErrorNote((*source)->table()));
  LasFiles files(options, *annotation, **source);
  const absl::Status status = AnnotateFiles(
      *jobs,
      {.command = "las",
       .records = "points",
       .parameters = Parameters(*annotation),
       .resume = options.files.resume,
       .existing = options.existing,
       .annotate = [&](const Job& job, FileProgress& progress) { return files.Annotate(job, progress); }},
      (*source)->table());
  // With --resume, the files that were skipped may have such points.
  if (status.ok() && !options.files.resume && files.found_no_bathymetry()) {
    return absl::FailedPreconditionError(absl::StrCat("no file has a point of class ",
                                                      absl::StrJoin(options.classes, " or "),
                                                      "; name the bathymetric classes with --classes"));
  }
  return status;
}

}  // namespace

void AddLasCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<LasOptions>();
  CLI::App* command = program.add_subcommand(
      "las", "Copy LAS files (1.2 to 1.4) and append total_thu and total_tvu to each point");
  AddLasOptions(*command, *options);
  command->callback([options, &run] { run = [options] { return RunLas(*options); }; });
}

}  // namespace albtpu::client
