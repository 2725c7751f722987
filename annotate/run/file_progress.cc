#include "annotate/run/file_progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "absl/strings/cord.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "service/client/channel.h"
#include "service/printable_text.h"

namespace albtpu::annotate {
std::string MessageWithDetails(const absl::Status& status) {
  std::string message(status.message());
  const auto payload = status.GetPayload(absl::string_view(client::kErrorDetails.data(), client::kErrorDetails.size()));
  google::rpc::Status details;
  if (!payload.has_value() || !details.ParseFromString(std::string(*payload))) return message;
  for (const google::protobuf::Any& detail : details.details()) {
    google::rpc::BadRequest request;
    if (!detail.UnpackTo(&request)) continue;
    for (const auto& violation : request.field_violations()) {
      if (absl::StrContains(message, violation.description())) continue;
      absl::StrAppend(&message, "; ", violation.field(), ": ", violation.description());
    }
  }
  return message;
}

int Report(const absl::Status& status) {
  if (status.ok()) return 0;
  Note(MessageWithDetails(status));
  return formats::IsUsageError(status) ? formats::kExitUsage : formats::kExitFailure;
}

void Note(std::string_view message, const std::string& below) {
  std::fprintf(stderr, "albtpu-query: %s%s\n", PrintableText(message).c_str(), below.c_str());
}

namespace {

constexpr std::chrono::milliseconds kRedrawInterval{200};
constexpr std::chrono::minutes kLineInterval{1};
constexpr int kBarWidth = 20;

// As much of `line` as one line of the terminal has room for: a longer one would be wrapped, and not be redrawn in
// place. No character takes more columns than bytes.
std::string CutToTerminal(std::string line) {
  winsize size = {};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  const std::size_t room = known ? size.ws_col - 1 : 79;
  if (line.size() <= room) return line;
  std::size_t end = room;
  while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xC0) == 0x80) --end;  // Within a character of UTF-8.
  return line.substr(0, end);
}

}  // namespace

std::string RateText(std::uint64_t records, double seconds, const std::string& record_name) {
  const double rate = static_cast<double>(records) / std::max(seconds, 1e-9);
  return rate < 1e5 ? absl::StrFormat("%.*f %s/s", rate < 10 ? 1 : 0, rate, record_name)
                    : absl::StrFormat("%.2f million %s/s", rate / 1e6, record_name);
}

FileProgress::FileProgress(std::string records, std::size_t file_count, std::uint64_t total_bytes)
    : record_name_(std::move(records)),
      file_count_(file_count),
      total_bytes_(total_bytes),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_shown_(start_) {}

void FileProgress::Skip(std::uint64_t bytes) { total_bytes_ -= std::min(bytes, total_bytes_); }

double FileProgress::seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

void FileProgress::Show(const std::string& label, std::uint64_t bytes, std::uint64_t records) {
  const Clock::time_point now = Clock::now();
  if (total_bytes_ == 0 || bytes == 0) return;
  if (now - last_shown_ < (terminal_ ? Clock::duration(kRedrawInterval) : Clock::duration(kLineInterval))) return;
  last_shown_ = now;
  const double fraction = std::min(1.0, static_cast<double>(bytes) / static_cast<double>(total_bytes_));
  const std::string state =
      absl::StrFormat("%.0f %%, %s, %.0f s left", 100 * fraction, RateText(records, seconds(), record_name_),
                      seconds() * (1 - fraction) / fraction);
  if (terminal_) {
    const int filled = static_cast<int>(fraction * kBarWidth);
    const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
    std::fprintf(stderr, "\r%s\033[K", CutToTerminal(absl::StrCat("[", bar, "] ", state, ", ", label)).c_str());
    drawn_ = true;
  } else {
    Note(absl::StrCat(label, ": ", state));
  }
}

FileProgress::File::File(FileProgress& run, std::string name) : run_(run), label_(PrintableText(name)) {
  if (run_.file_count_ > 1) label_ = absl::StrCat("file ", run_.file_, " of ", run_.file_count_, ", ", label_);
}

void FileProgress::File::Reach(std::uint64_t bytes, std::uint64_t records) {
  bytes_ = bytes;
  records_ = records;
  run_.Show(label_, run_.bytes_before_ + bytes, run_.records_before_ + records);
}

FileProgress::File::~File() {
  run_.bytes_before_ += bytes_;
  run_.records_before_ += records_;
  if (std::exchange(run_.drawn_, false)) std::fputs("\r\033[K", stderr);
}

}  // namespace albtpu::annotate
