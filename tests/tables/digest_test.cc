#include "tables/digest.h"

#include <gtest/gtest.h>

namespace albtpu {
namespace {

std::string HexOf(std::string_view text) {
  Sha256 sha;
  sha.Update(text);
  return Hex(sha.Finish());
}

// FIPS 180-4, examples of SHA-256.
TEST(Digest, IsSha256) {
  EXPECT_EQ(HexOf(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(HexOf("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(HexOf("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST(Digest, DoesNotDependOnHowBytesAreSplit) {
  Sha256 sha;
  sha.Update("a");
  sha.Update("");
  sha.Update("bc");
  EXPECT_EQ(Hex(sha.Finish()), HexOf("abc"));
}

}  // namespace
}  // namespace albtpu
