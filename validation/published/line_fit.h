// A straight line through points, by least squares.
#pragma once

#include <vector>

namespace albtpu {

struct LineFit {
  double slope, intercept;
  double r_squared;  // the part of the variance of y that the line explains

  double operator()(double x) const { return slope * x + intercept; }
};

// At least two points of different x; y must not all be alike.
LineFit FitLine(const std::vector<double>& x, const std::vector<double>& y);

// y = factor * x^exponent: a line through the logarithms. All numbers positive.
struct PowerLaw {
  double factor, exponent;
};
PowerLaw FitPowerLaw(std::vector<double> x, std::vector<double> y);

}  // namespace albtpu
