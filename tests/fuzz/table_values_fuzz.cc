// Arbitrary axes and numbers as the contents of a table, without the file around them, which takes a hundred times as
// long: they are refused with a reason, or are a table that answers as it should.
#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tables/file/table_encoder.h"
#include "tables/table.h"
#include "tables/uncertainty_table.h"
#include "tables/water/water_schema.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/table_checks.h"

namespace albtpu::fuzz {
namespace {

constexpr std::size_t kMostNodes = 5, kMostNumbers = 8, kMostValues = 4096;

// The nodes of an axis, or numbers that the values of a variable repeat. In an input, the flags and the length, a byte
// each, come before the numbers.
struct Numbers {
  unsigned flags = 0;  // 1: absent, 2: on a log scale, 4: with standard errors
  std::vector<float> of;

  bool is_absent() const { return flags % 2 == 1; }
  Scale scale() const { return flags / 2 % 2 == 1 ? Scale::kLog : Scale::kLinear; }
  bool has_errors() const { return flags / 4 % 2 == 1; }
};

// What an input states: the numbers of each axis, then those of each quantity. What is missing is 0.
struct Contents {
  std::vector<Numbers> axes, quantities;
};

// Takes numbers from the front of `input`, at least one and `most` at most.
Numbers TakeNumbers(std::string_view& input, std::size_t most) {
  const auto byte = [&] {
    if (input.empty()) return 0u;
    const unsigned front = static_cast<unsigned char>(input.front());
    input.remove_prefix(1);
    return front;
  };
  Numbers numbers{.flags = byte(), .of = std::vector<float>(1 + byte() % most)};
  const std::size_t bytes = std::min(input.size(), numbers.of.size() * sizeof(float));
  std::memcpy(numbers.of.data(), input.data(), bytes);
  input.remove_prefix(bytes);
  return numbers;
}

Contents Parse(const TableSchema& schema, std::string_view input) {
  Contents contents;
  for (std::size_t i = 0; i < schema.axes.size(); ++i) contents.axes.push_back(TakeNumbers(input, kMostNodes));
  for (std::size_t i = 0; i < schema.quantities.size(); ++i)
    contents.quantities.push_back(TakeNumbers(input, kMostNumbers));
  return contents;
}

std::string Write(const Contents& contents) {
  std::string input;
  for (const std::vector<Numbers>* lists : {&contents.axes, &contents.quantities}) {
    for (const Numbers& numbers : *lists) {
      input += static_cast<char>(numbers.flags);
      input += static_cast<char>(numbers.of.size() - 1);
      input.append(reinterpret_cast<const char*>(numbers.of.data()), numbers.of.size() * sizeof(float));
    }
  }
  return input;
}

std::vector<float> Repeated(const std::vector<float>& numbers, std::size_t count) {
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = numbers[i % numbers.size()];
  return values;
}

// InvalidArgument with a reason, or a table.
absl::StatusOr<Table> TableOf(const TableSchema& schema, const Contents& contents) {
  Table::Axes axes;
  std::size_t count = 1;
  for (std::size_t i = 0; i < schema.axes.size(); ++i) {
    std::vector<double> nodes(contents.axes[i].of.begin(), contents.axes[i].of.end());
    if (count * nodes.size() > kMostValues) nodes.resize(1);
    count *= nodes.size();
    absl::StatusOr<Axis> axis = Axis::Create(schema.axes[i], std::move(nodes), contents.axes[i].scale());
    if (!axis.ok()) return axis.status();
    axes.push_back(*std::move(axis));
  }
  Table::Variables variables;
  for (std::size_t i = 0; i < schema.quantities.size(); ++i) {
    const Numbers& numbers = contents.quantities[i];
    if (numbers.is_absent()) {
      variables.emplace_back();
      continue;
    }
    const std::vector<float> values = Repeated(numbers.of, ValueCount(axes, schema.quantities[i]));
    variables.push_back(Variable{.values = values,
                                 .standard_errors = numbers.has_errors() ? values : std::vector<float>(),
                                 .scale = numbers.scale()});
  }
  Provenance provenance;
  provenance.id = std::string("any");
  provenance.version = std::string("1");
  provenance.title = std::string("any numbers");
  return Table::Create(schema, std::move(axes), std::move(variables), std::move(provenance));
}

std::optional<Table> AcceptedTable(const TableSchema& schema, std::string_view input) {
  absl::StatusOr<Table> table = TableOf(schema, Parse(schema, input));
  if (table.ok()) {
    // A file holds what the table does. HDF5 takes a thousand times as long as the rest.
    if (IsOneIn(4096, input)) {
      const absl::StatusOr<Table> same = DecodeTable(EncodeTable(*table).value(), schema);
      ALBTPU_MUST(same.ok() && same->digest() == table->digest());
    }
    return *std::move(table);
  }
  ALBTPU_MUST(absl::IsInvalidArgument(table.status()) && table.status().message().size() > 10);
  return std::nullopt;
}

void SeaTarget(std::string_view input) {
  const std::size_t kind = input.empty() ? 0 : static_cast<unsigned char>(input.back()) % 2;
  if (std::optional<Table> table = AcceptedTable(*UncertaintyTable::kKinds[kind], input))
    CheckAnswers(UncertaintyTable(*std::move(table)));
}

void WaterTarget(std::string_view input) {
  if (std::optional<Table> table = AcceptedTable(kWaterColumn, input)) CheckWater(*std::move(table));
}

// Nodes as a table has them: they increase, and stay within an angle.
std::vector<float> SomeNodes(Random& random) {
  std::vector<float> nodes(1 + random() % kMostNodes);
  float node = random() % 3 == 0 ? 0.0f : std::abs(AnyTableNumber(random));
  for (float& each : nodes) {
    each = node;
    node = random() % 2 == 0 ? node + static_cast<float>(1 + random() % 20) : node * 1.5f + 0.01f;
  }
  return nodes;
}

// Changes one list, so that an accepted table mostly stays one.
std::string MutateContents(const TableSchema& schema, std::string_view input, Random& random) {
  if (random() % 8 == 0) return "";
  Contents contents = Parse(schema, input);
  const bool of_axis = random() % 2 == 0;
  std::vector<Numbers>& lists = of_axis ? contents.axes : contents.quantities;
  Numbers& numbers = lists[random() % lists.size()];
  switch (random() % 4) {
    case 0:
      numbers.flags = static_cast<unsigned>(random()) % 8;
      break;
    case 1:
      numbers.of[random() % numbers.of.size()] = AnyTableNumber(random);
      break;
    default:
      if (of_axis) {
        numbers.of = SomeNodes(random);
        break;
      }
      numbers.of.resize(1 + random() % kMostNumbers);
      for (float& number : numbers.of) number = static_cast<float>(random() % 1000) / 256;
  }
  return Write(contents);
}

std::string MutateSea(std::string_view input, std::size_t, Random& random) {
  const std::string mutated = MutateContents(kSeaSurface, input, random);
  return mutated.empty() ? mutated : mutated + static_cast<char>(random() % 2);  // The kind.
}

std::string MutateWater(std::string_view input, std::size_t, Random& random) {
  return MutateContents(kWaterColumn, input, random);
}

}  // namespace

const std::vector<Target> kTargets = {{"table_values", SeaTarget, MutateSea},
                                      {"water_values", WaterTarget, MutateWater}};

}  // namespace albtpu::fuzz
