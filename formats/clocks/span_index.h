// Which of many files have records at given times, without looking at the others.
#pragma once

#include <cstddef>
#include <vector>

#include "formats/clocks/trajectory_time.h"

namespace albtpu::formats {

// The times of files, in the order of their beginnings. Immutable.
class SpanIndex {
 public:
  SpanIndex() = default;
  // Span i is that of file i. Requires first <= last.
  explicit SpanIndex(const std::vector<TimeSpan>& spans);

  bool empty() const { return entries_.empty(); }
  // From the first beginning to the last end. Requires that there is a span.
  TimeSpan extent() const { return {entries_.front().span.first, entries_.back().latest_end}; }

  // Appends the files whose spans meet `times`, in no order. Takes the logarithm of the number of files and the number
  // of those that are found, where few files overlap each other.
  void Find(const TimeSpan& times, std::vector<std::size_t>& files) const;

 private:
  struct Entry {
    TimeSpan span;
    std::size_t file = 0;
    double latest_end = 0;  // Of this entry and those before it.
  };
  std::vector<Entry> entries_;
};

}  // namespace albtpu::formats
