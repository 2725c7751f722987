#include "service/error_message.h"

#include <array>
#include <string>

namespace albtpu {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

// The field of each source, which a test holds to be there.
const FieldDescriptor* FieldOf(std::size_t i) {
  static const std::array<const FieldDescriptor*, kErrorSourceCount> fields = [] {
    std::array<const FieldDescriptor*, kErrorSourceCount> found = {};
    for (std::size_t k = 0; k < kErrorSourceCount; ++k)
      found[k] = v1::AirErrors::descriptor()->FindFieldByName(std::string(kErrorSources[k].name));
    return found;
  }();
  return fields[i];
}

// Calls `each` with each number of `errors`, the message that has it, and its field there.
void ForEachNumber(auto& errors, Message& message, auto each) {
  for (std::size_t k = 0; k < kErrorSourceCount; ++k) {
    const FieldDescriptor* const field = FieldOf(k);
    const auto numbers = kErrorSources[k].In(errors);
    if (numbers.size() == 1) {
      each(numbers[0], message, field);
      continue;
    }
    Message& parts = *message.GetReflection()->MutableMessage(&message, field);
    for (int i = 0; i < static_cast<int>(numbers.size()); ++i) each(numbers[i], parts, field->message_type()->field(i));
  }
}

}  // namespace

v1::AirErrors ToMessage(const AirErrors& errors) {
  v1::AirErrors message;
  ForEachNumber(errors, message, [](double number, Message& of, const FieldDescriptor* field) {
    of.GetReflection()->SetDouble(&of, field, number);
  });
  return message;
}

AirErrors FromMessage(v1::AirErrors message) {
  AirErrors errors;
  ForEachNumber(errors, message, [](double& number, const Message& of, const FieldDescriptor* field) {
    number = of.GetReflection()->GetDouble(of, field);
  });
  return errors;
}

}  // namespace albtpu
