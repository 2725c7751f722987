// Files that other programs compressed, and their uncompressed twins. They may lie beside the checkout.
#pragma once

#include <string>

namespace albtpu::testing {

// The bytes of a sample, which may be compressed by gzip; "" if it is absent.
std::string SampleBytes(const std::string& name);

}  // namespace albtpu::testing
