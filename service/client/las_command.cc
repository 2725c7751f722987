#include <charconv>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "service/client/commands.h"
#include "service/client/exit_status.h"
#include "service/client/las_annotation.h"
#include "service/client/options.h"

namespace albtpu::client {
namespace {

// ASPRS, LAS Domain Profile for Topo-Bathy Lidar: class 40 is the bathymetric point (seafloor, riverbed,
// known as submerged topography).
constexpr int kBathymetricPoint = 40;

struct LasOptions {
  std::vector<std::string> files;
  std::string output_folder;
  std::set<int> classes = {kBathymetricPoint};
  std::optional<double> water_level, altitude, divergence, wind_from, flight_direction;
  std::optional<double> metres_per_unit;
  FixedCoordinates fixed;  // Wind speed, fetch, footprint, azimuth.
  SharedOptions shared;
};

struct Job {
  std::filesystem::path input, output;
};

absl::StatusOr<std::vector<Job>> Jobs(const LasOptions& options) {
  const std::vector<std::string>& files = options.files;
  if (options.output_folder.empty()) {
    if (files.size() != 2) {
      return UsageError(absl::StrCat("las: ", files.size(),
                                     " files: IN.las OUT.las is right, or --output-dir DIR "
                                     "and any number of inputs"));
    }
    return std::vector<Job>{{files[0], files[1]}};
  }
  std::vector<Job> jobs;
  std::set<std::filesystem::path> names;
  for (const std::filesystem::path input : files) {
    if (!names.insert(input.filename()).second) {
      return UsageError(absl::StrCat("--output-dir: two inputs are called ", input.filename().string(),
                                     ": give them one at a time, as IN.las OUT.las"));
    }
    jobs.push_back({input, options.output_folder / input.filename()});
  }
  return jobs;
}

absl::Status SetFootprint(const LasOptions& options, FlightLine& line) {
  const std::optional<float>& footprint = options.fixed[Index(AxisId::kFootprint)];
  const bool computed = options.altitude.has_value() && options.divergence.has_value();
  if (footprint.has_value() && !options.altitude.has_value() && !options.divergence.has_value()) {
    line.footprint = *footprint;
  } else if (!footprint.has_value() && computed) {
    line.footprint = DivergingBeam{.altitude = *options.altitude, .divergence = *options.divergence};
  } else {
    return UsageError(
        "las: the size of the beam: either --footprint, or --altitude and --divergence, is right");
  }
  return absl::OkStatus();
}

absl::Status SetAzimuth(const LasOptions& options, FlightLine& line) {
  const std::optional<float>& azimuth = options.fixed[Index(AxisId::kAzimuth)];
  const bool computed = options.wind_from.has_value() && options.flight_direction.has_value();
  const bool either = options.wind_from.has_value() || options.flight_direction.has_value();
  if (either != computed || (azimuth.has_value() && either)) {
    return UsageError(
        "las: the direction of the beam: either --azimuth, or --wind-from and --flight-direction, or none of "
        "them, "
        "is right");
  }
  if (azimuth.has_value()) line.azimuth = *azimuth;
  if (computed) {
    line.azimuth =
        AcrossTrackScan{.flight_direction = *options.flight_direction, .wind_from = *options.wind_from};
  }
  return absl::OkStatus();
}

absl::StatusOr<LasAnnotation> Annotation(const LasOptions& options) {
  LasAnnotation annotation;
  annotation.classes = options.classes;
  annotation.style = options.shared.style;
  annotation.unit_is_given = options.metres_per_unit.has_value();
  FlightLine& line = annotation.flight_line;
  if (!options.water_level.has_value()) {
    return UsageError(
        "las: no --water-level: give the height of the water surface in the heights of the file");
  }
  if (!options.fixed[Index(AxisId::kWindSpeed)].has_value()) {
    return UsageError("las: no --wind-speed: give the wind at 10 m in m/s");
  }
  line.water_level = *options.water_level;
  line.metres_per_unit = options.metres_per_unit.value_or(1);
  line.wind_speed = *options.fixed[Index(AxisId::kWindSpeed)];
  line.fetch = options.fixed[Index(AxisId::kFetch)];
  if (absl::Status status = SetFootprint(options, line); !status.ok()) return status;
  if (absl::Status status = SetAzimuth(options, line); !status.ok()) return status;
  return annotation;
}

// What to do when no point is of a class that was asked for.
std::string ClassHint(const Job& job, const LasOptions& options, const AnnotatedLas& annotated) {
  const bool never = annotated.point_format<kFirstModernFormat&& * options.classes.begin()> kLegacyClassMask;
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

std::set<int> ParseClasses(const std::string& text) {
  std::set<int> classes;
  for (const std::string& item : std::vector<std::string>(absl::StrSplit(text, ','))) {
    int value = -1;
    const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), value);
    if (error != std::errc() || end != item.data() + item.size() || value < 0 || value >= kClassCount) {
      throw CLI::ValidationError("--classes",
                                 absl::StrCat("'", item, "': whole numbers from 0 to ", kClassCount - 1,
                                              ", separated by commas, are right"));
    }
    classes.insert(value);
  }
  return classes;
}

double ParseUnit(const std::string& text) {
  if (text == "m") return 1;
  if (text == "ft") return 0.3048;              // International foot, exact.
  if (text == "us-ft") return 1200.0 / 3937.0;  // US survey foot, exact.
  throw CLI::ValidationError("--units",
                             "'" + text + "': m, ft (international) or us-ft (US survey) is right");
}

}  // namespace

void AddLasCommand(CLI::App& program, Run& run) {
  const auto options = std::make_shared<LasOptions>();
  CLI::App* command = program.add_subcommand(
      "las", "Repeat a LAS file (1.2 to 1.4) with total_thu and total_tvu on each bathymetric point");
  command->add_option("files", options->files, "IN.las OUT.las, or with --output-dir any number of inputs")
      ->required()
      ->type_name("FILE.las");
  command
      ->add_option("--output-dir", options->output_folder, "Write each output here, by the name of its input")
      ->type_name("DIR");
  AddNumber(*command, "--water-level", Sign::kAny, "Height of the water surface, in the heights of the file",
            options->water_level)
      ->type_name("Z");
  for (const AxisId axis : {AxisId::kWindSpeed, AxisId::kFetch, AxisId::kFootprint, AxisId::kAzimuth}) {
    AddCoordinate(*command, axis, options->fixed);
  }
  AddNumber(*command, "--altitude", Sign::kNotNegative, "Height of the aircraft above the water [m]",
            options->altitude);
  AddNumber(*command, "--divergence", Sign::kNotNegative, "Full angle of the beam's divergence [mrad]",
            options->divergence);
  AddNumber(*command, "--wind-from", Sign::kAny,
            "Where the wind comes from [degree, true]; across-track scanners", options->wind_from);
  AddNumber(*command, "--flight-direction", Sign::kAny,
            "Where the aircraft goes [degree, true]; across-track scanners", options->flight_direction);
  command
      ->add_option_function<std::string>(
          "--classes", [options](const std::string& text) { options->classes = ParseClasses(text); },
          "The classes that are bathymetric, 40 if left out")
      ->type_name("N,N");
  command
      ->add_option_function<std::string>(
          "--units", [options](const std::string& text) { options->metres_per_unit = ParseUnit(text); },
          "Unit of the heights of the file and of --water-level: m, ft (international) or us-ft (US survey)")
      ->type_name("m|ft|us-ft");
  AddSharedOptions(*command, options->shared);
  command->callback([options, &run] { run = [options] { return RunLas(*options); }; });
}

}  // namespace albtpu::client
