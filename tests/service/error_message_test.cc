#include "service/error_message.h"

#include <gtest/gtest.h>

#include <string>

namespace albtpu {
namespace {

TEST(ErrorMessage, HasAFieldForEachSourceAndForEachOfItsNumbers) {
  const google::protobuf::Descriptor& message = *v1::AirErrors::descriptor();
  EXPECT_EQ(message.field_count(), static_cast<int>(kErrorSourceCount));
  for (const ErrorSource& source : kErrorSources) {
    const google::protobuf::FieldDescriptor* field = message.FindFieldByName(std::string(source.name));
    ASSERT_NE(field, nullptr) << source.name;
    const google::protobuf::Descriptor* parts = field->message_type();
    ASSERT_EQ(parts != nullptr, source.size() > 1) << source.name;
    for (std::size_t i = 0; i < source.size() && parts != nullptr; ++i)
      EXPECT_EQ(parts->field(static_cast<int>(i))->name(), source.parts[i]) << source.name;
  }
}

TEST(ErrorMessage, KeepsEachNumber) {
  AirErrors errors;
  double next = 1;
  for (const ErrorSource& source : kErrorSources)
    for (double& number : source.In(errors)) number = next++;
  const v1::AirErrors message = ToMessage(errors);
  EXPECT_EQ(message.boresight().right(), errors.boresight[1]);
  EXPECT_EQ(message.surface_range(), errors.surface_range);
  const AirErrors read = FromMessage(message);
  for (const ErrorSource& source : kErrorSources)
    for (std::size_t i = 0; i < source.size(); ++i) EXPECT_EQ(source.In(read)[i], source.In(errors)[i]);
}

TEST(ErrorMessage, IsOfNoErrorsWhereFieldsAreAbsent) {
  const AirErrors read = FromMessage(v1::AirErrors());
  for (const ErrorSource& source : kErrorSources)
    for (const double number : source.In(read)) EXPECT_EQ(number, 0);
}

}  // namespace
}  // namespace albtpu
