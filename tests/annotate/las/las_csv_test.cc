#include "annotate/las/las_csv.h"

#include <gtest/gtest.h>

#include <cstring>

#include "laz/coding/little_endian.h"

namespace albtpu::annotate {
namespace {

using laz::Store;

constexpr std::size_t kRecord = 30, kAnnotated = kRecord + 8;  // Of point format 6 with two floats.

formats::LasHeader Header() {
  formats::LasHeader header;
  header.point_format = 6;
  header.record_length = kRecord;
  header.scale = {0.01, 0.01, 0.001};
  header.offset = {500000, 0.5, 0};
  return header;
}

std::string Record(float thu, float tvu) {
  std::string record(kAnnotated, '\0');
  Store(std::int32_t{12345}, record.data());
  Store(std::int32_t{-7}, record.data() + 4);
  Store(std::int32_t{-23456}, record.data() + 8);
  record[16] = 40;
  Store(123456789.0123456, record.data() + 22);
  Store(thu, record.data() + kRecord);
  Store(tvu, record.data() + kRecord + 4);
  return record;
}

TEST(LasCsv, HasTheDigitsOfTheFile) {
  const LasCsv csv(Header(), LasPlace(), {.coverage = Coverage::kP95, .total = true});
  EXPECT_EQ(csv.head(), "gps_time [s],x [m],y [m],z [m],total_thu [m; 95 %],total_tvu [m; 95 %],class\n");
  std::string text;
  csv.Append(Record(0.5f, 0.25f) + Record(-1, -1), 2, kRecord, kAnnotated, text);
  EXPECT_EQ(text,
            "123456789.0123456,500123.45,0.43,-23.456,0.5,0.25,40\n"
            "123456789.0123456,500123.45,0.43,-23.456,,,40\n");
}

TEST(LasCsv, WritesStepsThatAreNoDecimalsSoThatTheyReadBack) {
  formats::LasHeader header = Header();
  header.scale[0] = 1.0 / 3;
  const LasCsv csv(header, LasPlace(), {});
  std::string text;
  csv.Append(Record(1, 1), 1, kRecord, kAnnotated, text);
  const std::size_t begin = text.find(',') + 1;
  EXPECT_EQ(std::stod(text.substr(begin)), 12345 * (1.0 / 3) + 500000);
}

TEST(LasCsv, NamesTheUnitOfHeights) {
  LasPlace place;
  place.frame.metres_per_z = 0.3048;
  const LasCsv csv(Header(), place, {.coverage = Coverage::kOneSigma});
  EXPECT_EQ(csv.head(), "gps_time [s],x [ft],y [ft],z [ft],sea_thu [m; 1 sigma],sea_tvu [m; 1 sigma],class\n");
}

}  // namespace
}  // namespace albtpu::annotate
