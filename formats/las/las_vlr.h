// Variable length records of a LAS file: VLRs between the header and the points, extended ones (EVLRs) after the
// points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/las/las_header.h"

namespace albtpu::formats {

inline constexpr std::size_t kVlrHeaderSize = 54;
inline constexpr std::size_t kEvlrHeaderSize = 60;
inline constexpr std::size_t kVlrLengthField = 20;  // u16 in a VLR, u64 in an EVLR: bytes after its header.

// The identity of a record and its position in the file.
struct VlrEntry {
  std::string user_id;
  std::uint16_t record_id = 0;
  std::uint64_t offset = 0;       // Of its header.
  std::uint64_t data_offset = 0;  // Of the data after its header.
  std::uint64_t data_size = 0;

  std::uint64_t end() const { return data_offset + data_size; }
  bool Is(std::string_view user, std::uint16_t record) const {
    return user_id == user && record_id == record;
  }
};

// Records that the LAS specification defines.
inline constexpr std::string_view kSpecUser = "LASF_Spec";
inline constexpr std::uint16_t kExtraBytesRecord = 4;

// The VLRs in `head`, which has all bytes before the points. Fails when they extend beyond it.
absl::StatusOr<std::vector<VlrEntry>> ListVlrs(const std::string& name, const LasHeader& header,
                                               std::string_view head);

// The EVLR whose header is `bytes`, at `offset`. Fails when it extends beyond the file.
absl::StatusOr<VlrEntry> ParseEvlr(const std::string& name, std::string_view bytes, std::uint64_t offset,
                                   std::uint64_t file_size);

// The header of a VLR for `data_size` bytes of data.
std::string VlrHeader(std::string_view user, std::uint16_t record_id, std::uint16_t data_size,
                      std::string_view description);

}  // namespace albtpu::formats
