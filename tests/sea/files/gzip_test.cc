#include <gmock/gmock.h>
#include <zlib.h>

#include <string>

#include "sea/files/sea_csv.h"

namespace albtpu {
namespace {

using ::testing::HasSubstr;

std::string Compressed(std::string text) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  std::string bytes(deflateBound(&stream, text.size()) + 32, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(text.data());
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  deflate(&stream, Z_FINISH);
  bytes.resize(stream.total_out);
  deflateEnd(&stream);
  return bytes;
}

TEST(Gzip, InflatesOneStreamOrSeveral) {
  const std::string text(200'000, 'x');
  EXPECT_TRUE(IsGzip(Compressed(text)));
  EXPECT_FALSE(IsGzip("#YY"));
  EXPECT_EQ(*Inflated(Compressed(text)), text);
  EXPECT_EQ(*Inflated(Compressed("one ") + Compressed("two")), "one two");
  EXPECT_EQ(*Inflated(Compressed("")), "");
}

TEST(Gzip, RefusesStreamsThatWereCutOrDamaged) {
  const std::string bytes = Compressed("0.12 0.34 0.56 0.78 0.90 0.12 0.35");
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THAT(std::string(Inflated(bytes.substr(0, size)).status().message()), HasSubstr("end early")) << size;
  std::string damaged = bytes;
  damaged[damaged.size() - 6] ^= 1;  // of the checksum
  EXPECT_THAT(std::string(Inflated(damaged).status().message()), HasSubstr("damaged"));
  EXPECT_THAT(std::string(Inflated(bytes + "rest").status().message()), HasSubstr("damaged"));
}

TEST(Gzip, RefusesMoreThanItsLimit) {
  const std::string bytes = Compressed(std::string(1'000'000, '\0'));
  EXPECT_LT(bytes.size(), 2000u);
  EXPECT_THAT(std::string(Inflated(bytes, 999'999).status().message()), HasSubstr("more than 999999 bytes"));
  EXPECT_TRUE(Inflated(bytes, 1'000'000).ok());
}

}  // namespace
}  // namespace albtpu
