// Flips bits of a small table: the file is refused or the flip is harmless, and no answer ever changes. It tries each
// bit of the seal, one of each byte that the seal is a digest of, and every 31st if the flip is made before the file is
// sealed; or all of them, which takes minutes: ALBTPU_EVERY_BIT=1 bit_flips_test
#include <gmock/gmock.h>
#include <hdf5.h>

#include <cstdlib>
#include <iostream>
#include <string>

#include "tables/file/seal.h"
#include "tables/file/table_encoder.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu {
namespace {

constexpr std::size_t kUserBlockBits = 8 * seal::kSize;

// Our smallest table: one or two nodes on each axis, without biases and standard errors.
UncertaintyTable SmallTable() {
  testing::TableParts parts = testing::PartsOf(testing::TinyTable());
  for (const Quantity quantity : kQuantities) {
    parts[quantity].standard_errors.clear();
    if (Describe(quantity).is_bias) parts.variables[Index(quantity)].reset();
  }
  return parts.Create().value();
}

bool EveryBit() { return std::getenv("ALBTPU_EVERY_BIT") != nullptr; }

void Flip(std::string& file, std::size_t bit) { file[bit / 8] = static_cast<char>(file[bit / 8] ^ (1 << bit % 8)); }

TEST(BitFlips, InASealedFileAreAllRefused) {
  std::string file = EncodeTable(SmallTable()).value();
  ASSERT_TRUE(DecodeTable(file).ok());
  const auto next = [](std::size_t bit) {
    if (bit + 1 < kUserBlockBits || EveryBit()) return bit + 1;
    const std::size_t byte = bit / 8 + 1;
    return 8 * byte + byte % 8;
  };
  for (std::size_t bit = 0; bit < 8 * file.size(); bit = next(bit)) {
    Flip(file, bit);
    ASSERT_FALSE(DecodeTable(file).ok()) << "byte " << bit / 8 << " bit " << bit % 8;
    Flip(file, bit);
  }
  EXPECT_TRUE(DecodeTable(file).ok());
}

// A computer with faulty memory can write such a file: the seal matches damaged content. If the file is accepted, the
// content digest, computed anew, shows that it gives the answers of the table.
TEST(BitFlips, BeforeTheSealWasMadeChangeNoAnswer) {
  const UncertaintyTable table = SmallTable();
  const std::string file = EncodeTable(table).value();
  const std::size_t stride = EveryBit() ? 1 : 61;
  std::size_t refused = 0, harmless = 0;
  for (std::size_t bit = kUserBlockBits; bit < 8 * file.size(); bit += stride) {
    std::string flipped = file;
    Flip(flipped, bit);
    seal::Apply(flipped);
    const absl::StatusOr<UncertaintyTable> decoded = DecodeTable(flipped);
    ASSERT_EQ(H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL), 0) << "byte " << bit / 8 << " bit " << bit % 8;
    if (!decoded.ok()) {
      ++refused;
      continue;
    }
    ++harmless;
    ASSERT_EQ(decoded->digest(), table.digest()) << "byte " << bit / 8 << " bit " << bit % 8;
    for (const Quantity quantity : kQuantities) {
      const Variable* variable = table.variable(quantity);
      ASSERT_EQ(decoded->variable(quantity) == nullptr, variable == nullptr);
      if (variable == nullptr) continue;
      ASSERT_EQ(decoded->variable(quantity)->values, variable->values);
      ASSERT_EQ(decoded->variable(quantity)->standard_errors, variable->standard_errors);
      ASSERT_EQ(decoded->variable(quantity)->scale, variable->scale);
    }
    for (const AxisId axis : kAxes) ASSERT_EQ(decoded->axis(axis).nodes(), table.axis(axis).nodes());
  }
  EXPECT_GT(refused, 0u);
  EXPECT_GT(harmless, 0u);  // Half of the bytes that HDF5 writes are unused space.
  std::cout << refused << " flips refused, " << harmless << " harmless\n";
  EXPECT_EQ(DecodeTable(file)->digest(), table.digest());  // None of the earlier files is read in its place.
}

// HDF5 loses track of objects whose beginning is damaged, and would report them at exit.
TEST(BitFlips, AreNotReportedAtTheEndOfTheProgram) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto refuse_and_exit = [] {
    const std::string file = EncodeTable(SmallTable()).value();
    for (std::size_t bit = kUserBlockBits; bit < kUserBlockBits + 8 * 1024; bit += 31) {
      std::string flipped = file;
      Flip(flipped, bit);
      seal::Apply(flipped);
      (void)DecodeTable(flipped);
    }
    std::exit(0);
  };
  EXPECT_EXIT(refuse_and_exit(), ::testing::ExitedWithCode(0), ::testing::IsEmpty());
}

}  // namespace
}  // namespace albtpu
