#include "service/client/channel.h"

#include <gmock/gmock.h>
#include <openssl/crypto.h>
#include <unistd.h>

#include <cstdlib>

#include "tests/service/client/running_server.h"
#include "tests/temporary_folder.h"

namespace albtpu::client {
namespace {

using ::testing::HasSubstr;

class ChannelCredentials : public ::testing::Test {
 protected:
  std::string File(const std::string& name, const std::string& text) { return folder_.Write(name, text); }

  static std::string Problem(const Credentials& credentials) {
    return std::string(MakeCredentials(credentials).status().message());
  }

  albtpu::testing::TemporaryFolder folder_;
};

TEST_F(ChannelCredentials, ArePlainTextWithoutFiles) {
  EXPECT_FALSE(Credentials().HasTls());
  EXPECT_TRUE(MakeCredentials({}).ok());
}

TEST_F(ChannelCredentials, UseTlsIfAnyFileIsGiven) {
  EXPECT_TRUE(Credentials{.ca = "ca.pem"}.HasTls());
  EXPECT_TRUE((Credentials{.certificate = "me.pem", .key = "me.key"}.HasTls()));
  EXPECT_TRUE(Credentials{.token = "token"}.HasTls());
}

TEST_F(ChannelCredentials, NameTheFileThatIsWrong) {
  const std::string junk = File("junk", "junk"), two = File("two", "one\ntwo\n"), none = File("none", "\n");
  EXPECT_THAT(Problem({.ca = folder_ / "nowhere"}), HasSubstr("nowhere: No such file"));
  EXPECT_THAT(Problem({.ca = junk}),
              HasSubstr("--tls-ca: " + junk + " has no CERTIFICATE; give a PEM file that has one"));
  EXPECT_THAT(Problem({.certificate = junk, .key = junk}), HasSubstr("--tls-key"));
  const std::string key = File("key", "-----BEGIN PRIVATE KEY-----\n");
  EXPECT_THAT(Problem({.certificate = key, .key = key}), HasSubstr("--tls-cert: " + key + " has no CERTIFICATE"));
  EXPECT_THAT(Problem({.certificate = key}), HasSubstr("--tls-cert and --tls-key: one is missing"));
  EXPECT_THAT(Problem({.token = two}), HasSubstr("--token-file: " + two + " has more than one token"));
  EXPECT_THAT(Problem({.token = none}), HasSubstr(none + " has no token"));
}

TEST_F(ChannelCredentials, MayBeATokenAlone) {
  EXPECT_TRUE(MakeCredentials({.token = File("token", "c0ffee\n")}).ok());
}

TEST(ServerHealth, IsOkWhileTheServerServes) {
  const RunningServer server;
  EXPECT_TRUE(CheckHealth(server.address()).ok());
}

// Threads of gRPC may still use OpenSSL when a program ends. A handler that is registered before OpenSSL's own would
// run after it.
TEST(OpenSsl, IsUsableUntilTheProcessIsGone) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto use_and_exit = [] {
    std::atexit([] { _exit(OPENSSL_init_crypto(0, nullptr) == 1 ? 0 : 3); });
    (void)OPENSSL_init_crypto(OPENSSL_INIT_LOAD_CRYPTO_STRINGS, nullptr);
    std::exit(1);
  };
  EXPECT_EXIT(use_and_exit(), ::testing::ExitedWithCode(0), "");
}

TEST(ServerHealth, IsOkWhenOneOfSeveralServersServes) {
  RunningServer first;
  const RunningServer second;
  first.Stop();
  EXPECT_TRUE(CheckHealth(AllOf({first.address(), second.address()})).ok());
}

TEST(ServerHealth, ReportsTheProblem) {
  RunningServer server;
  const std::string address = server.address();
  server.Stop();
  const absl::Status gone = CheckHealth(address);
  EXPECT_EQ(gone.code(), absl::StatusCode::kUnavailable);
  EXPECT_THAT(std::string(gone.message()), HasSubstr(address));
  const absl::Status no_file = CheckHealth(address, {.ca = "nowhere.pem"});
  EXPECT_THAT(std::string(no_file.message()), HasSubstr("--tls-ca: nowhere.pem"));
}

}  // namespace
}  // namespace albtpu::client
