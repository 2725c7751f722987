// Arbitrary text as a specification is rejected with one line that names a line of it, or has classes with names of
// their own and limits that are in range and grow with the depth.
#include <set>
#include <string>
#include <string_view>

#include "quality/report/specification.h"
#include "tests/fuzz/fuzz_target.h"

namespace {

using namespace albtpu::quality;

void CheckLimit(const Limit& limit) {
  ALBTPU_MUST(limit.constant >= 0 && limit.constant <= 1000);
  ALBTPU_MUST(limit.of_depth >= 0 && limit.of_depth <= 1);
  ALBTPU_MUST(limit.At(0) == limit.constant && limit.At(30) >= limit.constant);
}

void CheckSpecification(const Specification& specification) {
  ALBTPU_MUST(!specification.title.empty() && !specification.source.empty());
  ALBTPU_MUST(!specification.classes.empty());
  std::set<std::string> names;
  for (const SpecificationClass& of : specification.classes) {
    ALBTPU_MUST(names.insert(of.name).second);
    ALBTPU_MUST(of.horizontal.has_value() || of.vertical.has_value());
    for (const auto& limit : {of.horizontal, of.vertical})
      if (limit.has_value()) CheckLimit(*limit);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data),
                         size);  // A copy: sanitizers see reads beyond it.
  const absl::StatusOr<Specification> specification = ParseSpecification(text);
  if (!specification.ok()) {
    const std::string_view message(specification.status().message().data(), specification.status().message().size());
    ALBTPU_MUST(absl::IsInvalidArgument(specification.status()));
    ALBTPU_MUST(message.find('\n') == message.npos && message.find("; ") != message.npos);
  } else {
    CheckSpecification(*specification);
  }
  return 0;
}
