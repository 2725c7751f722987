// Finds the library function that one of our functions replaces.
#pragma once

#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>

namespace albtpu::sanitizers {

// The function with this (mangled) name in the next library that has one. Aborts if there is none: the reports of
// ThreadSanitizer would then be meaningless.
template <typename Function>
Function* NextFunction(const char* name) {
  void* const function = dlsym(RTLD_NEXT, name);
  if (function == nullptr) {
    std::fprintf(stderr, "tests/sanitizers: no library has %s; expected the libraries of Debian 12\n", name);
    std::abort();
  }
  return reinterpret_cast<Function*>(function);
}

}  // namespace albtpu::sanitizers
