#include <gmock/gmock.h>

#include "service/server/access/credentials.h"

namespace albtpu::server {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr char kToken[] = "c0ffee00c0ffee00c0ffee00c0ffee00";
constexpr char kOther[] = "AZaz09-._~+/AZaz09-._~+/==";

std::string Problem(std::string_view text) { return std::string(Tokens::Parse(text).status().message()); }

TEST(Tokens, AcceptOnlyTheTokensOfTheirFile) {
  const Tokens tokens = Tokens::Parse(kToken).value();
  EXPECT_TRUE(tokens.Accept("Bearer c0ffee00c0ffee00c0ffee00c0ffee00"));
  for (const char* wrong : {"", "Bearer", "Bearer ", "c0ffee00c0ffee00c0ffee00c0ffee00",
                            "Basic c0ffee00c0ffee00c0ffee00c0ffee00", "Bearer c0ffee00c0ffee00c0ffee00c0ffee01",
                            "Bearer c0ffee00c0ffee00c0ffee00c0ffee0", "Bearer c0ffee00c0ffee00c0ffee00c0ffee000",
                            "Bearer C0FFEE00C0FFEE00C0FFEE00C0FFEE00", "Bearer  c0ffee00c0ffee00c0ffee00c0ffee00"})
    EXPECT_FALSE(tokens.Accept(wrong)) << wrong;
}

TEST(Tokens, AcceptTheSchemeInAnyCase) {  // RFC 7235, 2.1
  EXPECT_TRUE(Tokens::Parse(kToken)->Accept("bearer c0ffee00c0ffee00c0ffee00c0ffee00"));
}

TEST(Tokens, MayBeSeveral) {
  const Tokens tokens = Tokens::Parse(std::string("\n") + kToken + "\r\n  " + kOther + "\n\n").value();
  EXPECT_TRUE(tokens.Accept(std::string("Bearer ") + kToken));
  EXPECT_TRUE(tokens.Accept(std::string("Bearer ") + kOther));
}

TEST(Tokens, MustExistAndBeHardToGuess) {
  EXPECT_THAT(Problem(" \n\n"), HasSubstr("openssl rand"));
  EXPECT_THAT(Problem(std::string(kToken) + "\nshort\n"), HasSubstr("line 2 has 5 characters"));
}

TEST(Tokens, AreNotRepeatedInErrors) {
  const std::string problem = Problem("two words that are long enough");
  EXPECT_THAT(problem, HasSubstr("line 1 is not a token"));
  EXPECT_THAT(problem, Not(HasSubstr("words")));
}

}  // namespace
}  // namespace albtpu::server
