// Mutates requests in columns field by field, so that most of them stay valid messages; some byte by byte.
#include <algorithm>
#include <cstring>
#include <string>

#include "albtpu/v1/uncertainty_service.pb.h"
#include "tests/fuzz/mutation.h"

namespace {

using namespace albtpu;

// Bytes of a column: usually more than the interpolator processes in one vector, sometimes more than one of its blocks.
constexpr std::size_t kUsualBytes = 96, kMostBytes = 2048;

void MutateBytes(std::mt19937& random, std::string& column) {
  switch (random() % 4) {
    case 0:  // Arbitrary bytes.
      column.resize(std::max(column.size(), kUsualBytes));
      column.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(column.data()), column.size() / 2, column.size()));
      return;
    case 1:  // Another length.
      column.resize(random() % 64 == 0 ? random() % kMostBytes
                                       : sizeof(float) * (random() % (kUsualBytes / sizeof(float))));
      return;
    default: {  // A notable value.
      if (column.size() < sizeof(float)) column.resize(sizeof(float));
      const std::size_t at = random() % (column.size() / sizeof(float)) * sizeof(float);
      const float number = fuzz::NotableNumber<float>(random);
      std::memcpy(column.data() + at, &number, sizeof number);
    }
  }
}

std::string* AnyColumn(std::mt19937& random, v1::PulseColumns& pulses) {
  std::string* const columns[] = {pulses.mutable_wind_speed(), pulses.mutable_fetch(),     pulses.mutable_incidence(),
                                  pulses.mutable_azimuth(),    pulses.mutable_footprint(), pulses.mutable_depth()};
  return fuzz::AnyOf(columns, random);
}

void MutateOptions(std::mt19937& random, v1::QueryColumnsRequest& request) {
  constexpr const char* kTables[] = {"", "survey", "tiny", "published", "survey/1", "absent", "/", "../tiny"};
  v1::QueryOptions& options = *request.mutable_options();
  switch (random() % 6) {
    case 0:
      return options.set_table(fuzz::AnyOf(kTables, random));
    case 1:
      return options.set_coverage(static_cast<v1::Coverage>(random() % 5));
    case 2:
      return options.set_standard_errors(random() % 2 == 0);
    case 3:
      return options.set_best_s44_order(random() % 2 == 0);
    case 4:
      return options.set_s44_order(static_cast<v1::S44Order>(random() % 8));
    default:
      if (random() % 3 == 0) return request.clear_quantities();
      request.add_quantities(static_cast<v1::Quantity>(random() % 8));
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  std::mt19937 random(seed);
  v1::QueryColumnsRequest request;
  const bool is_request = request.ParseFromArray(data, static_cast<int>(size));
  if (!is_request || random() % 8 == 0) return LLVMFuzzerMutate(data, size, max_size);
  if (random() % 4 == 0)
    MutateOptions(random, request);
  else
    MutateBytes(random, *AnyColumn(random, *request.mutable_pulses()));
  return fuzz::Replace(request.SerializeAsString(), data, size, max_size);
}
