#include "formats/clocks/span_index.h"

#include <algorithm>

namespace albtpu::formats {

SpanIndex::SpanIndex(const std::vector<TimeSpan>& spans) {
  entries_.reserve(spans.size());
  for (std::size_t i = 0; i < spans.size(); ++i) entries_.push_back({spans[i], i, spans[i].last});
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.span.first < b.span.first; });
  for (std::size_t i = 1; i < entries_.size(); ++i)
    entries_[i].latest_end = std::max(entries_[i].latest_end, entries_[i - 1].latest_end);
}

void SpanIndex::Find(const TimeSpan& times, std::vector<std::size_t>& files) const {
  auto entry = std::upper_bound(entries_.begin(), entries_.end(), times.last,
                                [](double last, const Entry& each) { return last < each.span.first; });
  // Going back, none is left to meet the times where no end is late enough.
  while (entry != entries_.begin() && (entry - 1)->latest_end >= times.first) {
    --entry;
    if (entry->span.last >= times.first) files.push_back(entry->file);
  }
}

}  // namespace albtpu::formats
