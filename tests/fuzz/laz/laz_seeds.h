// The inputs with which fuzzing of the LAZ codec begins.
#pragma once

#include <string>
#include <vector>

namespace albtpu::fuzz {

std::vector<std::string> LazChunkSeeds();    // Chunks of each point format, for laz_chunk_fuzz.
std::vector<std::string> LazRecordsSeeds();  // Their records, for laz_records_fuzz.

std::vector<std::string> LazFileSeeds();  // Whole files, with and without a chunk table.

}  // namespace albtpu::fuzz
