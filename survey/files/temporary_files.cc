#include "survey/files/temporary_files.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <csignal>
#include <cstring>

namespace albtpu::client {
namespace {

// A signal handler may neither allocate nor lock, so names live in fixed places. Two are enough for every
// command; a program that writes more files at once than there are slots loses only the removal.
struct Slot {
  std::atomic<bool> taken = false;  // By a RemovedOnSignal.
  std::atomic<bool> armed = false;  // `path` is complete.
  char path[PATH_MAX];
};
constexpr int kSlots = 8;
std::array<Slot, kSlots> slots;

extern "C" void RemoveTemporariesAndEnd(int signal) {
  for (Slot& slot : slots) {
    if (slot.armed) unlink(slot.path);
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void InstallHandlers() {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    struct sigaction action = {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_DFL) continue;  // `nohup` wants HUP ignored.
    action.sa_handler = RemoveTemporariesAndEnd;
    sigaction(signal, &action, nullptr);
  }
}

}  // namespace

RemovedOnSignal::RemovedOnSignal(const std::string& path) : slot_(-1) {
  static const bool installed = (InstallHandlers(), true);
  static_cast<void>(installed);
  if (path.size() >= PATH_MAX) return;
  for (int i = 0; i < kSlots; ++i) {
    if (slots[i].taken.exchange(true)) continue;
    std::memcpy(slots[i].path, path.c_str(), path.size() + 1);
    slots[i].armed = true;
    slot_ = i;
    return;
  }
}

RemovedOnSignal::~RemovedOnSignal() {
  if (slot_ < 0) return;
  slots[slot_].armed = false;
  slots[slot_].taken = false;
}

}  // namespace albtpu::client
