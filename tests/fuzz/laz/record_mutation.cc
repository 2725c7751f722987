#include "tests/fuzz/laz/record_mutation.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace albtpu::fuzz {
namespace {

struct Field {
  std::size_t offset, size;
};

// x, y, z, intensity, returns, flags, class, scan angle, user data, source, time; LAS Specification 1.4 R15.
constexpr Field kLegacyFields[] = {{0, 4},  {4, 4},  {8, 4},  {12, 2}, {14, 1}, {15, 1}, {16, 1},
                                   {17, 1}, {18, 2}, {20, 8}, {20, 8}, {20, 2}, {22, 2}, {24, 2}};
constexpr Field kModernFields[] = {{0, 4},  {4, 4},  {8, 4},  {12, 2}, {14, 1}, {15, 1}, {16, 1}, {17, 1},
                                   {18, 2}, {20, 2}, {22, 8}, {22, 8}, {30, 2}, {32, 2}, {34, 2}, {36, 2}};

Field AnyField(std::minstd_rand& random, int point_format, std::size_t record_length) {
  Field field = point_format < 6 ? kLegacyFields[random() % std::size(kLegacyFields)]
                                 : kModernFields[random() % std::size(kModernFields)];
  if (random() % 3 == 0) field = {random() % record_length, std::size_t{1} << random() % 4};
  field.offset = std::min(field.offset, record_length - 1);
  field.size = std::min(field.size, record_length - field.offset);
  return field;
}

// Small steps, powers of two and numbers beside them, and anything; of either sign.
std::uint64_t AnyStep(std::minstd_rand& random) {
  std::uint64_t step = random() % 16;
  switch (random() % 4) {
    case 0:
      step = (std::uint64_t{1} << random() % 64) + random() % 3 - 1;
      break;
    case 1:
      step = random() >> random() % 32;
      break;
    case 2:
      step = (std::uint64_t{random()} << 32 | random()) >> random() % 64;
      break;
  }
  return random() % 2 == 0 ? step : 0 - step;
}

std::uint64_t Number(const char* record, const Field& field) {
  std::uint64_t number = 0;
  std::memcpy(&number, record + field.offset, field.size);
  return number;
}

void Store(std::uint64_t number, char* record, const Field& field) {
  std::memcpy(record + field.offset, &number, field.size);
}

}  // namespace

void ChangeRecords(std::minstd_rand& random, int point_format, std::size_t record_length, std::size_t most,
                   std::string& records) {
  const std::size_t count = records.size() / record_length, at = random() % count;
  const auto record = [&](std::size_t i) { return records.data() + i * record_length; };
  const Field field = AnyField(random, point_format, record_length);
  const std::uint64_t step = AnyStep(random);
  switch (random() % 8) {
    case 0:  // A point like another, maybe an earlier one.
      if (count < most)
        records.insert(at * record_length, records.substr(random() % count * record_length, record_length));
      return;
    case 1:
      if (count > 1) records.erase(at * record_length, record_length);
      return;
    case 2:  // A step that lasts.
      for (std::size_t i = at; i < count; ++i) Store(Number(record(i), field) + step, record(i), field);
      return;
    case 3:  // A steady change.
      for (std::size_t i = at; i < count; ++i) Store(Number(record(at), field) + (i - at) * step, record(i), field);
      return;
    case 4:  // A value that returns.
      Store(Number(record(random() % count), field), record(at), field);
      return;
    case 5:  // Different in every point.
      for (std::size_t i = at; i < count; ++i) Store(AnyStep(random), record(i), field);
      return;
    case 6:
      Store(step, record(at), field);
      return;
    default:
      Store(Number(record(at), field) + step, record(at), field);
  }
}

}  // namespace albtpu::fuzz
