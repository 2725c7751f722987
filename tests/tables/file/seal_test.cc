#include "tables/file/seal.h"

#include <gmock/gmock.h>

namespace albtpu {
namespace {

using ::testing::HasSubstr;

std::string Sealed(std::size_t length = 700) {
  std::string file(length, 'x');
  seal::Apply(file);
  return file;
}

void ExpectDataLoss(const std::string& file, const std::string& message) {
  const absl::Status status = seal::Check(file);
  EXPECT_EQ(status.code(), absl::StatusCode::kDataLoss);
  EXPECT_THAT(std::string(status.message()), HasSubstr(message));
}

TEST(Seal, AcceptsTheFileThatItWasMadeFor) {
  EXPECT_TRUE(seal::Check(Sealed()).ok());
  EXPECT_TRUE(seal::Check(Sealed(seal::kSize)).ok());
}

TEST(Seal, HasTheSpecifiedLayout) {
  const std::string file = Sealed(0x0201 + 512);
  EXPECT_EQ(file.substr(0, 8),
            "\x89"
            "ALBTPU\n");
  EXPECT_EQ(file.substr(8, 8), std::string("\1\0\0\0\0\0\0\0", 8));
  EXPECT_EQ(file.substr(16, 8), std::string("\1\4\0\0\0\0\0\0", 8));
  EXPECT_EQ(file.substr(56, 456), std::string(456, '\0'));
  EXPECT_EQ(file.substr(512), std::string(0x0201, 'x'));
}

// Every flipped bit: bit_flips_test.cc and the fuzz target.
TEST(Seal, DetectsEveryTruncation) {
  const std::string whole = Sealed(520);
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_EQ(seal::Check(whole.substr(0, length)).code(), absl::StatusCode::kDataLoss) << length;
}

TEST(Seal, ReportsWhatIsWrong) {
  const std::string whole = Sealed(700);
  ExpectDataLoss("", "is empty");
  ExpectDataLoss("wind_speed,depth\n5,10\n", "does not begin with its seal");
  ExpectDataLoss("\x89HDF\r\n\x1a\n" + std::string(600, '\0'), "HDF5 file without the seal");
  ExpectDataLoss(whole.substr(0, 5), "is truncated: it has 5 bytes");
  ExpectDataLoss(whole.substr(0, 600), "is truncated: it has 600 of its 700 bytes");
  ExpectDataLoss(whole + "x", "has 701 bytes, and its seal says 700");
  std::string changed = whole;
  changed[650] = 'y';
  ExpectDataLoss(changed, "do not have the SHA-256");
  std::string text = whole;  // as a transfer in text mode changes it
  text.insert(text.find('\n'), "\r");
  ExpectDataLoss(text, "does not begin with its seal");
}

TEST(Seal, NamesAVersionThatItCannotRead) {
  std::string newer = Sealed();
  newer[seal::kVersionOffset] = 2;
  const absl::Status status = seal::Check(newer);
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(status.message(), "has format version 2: this program reads version 1");
}

TEST(Seal, RecognizesAnotherFormatByItsFirstBytes) {
  EXPECT_EQ(seal::CheckHeader(std::string(seal::kSize, 'z'), std::uint64_t{1} << 40).code(),
            absl::StatusCode::kDataLoss);
}

}  // namespace
}  // namespace albtpu
