// Variable length records of a LAS file: short ones (VLR) between header and points, extended ones (EVLR)
// behind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "survey/las/las_header.h"

namespace albtpu::client {

inline constexpr std::size_t kVlrHeaderSize = 54;
inline constexpr std::size_t kEvlrHeaderSize = 60;
inline constexpr std::size_t kVlrLengthField = 20;  // u16 in a VLR, u64 in an EVLR: bytes behind its header.

// What a record is and where it lies in the file.
struct VlrEntry {
  std::string user_id;
  std::uint16_t record_id = 0;
  std::uint64_t offset = 0;       // Of its header.
  std::uint64_t data_offset = 0;  // Of what is behind its header.
  std::uint64_t data_size = 0;

  std::uint64_t end() const { return data_offset + data_size; }
  bool Is(std::string_view user, std::uint16_t record) const {
    return user_id == user && record_id == record;
  }
};

// The specification's own records.
inline constexpr std::string_view kSpecUser = "LASF_Spec";
inline constexpr std::uint16_t kExtraBytesRecord = 4;

// The VLRs in `head`, all bytes before the points. Fails when they do not fit there.
absl::StatusOr<std::vector<VlrEntry>> ListVlrs(const std::string& name, const LasHeader& header,
                                               std::string_view head);

// An EVLR from its 60 bytes at `offset`. Fails when it does not end within the file.
absl::StatusOr<VlrEntry> ParseEvlr(const std::string& name, std::string_view bytes, std::uint64_t offset,
                                   std::uint64_t file_size);

// The header of a VLR of the specification with `data_size` bytes behind it.
std::string SpecVlrHeader(std::uint16_t record_id, std::uint16_t data_size, std::string_view description);

}  // namespace albtpu::client
