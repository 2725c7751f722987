#include "service/server/calls/answer_sources.h"

#include "service/server/calls/sea_request.h"
#include "service/server/ground/errors.h"

namespace albtpu::server {

absl::StatusOr<const ServedTable*> AnswerSources::Find(std::string_view table) const {
  return catalog_.Find(table);
}

absl::StatusOr<const ServedTable*> AnswerSources::Find(const v1::SeaState& sea) {
  if (sea_table_ != nullptr) return sea_table_.get();
  const Sha256Digest key = KeyOf(sea);
  sea_table_ = seas_.Find(key);
  if (sea_table_ != nullptr) return sea_table_.get();
  absl::StatusOr<KnownSea> known = ReadSea(sea);
  if (!known.ok()) return Within("sea", known.status());
  wanted_ = WantedSea{key, *std::move(known)};
  return absl::UnavailableError("the sea is not compiled yet");
}

}  // namespace albtpu::server
