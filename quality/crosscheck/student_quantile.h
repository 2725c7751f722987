// Student's distribution, for intervals from few numbers.
#pragma once

namespace albtpu::quality {

// The value that is exceeded with the probability `tail`, above 0 and at most 0.5, by Student's t with `degrees`, 1 or
// more, degrees of freedom: 2.776 of 4 and 0.025. Right to 1e-9 of its value; beyond 1000 degrees as with 1000, which
// is 0.3 % at most too large.
double StudentQuantile(int degrees, double tail);

}  // namespace albtpu::quality
