// What a run over files says on standard error: how far it has come, and why it failed, with the exit code.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "formats/text/text.h"

namespace albtpu::annotate {

// Failures of the program: one message on standard error, and the exit code: 0 when every pulse got an outcome, and of
// the pulses in files at least half a number, 2 for bad usage, 1 for any other failure.

// A message for the user reads
//     PROBLEM (WHY); SUGGESTION
// on one line and in plain English: what is wrong, and with which file, line, column, flag or server; in
// parentheses the detail that explains it; after the semicolon what to do about it. Leave out empty phrases. The file
// or flag comes first, before a colon:
//     in.csv line 4, column 'depth': 'deep' is not a number; write a number in m, such as 12.5

// The message of `status`, followed by `; FIELD: DESCRIPTION` for each field violation (google.rpc.BadRequest)
// in the details of a server's error that the message does not mention yet.
std::string MessageWithDetails(const absl::Status& status);

// Prints the message of a failure to standard error and returns the exit code; an OK status prints nothing.
int Report(const absl::Status& status);

// Prints `albtpu-query: MESSAGE` to standard error, followed by `below`. The message may quote a server or a file
// name, so it is made printable and put on one line; `below` is our own text and is printed unchanged.
void Note(std::string_view message, const std::string& below = "");

// Reports on standard error how far a long run over files has come.

// Covers all files of one run. On a terminal it shows a bar with the rate and the time left on one line, which is
// redrawn in place and erased after each file. Elsewhere it prints a line every minute, so that short runs print
// nothing and logs stay short.
class FileProgress {
 public:
  // `records` names what the files contain: "points". `total_bytes` is the size of all files, or 0 if it is not known;
  // then no progress is shown.
  FileProgress(std::string records, std::size_t file_count, std::uint64_t total_bytes);

  // Moves on to the next file; the first call, to the first.
  void NextFile() { ++file_; }

  // The current file has `bytes` and needs no work.
  void Skip(std::uint64_t bytes);

  std::uint64_t records() const { return records_before_; }  // In the files that are finished.
  double seconds() const;

  // The work on the current file, from construction to destruction.
  class File {
   public:
    File(FileProgress& run, std::string name);
    ~File();
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    // `bytes` and `records` of this file are done.
    void Reach(std::uint64_t bytes, std::uint64_t records);

   private:
    FileProgress& run_;
    std::string label_;
    std::uint64_t bytes_ = 0, records_ = 0;
  };

 private:
  using Clock = std::chrono::steady_clock;

  void Show(const std::string& label, std::uint64_t bytes, std::uint64_t records);

  std::string record_name_;
  std::size_t file_count_;
  std::uint64_t total_bytes_;
  bool terminal_;
  Clock::time_point start_, last_shown_;
  std::size_t file_ = 0;                                 // The current file, counted from 1.
  std::uint64_t bytes_before_ = 0, records_before_ = 0;  // In the files that are finished.
  bool drawn_ = false;
};

// "3.12 million points/s", "18300 points/s"
std::string RateText(std::uint64_t records, double seconds, const std::string& record_name);

}  // namespace albtpu::annotate
