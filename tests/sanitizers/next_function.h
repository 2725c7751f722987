// The function of a library behind one of ours that stands before it.
#pragma once

#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>

namespace albtpu::sanitizers {

// That of the next library that has a function with this (mangled) name. Ends the program where none has: a report
// of ThreadSanitizer would mean nothing then.
template <typename Function>
Function* NextFunction(const char* name) {
  void* const function = dlsym(RTLD_NEXT, name);
  if (function == nullptr) {
    std::fprintf(stderr, "tests/sanitizers: no library has %s: those of Debian 12 are right\n", name);
    std::abort();
  }
  return reinterpret_cast<Function*>(function);
}

}  // namespace albtpu::sanitizers
