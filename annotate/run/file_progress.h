// Reports on standard error how far a long run over files has come.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace albtpu::annotate {

// Covers all files of one run. On a terminal it shows a bar with the rate and the time left, which is redrawn in place
// and erased after each file. Elsewhere it prints a line every ten seconds, so that short runs print nothing and logs
// stay short.
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

// "3.12 million points/s"
std::string RateText(std::uint64_t records, double seconds, const std::string& record_name);

}  // namespace albtpu::annotate
