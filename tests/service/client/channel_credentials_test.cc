#include "service/client/channel_credentials.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/temporary_folder.h"

namespace albtpu::client {
namespace {

using ::testing::HasSubstr;

class ChannelCredentials : public ::testing::Test {
 protected:
  std::string File(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  static std::string Problem(const Credentials& credentials) {
    return std::string(MakeCredentials(credentials).status().message());
  }

  albtpu::testing::TemporaryFolder folder_;
};

TEST_F(ChannelCredentials, AreNoneForPlainText) {
  EXPECT_FALSE(Credentials().HasTls());
  EXPECT_TRUE(MakeCredentials({}).ok());
}

TEST_F(ChannelCredentials, MeanTlsWhicheverIsGiven) {
  EXPECT_TRUE(Credentials{.ca = "ca.pem"}.HasTls());
  EXPECT_TRUE((Credentials{.certificate = "me.pem", .key = "me.key"}.HasTls()));
  EXPECT_TRUE(Credentials{.token = "token"}.HasTls());
}

TEST_F(ChannelCredentials, NameTheFileThatIsNotRight) {
  const std::string junk = File("junk", "junk"), two = File("two", "one\ntwo\n"), none = File("none", "\n");
  EXPECT_THAT(Problem({.ca = folder_ / "nowhere"}), HasSubstr("nowhere: No such file"));
  EXPECT_THAT(Problem({.ca = junk}),
              HasSubstr("--tls-ca: " + junk + ": a PEM file with a CERTIFICATE is right"));
  EXPECT_THAT(Problem({.certificate = junk, .key = junk}), HasSubstr("--tls-key"));
  const std::string key = File("key", "-----BEGIN PRIVATE KEY-----\n");
  EXPECT_THAT(Problem({.certificate = key, .key = key}), HasSubstr("--tls-cert: " + key + ": a PEM file"));
  EXPECT_THAT(Problem({.certificate = key}), HasSubstr("--tls-cert and --tls-key: both are right"));
  EXPECT_THAT(Problem({.token = two}), HasSubstr("--token-file: " + two + ": one token"));
  EXPECT_THAT(Problem({.token = none}), HasSubstr("one token"));
}

TEST_F(ChannelCredentials, TakeATokenAlone) {
  EXPECT_TRUE(MakeCredentials({.token = File("token", "c0ffee\n")}).ok());
}

}  // namespace
}  // namespace albtpu::client
