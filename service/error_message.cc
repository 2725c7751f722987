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

}  // namespace

v1::AirErrors ToMessage(const AirErrors& errors) {
  v1::AirErrors message;
  for (std::size_t k = 0; k < kErrorSourceCount; ++k) {
    const FieldDescriptor* const field = FieldOf(k);
    const std::span<const double> numbers = kErrorSources[k].In(errors);
    if (numbers.size() == 1) {
      message.GetReflection()->SetDouble(&message, field, numbers[0]);
      continue;
    }
    Message& parts = *message.GetReflection()->MutableMessage(&message, field);
    for (int i = 0; i < static_cast<int>(numbers.size()); ++i)
      parts.GetReflection()->SetDouble(&parts, field->message_type()->field(i), numbers[i]);
  }
  return message;
}

AirErrors FromMessage(const v1::AirErrors& message) {
  AirErrors errors;
  for (std::size_t k = 0; k < kErrorSourceCount; ++k) {
    const FieldDescriptor* const field = FieldOf(k);
    const std::span<double> numbers = kErrorSources[k].In(errors);
    if (numbers.size() == 1) {
      numbers[0] = message.GetReflection()->GetDouble(message, field);
      continue;
    }
    const Message& parts = message.GetReflection()->GetMessage(message, field);
    for (int i = 0; i < static_cast<int>(numbers.size()); ++i)
      numbers[i] = parts.GetReflection()->GetDouble(parts, field->message_type()->field(i));
  }
  return errors;
}

}  // namespace albtpu
