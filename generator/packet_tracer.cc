#include "generator/packet_tracer.h"
namespace albtpu {
TracedBundle TracePackets(const RayBundle& rays, const HeightWindow& s) {
  std::vector<double> h(s.heights, s.heights + s.points * s.points);
  HeightField f(h, s.points, s.spacing);
  std::vector<Ray> rs;
  for (int i = 0; i < rays.count(); ++i) rs.push_back({rays.direction(), {rays.x()[i], rays.y()[i]}});
  TracedBundle t{Trace(rs, f, rays.refractive_index()), 0, Eigen::Vector2d::Zero(), Eigen::Vector3d::Zero(), 0};
  for (auto& r : rs) { auto m = f.FacetAt(r.at_zero).slope; t.undisturbed_slope += m / rs.size(); t.undisturbed_slope_squares += SlopeSquares(m) / rs.size(); }
  return t;
}
}
