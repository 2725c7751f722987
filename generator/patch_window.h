#pragma once
#include <span>
#include "generator/wave_patch.h"
namespace albtpu {
class PatchWindow { public: PatchWindow(const WavePatchModel& m, int points) : m_(m), p_(points) {}
 struct Workspace {};
 void Draw(const NormalStream& s, std::span<float> h, Workspace&) const {
   auto d = m_.Draw(s); int n = m_.size(), c = (p_-1)/2;
   for (int i=0;i<p_;++i) for (int j=0;j<p_;++j) h[i*p_+j] = d[((i-c+n)%n)*n + (j-c+n)%n];
 }
 const WavePatchModel& m_; int p_; };
}
