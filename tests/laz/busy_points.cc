#include "tests/laz/busy_points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "tests/formats/las/las_builder.h"

namespace albtpu::testing {
namespace {

// The fields of a point of any format, and their bytes in a LAS record, by the tables of the specification.
struct WavePacketFields {
  std::uint8_t descriptor = 0;
  std::uint64_t offset = 0;
  std::uint32_t size = 0;
  float return_location = 0;
  std::array<float, 3> direction{};
};

struct PointFields {
  std::int32_t x = 0, y = 0, z = 0;
  std::uint16_t intensity = 0;
  std::uint32_t return_number = 1, return_count = 1;  // Of which formats 0-5 have 3 bits, 6-10 have 4.
  bool scan_direction = false, edge = false;
  std::uint32_t classification = 0;  // 5 or 8 bits
  std::uint32_t flags = 0;           // 3 or 4 bits: synthetic, key point, withheld, overlap
  std::uint32_t channel = 0;         // 2 bits, in formats 6-10.
  std::int16_t scan_angle = 0;       // 0.006 degree; formats 0-5 have whole degrees.
  std::uint8_t user_data = 0;
  std::uint16_t source = 0;
  std::uint64_t time_bits = 0;             // Of a double, any.
  std::array<std::uint16_t, 4> colours{};  // red, green, blue, near infrared
  WavePacketFields wave_packet;
};

// LAS is little-endian, like the machines that this runs on.
template <typename Number>
void Append(Number number, std::string& bytes) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

void AppendByte(std::uint32_t byte, std::string& bytes) { bytes.push_back(static_cast<char>(byte)); }

void AppendLegacyCore(const PointFields& point, std::string& bytes) {
  AppendByte((point.return_number & 7) | (point.return_count & 7) << 3 | point.scan_direction << 6 | point.edge << 7,
             bytes);
  AppendByte((point.classification & 31) | (point.flags & 7) << 5, bytes);
  AppendByte(static_cast<std::uint8_t>(std::lround(point.scan_angle * 0.006)), bytes);
  AppendByte(point.user_data, bytes);
  Append(point.source, bytes);
}

void AppendCore(const PointFields& point, std::string& bytes) {
  AppendByte((point.return_number & 15) | (point.return_count & 15) << 4, bytes);
  AppendByte((point.flags & 15) | (point.channel & 3) << 4 | point.scan_direction << 6 | point.edge << 7, bytes);
  AppendByte(point.classification, bytes);
  AppendByte(point.user_data, bytes);
  Append(point.scan_angle, bytes);
  Append(point.source, bytes);
}

void AppendWavePacket(const WavePacketFields& packet, std::string& bytes) {
  AppendByte(packet.descriptor, bytes);
  Append(packet.offset, bytes);
  Append(packet.size, bytes);
  Append(packet.return_location, bytes);
  for (const float component : packet.direction) Append(component, bytes);
}

// Appends the fields that the format (0 to 10) has.
void AppendFields(const PointFields& point, int point_format, std::string& records) {
  Append(point.x, records);
  Append(point.y, records);
  Append(point.z, records);
  Append(point.intensity, records);
  point_format < 6 ? AppendLegacyCore(point, records) : AppendCore(point, records);
  if (point_format != 0 && point_format != 2) Append(point.time_bits, records);
  const bool has_colour = point_format == 2 || point_format == 3 || point_format == 5 || point_format == 7 ||
                          point_format == 8 || point_format == 10;
  const bool has_infrared = point_format == 8 || point_format == 10;
  for (int i = 0; i < (has_infrared ? 4 : has_colour ? 3 : 0); ++i) Append(point.colours[i], records);
  const bool has_wave_packet = point_format == 4 || point_format == 5 || point_format == 9 || point_format == 10;
  if (has_wave_packet) AppendWavePacket(point.wave_packet, records);
}

// SplitMix64 (Steele et al., 2014, doi:10.1145/2714064.2660195).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15u) {}

  std::uint64_t Bits() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
    z = (z ^ z >> 27) * 0x94D049BB133111EBu;
    return z ^ z >> 31;
  }
  std::uint32_t Below(std::uint32_t end) { return static_cast<std::uint32_t>(Bits() % end); }
  bool OneIn(std::uint32_t many) { return Below(many) == 0; }
  // A number near 0, seldom of more bits: as differences of neighbours are.
  std::int32_t Step(int most_bits) {
    const int bits = static_cast<int>(Below(static_cast<std::uint32_t>(most_bits) + 1));
    const auto magnitude = static_cast<std::uint32_t>(Bits() & ((std::uint64_t{1} << bits) - 1));
    return static_cast<std::int32_t>(OneIn(2) ? magnitude : 0u - magnitude);
  }

 private:
  std::uint64_t state_;
};

std::int32_t Moved(std::int32_t from, std::int32_t by) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(from) + static_cast<std::uint32_t>(by));
}

class BusySurvey {
 public:
  explicit BusySurvey(std::uint64_t seed) : random_(seed) {
    for (Flight& flight : flights_) NextPulse(flight);
  }

