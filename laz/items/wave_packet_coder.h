// Wave packets: the place of the waveform of a pulse in the file, and of the point on the waveform.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "laz/coding/integer_coder.h"
#include "laz/coding/little_endian.h"

namespace albtpu::laz {

inline constexpr std::size_t kWavePacketSize = 29;  // Bytes in a record.

struct WavePacket {
  std::uint8_t descriptor = 0;
  std::uint64_t offset = 0;
  std::uint32_t size = 0;
  // Floats in the record, of which only the bits are coded: the point's place, and the beam's direction.
  std::int32_t return_point = 0;
  std::array<std::int32_t, 3> direction{};
};

// Requires kWavePacketSize bytes.
inline WavePacket LoadWavePacket(std::string_view bytes) {
  WavePacket packet;
  packet.descriptor = Load<std::uint8_t>(bytes, 0);
  packet.offset = Load<std::uint64_t>(bytes, 1);
  packet.size = Load<std::uint32_t>(bytes, 9);
  packet.return_point = Load<std::int32_t>(bytes, 13);
  for (std::size_t i = 0; i < 3; ++i) packet.direction[i] = Load<std::int32_t>(bytes, 17 + 4 * i);
  return packet;
}

inline void StoreWavePacket(const WavePacket& packet, char* destination) {
  Store(packet.descriptor, destination);
  Store(packet.offset, destination + 1);
  Store(packet.size, destination + 9);
  Store(packet.return_point, destination + 13);
  for (std::size_t i = 0; i < 3; ++i) Store(packet.direction[i], destination + 17 + 4 * i);
}

template <typename Coder>
class WavePacketCoder {
 public:
  void Forget() {
    last_step_ = 0;
    last_advance_ = kSame;
    descriptors_.Forget();
    for (auto& model : advances_) model.Forget();
    steps_.Forget();
    sizes_.Forget();
    return_points_.Forget();
    directions_.Forget();
  }

  // Decodes the packet that follows `last`, or encodes `packet`; returns it.
  [[gnu::always_inline]] WavePacket Code(Coder& coder, const WavePacket& last, WavePacket packet) {
    packet.descriptor = static_cast<std::uint8_t>(coder.Symbol(descriptors_, packet.descriptor));
    packet.offset = CodeOffset(coder, last, packet.offset);
    packet.size = static_cast<std::uint32_t>(
        sizes_.Code(coder, static_cast<std::int32_t>(last.size), static_cast<std::int32_t>(packet.size)));
    packet.return_point = return_points_.Code(coder, last.return_point, packet.return_point);
    for (std::uint32_t i = 0; i < 3; ++i)
      packet.direction[i] = directions_.Code(coder, last.direction[i], packet.direction[i], i);
    return packet;
  }

 private:
  // How the offset advances.
  static constexpr std::uint32_t kSame = 0, kBehindLast = 1, kByStep = 2, kAnywhere = 3;

  [[gnu::always_inline]] std::uint64_t CodeOffset(Coder& coder, const WavePacket& last, std::uint64_t offset) {
    const std::uint64_t step = offset - last.offset;
    last_advance_ = coder.Symbol(advances_[last_advance_], Coder::kEncodes ? Advance(step, last.size) : 0);
    if (last_advance_ == kSame) return last.offset;
    if (last_advance_ == kBehindLast) return last.offset + last.size;
    if (last_advance_ == kAnywhere) return coder.Bits64(offset);
    last_step_ = steps_.Code(coder, last_step_, static_cast<std::int32_t>(step));
    return last.offset + static_cast<std::uint64_t>(std::int64_t{last_step_});
  }

  static std::uint32_t Advance(std::uint64_t step, std::uint32_t last_size) {
    if (step == 0) return kSame;
    // LASzip takes sizes from 2^31 on for negative when it encodes, but not when it decodes: they are avoided here.
    if (step == last_size && step <= 0x7FFFFFFF) return kBehindLast;
    const bool fits = step == static_cast<std::uint64_t>(std::int64_t{static_cast<std::int32_t>(step)});
    return fits ? kByStep : kAnywhere;
  }

  std::int32_t last_step_ = 0;
  std::uint32_t last_advance_ = kSame;
  typename Coder::template Model<256> descriptors_;
  std::array<typename Coder::template Model<4>, 4> advances_;
  IntegerCoder<Coder, 32, 1> steps_, sizes_, return_points_;
  IntegerCoder<Coder, 32, 3> directions_;
};

}  // namespace albtpu::laz
