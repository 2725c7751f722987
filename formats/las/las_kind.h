// LAS, or LAZ: the same with compressed points.
#pragma once

#include <string>
#include <string_view>

namespace albtpu::formats {

enum class LasKind { kLas, kLaz };

constexpr std::string_view Name(LasKind kind) { return kind == LasKind::kLas ? "LAS" : "LAZ"; }

// ".las"
inline std::string Extension(LasKind kind) { return kind == LasKind::kLas ? ".las" : ".laz"; }

}  // namespace albtpu::formats
