// What is wrong with a request as a whole, field by field: details of the error (google.rpc.BadRequest) for
// programs, beside the message for people.
#pragma once

#include <string_view>

#include "absl/status/status.h"
#include "google/rpc/error_details.pb.h"

namespace albtpu::server {

class FieldViolations {
 public:
  // `field` is a path in the request, such as `pulses.depth`; `description` says what is wrong and what would
  // be right, and names the field for itself.
  void Add(std::string_view field, std::string_view description);

  // OK without any. Else INVALID_ARGUMENT with the description of the first as message; all of them are its
  // details.
  absl::Status ToStatus() const;

 private:
  google::rpc::BadRequest request_;
};

// INVALID_ARGUMENT because of one field.
absl::Status FieldViolation(std::string_view field, std::string_view description);

// The same error of a request that is the field `outer` of another: its fields are `outer.FIELD`.
absl::Status Within(std::string_view outer, const absl::Status& status);

}  // namespace albtpu::server