  const PointFields& Next() {
    // For some hundred points the same fields stay.
    if (random_.OneIn(300)) staying_ = random_.Below(256);
    if (random_.OneIn(2)) flight_ = random_.Below(kFlights);
    Flight& flight = flights_[flight_];
    NextReturn(flight);
    MovePoint(flight);
    ChangeAttributes();
    if (!Stays(1)) ChangeColours();
    if (!Stays(2)) ChangeWavePacket();
    return point_;
  }

  void AppendExtraBytes(std::size_t count, std::string& records) {
    extra_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      auto& byte = extra_[i];
      if (Stays(3)) continue;
      if (i % 4 == 0) byte = static_cast<char>(random_.Bits());
      if (i % 4 == 1) ++byte;
      if (i % 4 == 2 && random_.OneIn(50)) byte = static_cast<char>(random_.Below(3));
      if (i % 4 == 3) byte = static_cast<char>(byte + random_.Step(4));
    }
    records += extra_;
  }

 private:
  static constexpr std::uint32_t kFlights = 6;  // Pulses of which returns are still to come.

  struct Flight {
    double time = 1e300;  // Begins anew.
    std::uint32_t return_number = 0, return_count = 0, channel = 0;
    std::int32_t x = 0, y = 0, z = 0;
  };

  bool Stays(int field) const { return staying_ >> field & 1; }

  void NextPulse(Flight& flight) {
    flight.return_number = 0;
    flight.return_count = random_.OneIn(3) ? 1 + random_.Below(15) : 1 + random_.Below(3);
    flight.channel = random_.OneIn(5) ? random_.Below(4) : flight.channel;
    if (!(std::fabs(flight.time) < 1e10)) flight.time = 2e8 + random_.Below(100000);
    const std::uint32_t kind = random_.Below(40);
    if (kind == 0)
      flight.time = flights_[random_.Below(kFlights)].time;
    else if (kind == 1)
      flight.time += random_.Step(31);
    else if (kind == 2)
      flight.time = std::bit_cast<double>(random_.Bits());
    else if (kind == 3)
      flight.time -= 2.5e-5;
    else if (kind == 4)
      flight.time += 1e-5 * random_.Step(30);
    else if (kind == 6)
      flight.time += 0.01;
    else if (kind != 5)  // 5: the same time once more.
      flight.time += 1e-5 * (1 + random_.Below(20));
  }

  void NextReturn(Flight& flight) {
    if (flight.return_number >= flight.return_count) NextPulse(flight);
    ++flight.return_number;
    point_.return_number = random_.OneIn(200) ? random_.Below(16) : flight.return_number;
    point_.return_count = random_.OneIn(200) ? random_.Below(16) : flight.return_count;
    point_.channel = flight.channel;
    point_.time_bits = std::bit_cast<std::uint64_t>(flight.time);
  }

  void MovePoint(Flight& flight) {
    const bool far = random_.OneIn(400);
    if (!Stays(4)) {
      flight.x = far ? static_cast<std::int32_t>(random_.Bits()) : Moved(flight.x, 40 + random_.Step(9));
      flight.y = far ? static_cast<std::int32_t>(random_.Bits()) : Moved(flight.y, random_.Step(16));
    }
    if (!Stays(5)) flight.z = far ? static_cast<std::int32_t>(random_.Bits()) : Moved(flight.z, random_.Step(12));
    point_.x = flight.x;
    point_.y = flight.y;
    point_.z = flight.z;
  }

  void ChangeAttributes() {
    if (!Stays(6)) point_.intensity = static_cast<std::uint16_t>(point_.intensity + random_.Step(16));
    if (random_.OneIn(4)) point_.classification = random_.OneIn(9) ? random_.Below(256) : random_.Below(20);
    if (random_.OneIn(10)) point_.flags = random_.Below(16);
    if (random_.OneIn(20)) point_.scan_direction = !point_.scan_direction;
    point_.edge = random_.OneIn(30);
    if (!Stays(7)) {
      const int steps = point_.scan_angle + (random_.OneIn(3) ? random_.Step(15) : random_.Step(3));
      point_.scan_angle = static_cast<std::int16_t>(std::clamp(steps, -20000, 20000));
    }
    if (random_.OneIn(5)) point_.user_data = static_cast<std::uint8_t>(random_.OneIn(2) ? random_.Bits() : 7);
    if (random_.OneIn(50)) point_.source = static_cast<std::uint16_t>(random_.OneIn(2) ? random_.Bits() : 1 + flight_);
  }

  void ChangeColours() {
    auto& [red, green, blue, infrared] = point_.colours;
    const auto change_bytes = [&](std::uint16_t& colour) {
      if (random_.OneIn(2)) colour = static_cast<std::uint16_t>(colour ^ (random_.Bits() & 0xFF));
      if (random_.OneIn(3)) colour = static_cast<std::uint16_t>(colour ^ (random_.Bits() & 0xFF00));
    };
    const std::uint32_t kind = random_.Below(6);
    if (kind == 1 || kind == 2) change_bytes(red);
    if (kind == 0 || kind == 1) green = blue = red;
    if (kind == 3)
      for (auto* colour : {&red, &green, &blue}) *colour = static_cast<std::uint16_t>(*colour + random_.Step(16));
    if (kind == 4) {
      change_bytes(green);
      change_bytes(blue);
    }
    if (random_.OneIn(3)) change_bytes(infrared);
  }

  void ChangeWavePacket() {
    WavePacketFields& packet = point_.wave_packet;
    switch (random_.Below(8)) {
      case 0:
        packet.offset = random_.Bits();
        break;
      case 1:
        packet.offset += static_cast<std::uint64_t>(std::int64_t{random_.Step(31)});
        break;
      case 2:
      case 3:
        break;
      default:
        packet.offset += packet.size;
    }
    if (random_.OneIn(3)) packet.size = random_.OneIn(9) ? random_.Below(1u << 31) : 256 + random_.Below(3);
    if (random_.OneIn(10)) packet.descriptor = static_cast<std::uint8_t>(random_.Bits());
    packet.return_location += static_cast<float>(random_.Step(12)) * 0.37f;
    for (float& component : packet.direction) {
      component = random_.OneIn(100) ? std::bit_cast<float>(static_cast<std::uint32_t>(random_.Bits()))
                                     : component + static_cast<float>(random_.Step(5)) * 1e-6f;
    }
  }

  Random random_;
  std::array<Flight, kFlights> flights_;
  std::uint32_t flight_ = 0, staying_ = 0;
  PointFields point_;
  std::string extra_;
};

