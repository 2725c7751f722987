// The pulses of `QueryColumns`: columns of single precision numbers, read where they lie.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string>

#include "absl/status/statusor.h"
#include "albtpu/v1/pulse.pb.h"
#include "tables/interpolation.h"
#include "tables/schema.h"

namespace albtpu::server {

static_assert(std::endian::native == std::endian::little, "columns are copied as they are on the wire");

// Refers to the message that it was read from.
class PulseColumns {
 public:
  // Fails as `QueryColumns` documents.
  static absl::StatusOr<PulseColumns> Read(const v1::PulseColumns& columns);

  std::size_t size() const { return size_; }
  bool azimuth_absent() const { return columns_[Index(AxisId::kAzimuth)].absent(); }

  Pulse operator[](std::size_t i) const {
    Pulse pulse{.wind_speed = Column(AxisId::kWindSpeed)[i],
                .incidence = Column(AxisId::kIncidence)[i],
                .azimuth = {},
                .footprint = Column(AxisId::kFootprint)[i],
                .depth = Column(AxisId::kDepth)[i]};
    if (!Column(AxisId::kFetch).absent()) pulse.fetch = Column(AxisId::kFetch)[i];
    if (!azimuth_absent()) pulse.azimuth = Column(AxisId::kAzimuth)[i];
    return pulse;
  }

 private:
  // Floats side by side, or one for all.
  class FloatColumn {
   public:
    FloatColumn() = default;
    explicit FloatColumn(const std::string& bytes)
        : begin_(bytes.data()), stride_(bytes.size() == sizeof(float) ? 0 : sizeof(float)) {}

    bool absent() const { return begin_ == nullptr; }

    float operator[](std::size_t i) const {
      float value;  // The bytes need not be aligned.
      std::memcpy(&value, begin_ + i * stride_, sizeof value);
      return value;
    }

   private:
    const char* begin_ = nullptr;
    std::size_t stride_ = 0;
  };

  PulseColumns() = default;

  const FloatColumn& Column(AxisId axis) const { return columns_[Index(axis)]; }

  std::array<FloatColumn, kAxisCount> columns_;
  std::size_t size_ = 0;
};

}  // namespace albtpu::server
