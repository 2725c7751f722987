#include "service/client/proxy.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/strings/strip.h"

namespace albtpu::client {
namespace {

constexpr char kHttp[] = "http://";

// An address as 16 bytes, IPv4 as ::ffff:a.b.c.d.
std::optional<std::array<std::uint8_t, 16>> ParseIp(const std::string& text) {
  std::array<std::uint8_t, 16> bytes{};
  if (inet_pton(AF_INET6, text.c_str(), bytes.data()) == 1) return bytes;
  bytes[10] = bytes[11] = 0xFF;
  if (inet_pton(AF_INET, text.c_str(), bytes.data() + 12) == 1) return bytes;
  return std::nullopt;
}

// Whether a network, "10.0.0.0/8", has an address.
bool IsInNetwork(const std::string& host, const std::string& network) {
  const std::vector<std::string> parts = absl::StrSplit(network, '/');
  const auto address = ParseIp(host), first = ParseIp(parts.front());
  int bits = 0;
  if (parts.size() != 2 || !address.has_value() || !first.has_value() || !absl::SimpleAtoi(parts[1], &bits))
    return false;
  if (absl::StrContains(parts[0], '.')) bits += 96;
  for (int i = 0; i < std::min(bits, 128); ++i) {
    const auto at = static_cast<std::size_t>(i / 8);
    if (((*address)[at] ^ (*first)[at]) >> (7 - i % 8) & 1) return false;
  }
  return true;
}

bool IsLoopback(const std::string& host) {
  return absl::EqualsIgnoreCase(host, "localhost") || IsInNetwork(host, "127.0.0.0/8") || IsInNetwork(host, "::1/128");
}

// The hosts of an address, without brackets. None for a socket of this machine.
std::vector<std::string> HostsOf(absl::string_view address) {
  if (absl::StartsWith(address, "unix:") || absl::StartsWith(address, "unix-abstract:")) return {};
  if (absl::ConsumePrefix(&address, "dns:") && absl::ConsumePrefix(&address, "//"))
    address.remove_prefix(std::min(address.find('/') + 1, address.size()));  // The name server.
  absl::ConsumePrefix(&address, "ipv4:") || absl::ConsumePrefix(&address, "ipv6:");
  std::vector<std::string> hosts;
  for (const absl::string_view each : absl::StrSplit(address, ',')) {
    absl::string_view host = each.substr(0, each.rfind(':'));
    if (absl::ConsumePrefix(&host, "[")) absl::ConsumeSuffix(&host, "]");
    hosts.emplace_back(host);
  }
  return hosts;
}

bool IsListed(const std::string& host, const char* list) {
  const std::vector<std::string> entries = absl::StrSplit(list, ',', absl::SkipWhitespace());
  return std::ranges::any_of(entries, [&](const std::string& each) {
    const std::string entry(absl::StripAsciiWhitespace(each));
    return entry == "*" || IsInNetwork(host, entry) || absl::EndsWithIgnoreCase(host, entry);
  });
}

}  // namespace

std::optional<Proxy> ProxyFor(std::string_view address, const Environment& environment) {
  const std::vector<std::string> hosts = HostsOf({address.data(), address.size()});
  if (std::ranges::all_of(hosts, IsLoopback)) return std::nullopt;
  const char* list = environment("no_grpc_proxy");
  if (list == nullptr) list = environment("no_proxy");
  if (list != nullptr && std::ranges::all_of(hosts, [&](const std::string& host) { return IsListed(host, list); }))
    return std::nullopt;
  for (const char* variable : {"grpc_proxy", "https_proxy", "http_proxy"}) {
    const char* value = environment(variable);
    if (value == nullptr) continue;
    absl::string_view rest = value;
    if (!absl::ConsumePrefix(&rest, kHttp) || rest.empty()) return std::nullopt;
    rest.remove_prefix(rest.rfind('@') + 1);  // A password may have any characters.
    return Proxy{absl::StrCat(kHttp, rest.substr(0, rest.find('/'))), variable};
  }
  return std::nullopt;
}

std::string ProxyText(std::string_view address) {
  const std::optional<Proxy> proxy = ProxyFor(address);
  return proxy.has_value() ? absl::StrCat(" (through the proxy ", proxy->url, ", from ", proxy->variable, ")") : "";
}

}  // namespace albtpu::client
