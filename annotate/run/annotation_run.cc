#include "annotate/run/annotation_run.h"

#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "status/status_macros.h"

namespace albtpu::annotate {
namespace {

namespace fs = std::filesystem;

constexpr double kShortestTimedRun = 2;  // s; shorter runs print no rate.

// Whether the failure concerns this file only. When the source has failed or refuses the token, or the disk is full,
// later files would fail as well.
bool ConcernsOneFile(const absl::Status& status) {
  return !absl::IsUnavailable(status) && !absl::IsAborted(status) && !absl::IsDeadlineExceeded(status) &&
         !absl::IsResourceExhausted(status) && !absl::IsUnauthenticated(status);
}

std::uint64_t TotalSize(const std::vector<Job>& jobs) {
  std::uint64_t total = 0;
  for (const Job& job : jobs) total += SizeOf(job.input);
  return total;
}

class Run {
 public:
  Run(const AnnotationRun& run, const client::TableSummary& table, const std::vector<Job>& jobs)
      : run_(run),
        settings_{run.command, run.parameters, table, run.resume ? NewestOf(run.files) : std::nullopt},
        jobs_(jobs),
        progress_(run.records, jobs.size(), TotalSize(jobs)),
        verdict_(run.cause, run.record) {
    for (const Job& job : jobs) read_.Add(job.input);
    read_.Add(run.files);
  }

  absl::Status operator()() {
    const absl::Status status = AnnotateAll();
    if (const std::string note = verdict_.DeepNote(); !note.empty()) Note(note);
    return status.ok() ? verdict_.status() : status;
  }

 private:
  absl::Status AnnotateAll() {
    for (const Job& job : jobs_) {
      progress_.NextFile();
      const absl::Status status = Annotate(job);
      if (status.ok()) {
        ++done_;
      } else if (jobs_.size() == 1) {
        return status;
      } else if (!ConcernsOneFile(status)) {
        return absl::Status(status.code(), absl::StrCat(status.message(), "; ", DoneText()));
      } else {
        Report(status);
        ++failed_;
      }
    }
    if (progress_.seconds() >= kShortestTimedRun && progress_.records() > 0) {
      Note(absl::StrFormat("%d %s in %.1f s: %s", progress_.records(), run_.records, progress_.seconds(),
                           RateText(progress_.records(), progress_.seconds(), run_.records)));
    }
    if (failed_ == 0) return absl::OkStatus();
    return absl::FailedPreconditionError(absl::StrCat(failed_, " of ", jobs_.size(), " files failed",
                                                      done_ > 0 ? " (the others are written)" : "",
                                                      "; see the messages above"));
  }

  // Adds a file that was written or kept to the verdict. Its problem is the whole verdict if there is only one.
  void Judge(const Job& job, const AnswerTally& answers) {
    const std::string problem = verdict_.Add(job.output.string(), answers);
    if (!problem.empty() && jobs_.size() > 1) Note(problem);
  }

  absl::Status Annotate(const Job& job) {
    if (run_.resume) {
      const absl::Status complete = CheckComplete(settings_, job);
      if (complete.ok()) {
        progress_.Skip(SizeOf(job.input));
        Note(absl::StrCat(job.output.string(), ": is already complete; skipped"));
        PrintSummary(job);
        Judge(job, AnswerTally::FromJson(ReadAnswers(job)));
        return complete;
      }
      if (!absl::IsNotFound(complete) && run_.existing == Existing::kKeep) {
        return absl::Status(complete.code(),
                            absl::StrCat(complete.message(), "; add --overwrite, or choose another name"));
      }
    }
    RETURN_IF_ERROR(CheckWritesNoInput(job));
    RETURN_IF_ERROR(MakeRoomForSummary(job, run_.existing));
    std::error_code ignored;  // If this fails, creating the output reports why.
    if (job.in_subfolder) fs::create_directories(job.output.parent_path(), ignored);
    if (job.in_subfolder && !job.csv.empty()) fs::create_directories(job.csv.parent_path(), ignored);
    ASSIGN_OR_RETURN(AnnotatedFile annotated, run_.annotate(job, progress_));
    const std::string summary = SummaryText(settings_, job, annotated.findings, annotated.file.size());
    RETURN_IF_ERROR(
        CommitWithSummary(std::move(annotated.file), job, summary, run_.existing, std::move(annotated.csv)));
    Note(absl::StrCat(job.output.string(), ":"), annotated.text);
    PrintSummary(job);
    Judge(job, annotated.findings.tally);
    return absl::OkStatus();
  }

  // The same text as in the file beside the output.
  void PrintSummary(const Job& job) const {
    if (run_.json) std::cout << ReadSummary(SummaryPath(job.output)).dump() << std::endl;
  }

  // With --overwrite, an output that has the name of a file which the run reads would replace it.
  absl::Status CheckWritesNoInput(const Job& job) const {
    const auto check = [&](const fs::path& output) -> absl::Status {
      RETURN_IF_ERROR(formats::CheckNotTheSameFile(job.input, output));
      return read_.CheckNotReplacedBy(output);
    };
    RETURN_IF_ERROR(check(job.output));
    RETURN_IF_ERROR(check(SummaryPath(job.output)));
    return job.csv.empty() ? absl::OkStatus() : check(job.csv);
  }

  std::string DoneText() const {
    return absl::StrCat(done_, " of ", jobs_.size(), " files are done",
                        failed_ > 0 ? absl::StrCat(", ", failed_, " failed") : "",
                        "; run again with --resume to continue");
  }

  const AnnotationRun& run_;
  OutputSettings settings_;
  const std::vector<Job>& jobs_;
  formats::FilesRead read_;  // Inputs, and all other files that the run reads.
  FileProgress progress_;
  RunVerdict verdict_;
  std::size_t done_ = 0, failed_ = 0;
};

}  // namespace

absl::Status AnnotateFiles(const std::vector<Job>& jobs, const AnnotationRun& run, const client::TableSummary& table) {
  Note(absl::StrCat("table ", table.id, " ", table.version, ", digest ", table.digest));
  return Run(run, table, jobs)();
}

}  // namespace albtpu::annotate