class CalmFlightLine {
 public:
  explicit CalmFlightLine(std::uint64_t seed) : random_(seed), first_x_(static_cast<std::int32_t>(seed % 1000)) {
    point_.return_number = point_.return_count = 0;
    point_.source = 12;
    point_.wave_packet = {.descriptor = 1, .offset = 60, .size = 0, .direction = {1e-4f, 2e-4f, -0.15f}};
  }

  const PointFields& Next() {
    if (point_.return_number >= point_.return_count) NextPulse();
    ++point_.return_number;
    const bool last = point_.return_number == point_.return_count;
    point_.z = last ? -5000 + random_.Step(5) : 200 + random_.Step(10);
    point_.intensity = static_cast<std::uint16_t>(last ? 300 + random_.Below(40) : 80 + random_.Below(30));
    point_.classification = last ? 2 : 5;
    const auto grey = static_cast<std::uint16_t>(256 * (100 + random_.Below(12)));
    point_.colours = {grey, static_cast<std::uint16_t>(grey + 512), static_cast<std::uint16_t>(grey - 256), 30720};
    point_.wave_packet.return_location = 1000.0f + 350.0f * static_cast<float>(point_.return_number);
    return point_;
  }

  void AppendExtraBytes(std::size_t count, std::string& records) {
    for (std::size_t i = 0; i < count; ++i)
      records.push_back(static_cast<char>(i % 2 == 0 ? i : 40 + random_.Below(4)));
  }

 private:
  static constexpr int kPulsesPerLine = 600;
  static constexpr double kPulseInterval = 1e-5;  // s

  void NextPulse() {
    const auto [line, place] = std::div(pulse_++, kPulsesPerLine);
    const int across = line % 2 == 0 ? place : kPulsesPerLine - 1 - place;
    point_.return_number = 0;
    point_.return_count = random_.OneIn(4) ? 2 + random_.Below(2) : 1;
    point_.scan_direction = line % 2 == 0;
    point_.edge = place == kPulsesPerLine - 1;
    point_.scan_angle = static_cast<std::int16_t>((across - kPulsesPerLine / 2) * 11);
    point_.x = first_x_ + across * 250 + random_.Step(3);
    point_.y = line * 400 + random_.Step(3);
    point_.time_bits = std::bit_cast<std::uint64_t>(3e8 + kPulseInterval * pulse_);
    point_.wave_packet.offset += point_.wave_packet.size;
    point_.wave_packet.size = 160;
  }

  Random random_;
  std::int32_t first_x_;
  int pulse_ = 0;
  PointFields point_;
};

template <typename Source>
std::string Records(Source source, const RecordLayout& layout, std::size_t count) {
  std::string records;
  records.reserve(count * RecordLength(layout));
  for (std::size_t i = 0; i < count; ++i) {
    AppendFields(source.Next(), layout.point_format, records);
    source.AppendExtraBytes(layout.extra_bytes, records);
  }
  return records;
}

}  // namespace

std::size_t RecordLength(const RecordLayout& layout) { return PointSize(layout.point_format) + layout.extra_bytes; }

std::string BusyRecords(const RecordLayout& layout, std::size_t count, std::uint64_t seed) {
  return Records(BusySurvey(seed), layout, count);
}

std::string CalmRecords(const RecordLayout& layout, std::size_t count, std::uint64_t seed) {
  return Records(CalmFlightLine(seed), layout, count);
}

}  // namespace albtpu::testing
