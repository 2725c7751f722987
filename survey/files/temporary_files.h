// The temporary files that must not outlive the program, whatever ends it.
#pragma once

#include <string>

namespace albtpu::client {

// Registers `path` for removal while this object lives: when a signal (HUP, INT, TERM) ends the program, the
// file goes first. The destructor only forgets it.
class RemovedOnSignal {
 public:
  explicit RemovedOnSignal(const std::string& path);
  ~RemovedOnSignal();
  RemovedOnSignal(const RemovedOnSignal&) = delete;
  RemovedOnSignal& operator=(const RemovedOnSignal&) = delete;

 private:
  int slot_;
};

}  // namespace albtpu::client
