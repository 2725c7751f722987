// A square cell as weights on wavenumbers, and as a density of the lag between two of its points.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sea/response/closed_form.h"

namespace albtpu {

// The mean over a square of side a reduces a wave by W_a = sinc(k cos(psi) a / 2) sinc(k sin(psi) a / 2), psi from one
// of its sides. The means over psi of W_a^2 cos(4 m psi), one column for each m from 0 to kCellHarmonics: the other
// harmonics vanish. The rows are the wavenumbers of HankelLattice::Shared(), each with the mean over those about it
// that linear interpolation in ln k gives to the sample there. `side` in m.
inline constexpr int kCellHarmonics = 4;
Eigen::ArrayXXd CellWindowOf(double side);

// The points of two footprints, or of the footprints of two pulses anywhere in one cell: how often they are a vector
// apart. Immutable.
//
// A footprint has the density of its overlap, in the coordinates across the beam. A cell has that of a square,
// (1 - |x| / a) (1 - |y| / a) / a^2 on its axes. That of both is their convolution.
class LagDensity {
 public:
  explicit LagDensity(const BeamOptions& beam);
  LagDensity(const BeamOptions& beam, double side, double orientation);

  // 1/m^2, at the vector `lag` [m] on the water.
  double operator()(const Eigen::Vector2d& lag) const;

  // Beyond it the density is 0, or below 1e-7 of its maximum, m.
  double reach() const { return reach_; }

  // The density of the footprint, or of the cell where that is narrower, as points with weights that add up to 1.
  struct Node {
    Eigen::Vector2d at;
    double weight;
  };
  const std::vector<Node>& nodes() const { return nodes_; }

 private:
  double OfFootprint(const Eigen::Vector2d& lag) const;

  BeamOptions beam_;
  Eigen::Vector2d along_;  // the unit vector of the azimuth
  double side_ = 0;        // 0: no cell
  Eigen::Vector2d axis_ = {1, 0};
  double width_, reach_;     // m, of the footprint's density and of the whole
  bool over_cell_ = false;   // the convolution is a sum over the cell, which is narrower, and not over the footprint
  std::vector<Node> nodes_;  // of the narrower of the two
  Eigen::ArrayXd node_x_, node_y_, weights_;  // the same on the axes of the cell, in its sides
};

}  // namespace albtpu
