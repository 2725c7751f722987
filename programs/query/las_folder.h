// What the terminal shows for many files together: one table, and each note once.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "annotate/las/las_annotation.h"

namespace albtpu::programs {

// Notes of files that differ in their numbers alone, as one line each: "incidence 15.3 to 16.9 ... 23.3 to 24.7
// degrees", where numbers differ the least and the greatest.
class NotesOfFiles {
 public:
  void Add(const std::string& file, const std::vector<std::string>& notes);
  // In the order in which they first occur. A note that only some files have names them.
  std::vector<std::string> Lines() const;

 private:
  struct Note {
    std::vector<std::string> words;            // Between the numbers: one more than these.
    std::vector<std::string> least, greatest;  // As they were written.
    std::vector<std::string> files;
  };
  std::vector<Note> notes_;
  std::size_t files_ = 0;
};

// Sums over the files of a folder.
class LasFolder {
 public:
  void Add(const std::string& file, const annotate::AnnotatedLas& annotated);
  std::size_t files() const { return files_; }
  // "17175 points, 10065 bathymetric, 9954 with a total; THU ...; order 1b at 100.0 %": of one file.
  static std::string LineOf(const annotate::AnnotatedLas& annotated, S44Order order);
  // Of all: the table by depth, dry points, `assumed` and the notes.
  std::string Text(Coverage coverage, S44Order order, const std::vector<std::string>& assumed) const;

 private:
  std::size_t files_ = 0;
  annotate::TotalSummary totals_;
  annotate::DrySummary dry_;
  NotesOfFiles notes_;
};

}  // namespace albtpu::programs
