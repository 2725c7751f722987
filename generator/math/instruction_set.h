// The instruction set on which this machine runs FFTW, the C library and the kernels.
#pragma once

#include <string>

namespace albtpu {

// The microarchitecture level of the x86-64 psABI ("x86-64-v3"), or the name of another architecture. FFTW and the C
// library choose their code by it, so the last bit of a result depends on it.
std::string InstructionSet();

}  // namespace albtpu
