#include "tables/s44.h"

#include <cmath>

namespace albtpu {
namespace {

// The limits of an order at 95 %: THU `c + e d`, TVU `sqrt(a^2 + (b d)^2)`, where d is the depth in m.
struct Limits {
  double c;  // m
  double e;
  double a;  // m
  double b;
};

// IHO S-44 edition 6.1.0, Table 1, in the order of kS44Orders.
constexpr std::array<Limits, kS44Orders.size()> kLimits = {{
    {1, 0, 0.15, 0.0075},
    {2, 0, 0.25, 0.0075},
    {5, 0.05, 0.5, 0.013},
    {5, 0.05, 0.5, 0.013},
    {20, 0.10, 1.0, 0.023},
}};

const Limits& LimitsOf(S44Order order) { return kLimits[static_cast<std::size_t>(order)]; }

}  // namespace

std::optional<S44Order> FindS44Order(std::string_view name) {
  for (S44Order order : kS44Orders)
    if (Name(order) == name) return order;
  return std::nullopt;
}

double ThuLimit(S44Order order, double depth) {
  const Limits& limits = LimitsOf(order);
  return limits.c + limits.e * depth;
}

double TvuLimit(S44Order order, double depth) {
  const Limits& limits = LimitsOf(order);
  const double of_depth = limits.b * depth;
  return std::sqrt(limits.a * limits.a + of_depth * of_depth);
}

double ThuLimitAsPrintedByBirkebak(double depth) { return 5 + 0.02 * depth; }

std::optional<S44Order> BestOrder(double thu, double tvu, double depth) {
  for (S44Order order : kS44Orders)
    if (ThuLimit(order, depth) > thu && TvuLimit(order, depth) > tvu) return order;
  return std::nullopt;
}

std::optional<double> RemainingBudget(double limit, double ours) {
  if (!(ours <= limit)) return std::nullopt;  // False for NaN, too.
  return std::sqrt((limit - ours) * (limit + ours));
}

}  // namespace albtpu
