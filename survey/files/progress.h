// How far a long work on files is, for people, on standard error.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace albtpu::client {

// All files of one run. On a terminal a bar with the rate and the time left, redrawn in place and wiped after
// each file. Elsewhere a plain line every ten seconds, so that short works say nothing and logs stay short.
class Progress {
 public:
  // `records` is what they hold, for people: "points". `total_bytes` of all files; 0 when it is not known,
  // and then nothing is shown.
  Progress(std::string records, std::size_t file_count, std::uint64_t total_bytes);

  // Goes to the next of the files, or the first.
  void NextFile() { ++file_; }

  // The file at hand has `bytes` and needs no work.
  void Skip(std::uint64_t bytes);

  std::uint64_t records() const { return records_before_; }  // Of the files that ended.
  double seconds() const;

  // The work on the file at hand, from here to the end of its scope.
  class File {
   public:
    File(Progress& run, std::string name);
    ~File();
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    // So many bytes and records of this file are done.
    void Reach(std::uint64_t bytes, std::uint64_t records);

   private:
    Progress& run_;
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
  std::size_t file_ = 0;                                 // From 1.
  std::uint64_t bytes_before_ = 0, records_before_ = 0;  // Of the files that ended.
  bool drawn_ = false;
};

// "3.12 million points/s", for people.
std::string RateText(std::uint64_t records, double seconds, const std::string& record_name);

}  // namespace albtpu::client
