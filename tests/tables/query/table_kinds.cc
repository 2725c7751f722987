#include "tests/tables/query/table_kinds.h"

#include <array>
#include <random>
#include <utility>

namespace albtpu::testing {
namespace {

constexpr AxisSchema kAttenuation = {.name = "attenuation",
                                     .units = "m-1",
                                     .long_name = "diffuse attenuation",
                                     .scale = Scale::kLog,
                                     .is_endless = true,
                                     .if_absent = IfAbsent::kLastNode};
constexpr AxisSchema kHeading = {.name = "heading",
                                 .units = "degree",
                                 .long_name = "heading",
                                 .scale = Scale::kLinear,
                                 .fold = Fold::kQuadrant,
                                 .if_absent = IfAbsent::kLargerOfEnds};
constexpr AxisSchema kRange = {.name = "range", .units = "m", .long_name = "range", .scale = Scale::kLinear};

constexpr std::array<AxisSchema, 3> kThree = {kAttenuation, kHeading, kRange};
constexpr std::array<QuantitySchema, 2> kTwoQuantities = {
    {{"spread", "m", "2 sigma", true, false}, {"shift", "degree", "mean error", false, true}}};
constexpr std::array<std::size_t, 3> kThreeOrder = {1, 0, 2};

constexpr AxisSchema Plain(const char* name, Scale scale) {
  return {.name = name, .units = "1", .long_name = name, .scale = scale};
}
constexpr std::array<AxisSchema, kMaxAxes> kSix = {Plain("a", Scale::kLinear), kAttenuation, Plain("c", Scale::kLog),
                                                   Plain("d", Scale::kLinear), kHeading,     Plain("f", Scale::kLog)};
constexpr std::array<QuantitySchema, kMaxQuantities> kNineQuantities = {{{"q0", "1", "q0", true, false},
                                                                         {"q1", "1", "q1", false, true},
                                                                         {"q2", "1", "q2", true, false},
                                                                         {"q3", "1", "q3", true, true},
                                                                         {"q4", "1", "q4", false, false},
                                                                         {"q5", "1", "q5", true, false},
                                                                         {"q6", "1", "q6", false, false},
                                                                         {"q7", "1", "q7", true, true},
                                                                         {"q8", "1", "q8", true, false}}};
constexpr std::array<std::size_t, kMaxAxes> kSixOrder = {4, 2, 0, 3, 1, 5};

constexpr std::array<AxisSchema, 1> kOne = {kRange};
constexpr std::array<QuantitySchema, 1> kOneQuantity = {{{"spread", "m", "2 sigma", true, false}}};
constexpr std::array<std::size_t, 1> kOneOrder = {0};

constexpr TableSchema kSchemas[] = {
    {.name = "three_axes", .axes = kThree, .quantities = kTwoQuantities, .blend_order = kThreeOrder},
    {.name = "three_axes_renamed", .axes = kThree, .quantities = kTwoQuantities, .blend_order = kThreeOrder},
    {.name = "largest_kind", .axes = kSix, .quantities = kNineQuantities, .blend_order = kSixOrder},
    {.name = "one_axis", .axes = kOne, .quantities = kOneQuantity, .blend_order = kOneOrder}};
static_assert(IsWellFormed(kSchemas[0]) && IsWellFormed(kSchemas[1]) && IsWellFormed(kSchemas[2]) &&
              IsWellFormed(kSchemas[3]));

std::vector<double> RandomNodes(const AxisSchema& axis, std::size_t size, std::mt19937& random) {
  if (axis.fold != Fold::kNone && size > 1) {
    std::vector<double> nodes;
    for (std::size_t i = 0; i < size; ++i) {
      const double fraction = static_cast<double>(i) / static_cast<double>(size - 1);
      nodes.push_back(static_cast<float>(MaxAngle(axis.fold) * fraction));
    }
    return nodes;
  }
  std::uniform_real_distribution<float> distance(0.2f, 2.0f);
  std::vector<double> nodes;
  float node = 0;
  for (std::size_t i = 0; i < size; ++i) nodes.push_back(node += distance(random));
  return nodes;
}

}  // namespace

constinit const TableSchema kThreeAxes = kSchemas[0];
constinit const TableSchema kThreeAxesRenamed = kSchemas[1];
constinit const TableSchema kLargestKind = kSchemas[2];
constinit const TableSchema kOneAxis = kSchemas[3];

Table RandomTable(const TableSchema& schema, const std::vector<std::size_t>& sizes, std::uint32_t seed, Scale scale,
                  bool with_standard_errors) {
  std::mt19937 random(seed);
  Table::Axes axes;
  for (std::size_t axis = 0; axis < sizes.size(); ++axis)
    axes.push_back(Axis::Create(schema.axes[axis], RandomNodes(schema.axes[axis], sizes[axis], random)).value());
  Table::Variables variables;
  for (const QuantitySchema& quantity : schema.quantities) {
    std::uniform_real_distribution<float> value(quantity.is_bias ? -1.0f : 0.1f, 1.0f), error(0.0f, 0.1f);
    Variable variable{.values = std::vector<float>(ValueCount(axes, quantity)),
                      .standard_errors = {},
                      .scale = quantity.is_bias ? Scale::kLinear : scale};
    for (float& number : variable.values) number = value(random);
    if (with_standard_errors) variable.standard_errors.resize(variable.values.size());
    for (float& number : variable.standard_errors) number = error(random);
    variables.push_back(std::move(variable));
  }
  return Table::Create(schema, std::move(axes), std::move(variables),
                       {.id = "random", .version = "1", .title = "Random numbers", .campaign = "", .attributes = {}})
      .value();
}

}  // namespace albtpu::testing
