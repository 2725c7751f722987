#include "sea/files/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <limits>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"

namespace albtpu {
namespace {

constexpr int kGzipWindow = 15 + 16;  // the largest window, and a gzip header

class Inflater {
 public:
  Inflater() { ready_ = inflateInit2(&stream_, kGzipWindow) == Z_OK; }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() {
    if (ready_) inflateEnd(&stream_);
  }

  bool ready() const { return ready_; }
  z_stream& stream() { return stream_; }

 private:
  z_stream stream_{};
  bool ready_ = false;
};

}  // namespace

bool IsGzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

absl::StatusOr<std::string> Inflated(std::string_view bytes, std::size_t most) {
  Inflater inflater;
  if (!inflater.ready()) return absl::ResourceExhaustedError("no memory to inflate it; free some memory");
  z_stream& stream = inflater.stream();
  std::string text;
  while (true) {
    char piece[1 << 16];
    const auto given =
        static_cast<uInt>(std::min<std::size_t>(bytes.size(), std::numeric_limits<uInt>::max()));
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = given;
    stream.next_out = reinterpret_cast<Bytef*>(piece);
    stream.avail_out = sizeof piece;
    const int result = inflate(&stream, Z_NO_FLUSH);
    const std::size_t made = sizeof piece - stream.avail_out;
    bytes.remove_prefix(given - stream.avail_in);
    if (made > most - text.size())
      return absl::InvalidArgumentError(
          absl::StrCat("it inflates to more than ", most, " bytes; split the file"));
    text.append(piece, made);
    if (result == Z_STREAM_END) {
      if (bytes.empty()) return text;
      if (inflateReset(&stream) != Z_OK) break;
    } else if (result != Z_OK) {
      break;
    }
  }
  return absl::InvalidArgumentError(
      bytes.empty() ? "its compressed data end early (the file was cut); get another copy of the file"
                    : "its compressed data are damaged; get another copy of the file");
}

}  // namespace albtpu
