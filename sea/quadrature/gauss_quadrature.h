// Gaussian quadrature: the nodes and weights that integrate polynomials of the highest degree exactly.
#pragma once

#include <vector>

namespace albtpu {

struct QuadratureNode {
  double at, weight;
};

// `count` nodes on the interval from `begin` to `end`: exact up to degree 2 count - 1.
std::vector<QuadratureNode> GaussLegendre(int count, double begin, double end);

// The mean of a function of a standard normal variable is the sum of weight f(at): exact up to degree 2 count - 1.
std::vector<QuadratureNode> GaussHermite(int count);

// The integral of exp(-x) f(x) over positive x is the sum of weight f(at): exact up to degree 2 count - 1.
std::vector<QuadratureNode> GaussLaguerre(int count);

}  // namespace albtpu
