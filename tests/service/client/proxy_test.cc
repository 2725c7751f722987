#include "service/client/proxy.h"

#include <gtest/gtest.h>

#include <map>

namespace albtpu::client {
namespace {

using Variables = std::map<std::string, std::string>;

Environment In(const Variables& variables) {
  return [&variables](const char* name) -> const char* {
    const auto found = variables.find(name);
    return found != variables.end() ? found->second.c_str() : nullptr;
  };
}

std::string UrlFor(const std::string& address, const Variables& variables) {
  const std::optional<Proxy> proxy = ProxyFor(address, In(variables));
  return proxy.has_value() ? proxy->variable + " " + proxy->url : "";
}

TEST(Proxy, IsNeverUsedForThisMachine) {
  const Variables all = {
      {"grpc_proxy", "http://p:1"}, {"https_proxy", "http://p:1"}, {"http_proxy", "http://p:1"}, {"HTTP_PROXY", "x"}};
  for (const char* address :
       {"127.0.0.1:5", "127.8.9.1:5", "localhost:5", "LocalHost:5", "[::1]:5", "ipv6:[::1]:5", "dns:///localhost:5",
        "dns://8.8.8.8/localhost:5", "dns:127.0.0.1:5", "ipv4:127.0.0.1:5,127.0.0.2:5", "[::ffff:127.0.0.1]:5",
        "unix:/run/albtpu", "unix:///run/albtpu", "unix-abstract:albtpu"})
    EXPECT_EQ(UrlFor(address, all), "") << address;
  for (const char* address :
       {"128.0.0.1:5", "lidar.example:5", "localhost.example:5", "[2001:db8::1]:5", "dns:///lidar.example:5",
        "ipv4:127.0.0.1:5,10.0.0.1:5", "[::ffff:10.0.0.1]:5", "unix7.example:5", "unix-host:5"})
    EXPECT_EQ(UrlFor(address, all), "grpc_proxy http://p:1") << address;
}

TEST(Proxy, IsTheFirstVariableThatIsSet) {
  EXPECT_EQ(UrlFor("h:5", {}), "");
  EXPECT_EQ(UrlFor("h:5", {{"HTTP_PROXY", "http://p:1"}}), "");  // As in gRPC.
  EXPECT_EQ(UrlFor("h:5", {{"http_proxy", "http://p:1"}}), "http_proxy http://p:1");
  EXPECT_EQ(UrlFor("h:5", {{"http_proxy", "http://p:1"}, {"https_proxy", "http://q:2/"}}), "https_proxy http://q:2");
  EXPECT_EQ(UrlFor("h:5", {{"http_proxy", "http://p:1"}, {"grpc_proxy", ""}}), "");
  EXPECT_EQ(UrlFor("h:5", {{"http_proxy", "socks5://p:1"}}), "");
}

TEST(Proxy, IsNamedWithoutItsPassword) {
  for (const char* url : {"http://me:se@cret@p:1", "http://me:se/cret@p:1/"})
    EXPECT_EQ(UrlFor("h:5", {{"http_proxy", url}}), "http_proxy http://p:1");
}

TEST(Proxy, IsLeftOutForListedHosts) {
  const auto left_out = [](const std::string& address, const std::string& list) {
    return UrlFor(address, {{"http_proxy", "http://p:1"}, {"no_proxy", list}}).empty();
  };
  EXPECT_TRUE(left_out("lidar.example:5", "a, .example"));
  EXPECT_TRUE(left_out("lidar.example:5", "LIDAR.example"));
  EXPECT_TRUE(left_out("lidar.example:5", "*"));
  EXPECT_TRUE(left_out("10.1.2.3:5", "10.0.0.0/8"));
  EXPECT_TRUE(left_out("[fd00::2]:5", "fd00::/8"));
  EXPECT_FALSE(left_out("lidar.example:5", "example.org,,"));
  EXPECT_FALSE(left_out("11.1.2.3:5", "10.0.0.0/8"));
  EXPECT_FALSE(left_out("[fe00::2]:5", "fd00::/8"));
  EXPECT_FALSE(left_out("lidar.example:5", "10.0.0.0/8"));
  EXPECT_EQ(UrlFor("h:5", {{"http_proxy", "http://p:1"}, {"no_proxy", "h"}, {"no_grpc_proxy", ""}}),
            "http_proxy http://p:1");
}

}  // namespace
}  // namespace albtpu::client
