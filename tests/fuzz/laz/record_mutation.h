// Changes point records as neighbouring points of a survey differ, so that all predictions of a codec are reached.
#pragma once

#include <cstddef>
#include <random>
#include <string>

namespace albtpu::fuzz {

// Changes `records` of a point format once. Requires at least one record; leaves one to `most`.
void ChangeRecords(std::minstd_rand& random, int point_format, std::size_t record_length, std::size_t most,
                   std::string& records);

}  // namespace albtpu::fuzz
