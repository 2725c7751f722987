// Finds the library function that one of our functions replaces.
#pragma once

#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <typeinfo>

namespace albtpu::sanitizers {

// The function with this (mangled) name in the next library that has one. Aborts if there is none: the reports of
// ThreadSanitizer would then be meaningless.
template <typename Function>
Function* NextFunction(const char* name) {
  void* const function = dlsym(RTLD_NEXT, name);
  if (function == nullptr) {
    std::fprintf(stderr, "tests/sanitizers: no library has %s; expected the libraries of Debian 12 or 13\n", name);
    std::abort();
  }
  return reinterpret_cast<Function*>(function);
}

// A member function of `Class` whose mangled name ends with `ending`; namespaces may differ between versions.
template <typename Class, typename Function>
Function* NextMember(const char* ending) {
  const std::string of_class = typeid(Class).name();  // N...E
  return NextFunction<Function>(("_Z" + of_class.substr(0, of_class.size() - 1) + ending).c_str());
}

}  // namespace albtpu::sanitizers
