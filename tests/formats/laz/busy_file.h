// A LAS file around given records, with something before and after them that its version allows.
#pragma once

#include <string>

#include "tests/formats/laz/busy_points.h"
#include "tests/formats/laz/laz_bytes.h"

namespace albtpu::testing {

// Of version 1.2 for formats 0 to 3, 1.3 with waveforms in the file for 4 and 5, 1.4 with waveforms and an EVLR for 6
// to 10. It has two VLRs, and a gap before the points.
LasParts FileOf(const RecordLayout& layout, const std::string& records);

}  // namespace albtpu::testing
