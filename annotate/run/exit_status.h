// Failures of the program: one message on standard error, and the exit code: 0 when every pulse got an outcome, and of
// the pulses in files at least half a number, 2 for bad usage, 1 for any other failure.
#pragma once

#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "formats/text/usage_error.h"

namespace albtpu::annotate {

// A message for the user reads
//     PROBLEM (WHY); SUGGESTION
// on one line and in plain English: what is wrong, and with which file, line, column, flag or server; in
// parentheses the detail that explains it; after the semicolon what to do about it. Leave out empty phrases. The file
// or flag comes first, before a colon:
//     in.csv line 4, column 'depth': 'deep' is not a number; write a number in m, such as 12.5

// The message of `status`, followed by `; FIELD: DESCRIPTION` for each field violation (google.rpc.BadRequest)
// in the details of a server's error that the message does not mention yet.
std::string MessageWithDetails(const absl::Status& status);

// Prints the message of a failure to standard error and returns the exit code; an OK status prints nothing.
int Report(const absl::Status& status);

// Prints `albtpu-query: MESSAGE` to standard error, followed by `below`. The message may quote a server or a file
// name, so it is made printable and put on one line; `below` is our own text and is printed unchanged.
void Note(std::string_view message, const std::string& below = "");

}  // namespace albtpu::annotate
