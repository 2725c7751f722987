#include "service/error_message.h"

#include <cassert>
#include <string>

namespace albtpu {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

// Null for a source that the message lacks, which a test excludes.
const FieldDescriptor* FieldOf(const ErrorSource& source) {
  const FieldDescriptor* field = v1::AirErrors::descriptor()->FindFieldByName(std::string(source.name));
  assert(field != nullptr && (source.size() == 1) == (field->message_type() == nullptr));
  return field;
}

}  // namespace

v1::AirErrors ToMessage(const AirErrors& errors) {
  v1::AirErrors message;
  for (const ErrorSource& source : kErrorSources) {
    const FieldDescriptor* const field = FieldOf(source);
    const std::span<const double> numbers = source.In(errors);
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
  for (const ErrorSource& source : kErrorSources) {
    const FieldDescriptor* const field = FieldOf(source);
    const std::span<double> numbers = source.In(errors);
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
