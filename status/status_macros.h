// Passing errors on: what a function that returns absl::Status or absl::StatusOr does with the error of one that it
// calls. Both return from the function that they stand in, and so are macros; the names are common beside Abseil.
//
// The arguments of a call may hold commas, those of a declaration only in parentheses: a type such as std::map<A, B> is
// written auto.
#pragma once

#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"  // IWYU pragma: export

#define ALBTPU_JOINED(a, b) a##b
#define ALBTPU_NAME(prefix, number) ALBTPU_JOINED(prefix, number)

// RETURN_IF_ERROR(file.Write(text)); returns the error, if it is one.
#define RETURN_IF_ERROR(...) ALBTPU_RETURN_IF_ERROR(ALBTPU_NAME(status_, __COUNTER__), __VA_ARGS__)
#define ALBTPU_RETURN_IF_ERROR(status, ...)                               \
  do {                                                                    \
    if (absl::Status status = (__VA_ARGS__); !status.ok()) return status; \
  } while (false)

// ASSIGN_OR_RETURN(const Table table, ReadTable(path)); declares or assigns what a call returns, or returns its error.
// Two statements: in braces after if and for.
#define ASSIGN_OR_RETURN(declaration, ...) \
  ALBTPU_ASSIGN_OR_RETURN(ALBTPU_NAME(result_, __COUNTER__), declaration, __VA_ARGS__)
#define ALBTPU_ASSIGN_OR_RETURN(result, declaration, ...) \
  auto result = (__VA_ARGS__);                            \
  if (!result.ok()) return std::move(result).status();    \
  declaration = *std::move(result)
