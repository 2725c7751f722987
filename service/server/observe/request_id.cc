#include "service/server/observe/request_id.h"

#include <algorithm>

#include "absl/random/random.h"
#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "service/server/ground/limits.h"

namespace albtpu::server {
namespace {

std::string Made() {
  thread_local absl::BitGen random;
  return absl::StrCat(absl::Hex(absl::Uniform<std::uint64_t>(random), absl::kZeroPad16));
}

}  // namespace

const std::string& RequestId::text() const {
  if (!text_.empty()) return text_;
  const auto& metadata = context_.client_metadata();
  const auto sent = metadata.find(kMetadata);
  const std::string_view text = sent == metadata.end()
                                    ? std::string_view()
                                    : std::string_view(sent->second.data(), sent->second.size());
  text_ = IsSane(text) ? std::string(text) : Made();
  return text_;
}

bool RequestId::IsSane(std::string_view text) {
  return !text.empty() && text.size() <= kMaxRequestIdBytes &&
         std::all_of(text.begin(), text.end(),
                     [](char c) { return absl::ascii_isalnum(c) || c == '.' || c == '_' || c == '-'; });
}

}  // namespace albtpu::server
