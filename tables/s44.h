// The limits of IHO S-44, Standards for Hydrographic Surveys, and what remains of them after the sea surface.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace albtpu {

// The strictest order first. Edition 6.1.0 (2022), tables 1 and 2; Exclusive is new in edition 6.
enum class S44Order { kExclusive, kSpecial, k1a, k1b, k2 };
inline constexpr std::array<S44Order, 5> kS44Orders = {S44Order::kExclusive, S44Order::kSpecial, S44Order::k1a,
                                                       S44Order::k1b, S44Order::k2};
inline constexpr std::string_view kS44Edition = "IHO S-44 edition 6.1.0";

inline constexpr std::array<std::string_view, 5> kS44OrderNames = {"exclusive", "special", "1a", "1b", "2"};

constexpr std::string_view Name(S44Order order) { return kS44OrderNames[static_cast<std::size_t>(order)]; }
std::optional<S44Order> FindS44Order(std::string_view name);

// The maximum THU and TVU at a depth in m, both at 95 %, in m.
double ThuLimit(S44Order order, double depth);
double TvuLimit(S44Order order, double depth);

// The THU limit of orders 1a and 1b as printed in Eq. 22 of Birkebak et al. (2018): 5 m and 2 % of the depth. S-44
// says 5 %.
double ThuLimitAsPrintedByBirkebak(double depth);

// The strictest order whose limits exceed `thu` and `tvu`, both at 95 %, in m; nullopt if there is none. The surface is
// one of several error sources: this is the best order that it leaves possible, not the order of the survey.
std::optional<S44Order> BestOrder(double thu, double tvu, double depth);

// The part that remains for all other, independent sources: sqrt(limit^2 - ours^2), at 95 %, in m; nullopt if `ours`
// exceeds `limit`.
std::optional<double> RemainingBudget(double limit, double ours);

}  // namespace albtpu
