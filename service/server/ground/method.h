// The methods that the log and the metrics know.
#pragma once

#include <array>
#include <cstddef>

namespace albtpu::server {

enum class Method { kQueryPulses, kQueryColumns, kStreamColumns, kListTables, kGetTable, kReloadTables };

inline constexpr std::array<const char*, 6> kMethodNames = {"QueryPulses", "QueryColumns", "StreamColumns",
                                                            "ListTables",  "GetTable",     "ReloadTables"};

constexpr std::size_t Index(Method method) { return static_cast<std::size_t>(method); }
constexpr const char* Name(Method method) { return kMethodNames[Index(method)]; }

}  // namespace albtpu::server
