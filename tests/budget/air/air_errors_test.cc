// The list of sources of error, and the table of docs/budget.md that repeats it.
#include "budget/air/air_errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

namespace albtpu {
namespace {

TEST(ErrorSources, AreTheMembersOfAirErrorsInTheirOrder) {
  const AirErrors errors;
  const auto* next = reinterpret_cast<const double*>(&errors);
  for (const ErrorSource& source : kErrorSources) {
    const std::span<const double> numbers = source.In(errors);
    EXPECT_EQ(numbers.data(), next) << source.name;
    EXPECT_EQ(numbers.size(), source.size());
    next += numbers.size();
  }
}

TEST(ErrorSources, AreStatedWhole) {
  for (const ErrorSource& source : kErrorSources) {
    EXPECT_NE(source.number == nullptr, source.numbers == nullptr) << source.name;
    EXPECT_EQ(source.parts[0].empty(), source.size() == 1) << source.name;
    EXPECT_THAT(source.unit, ::testing::AnyOf("m", "degree", "s", "1")) << source.name;
    EXPECT_FALSE(source.doc.empty()) << source.name;
    for (const double assumed : source.assumed) EXPECT_TRUE(assumed >= 0 && assumed < source.greatest);
  }
}

TEST(ErrorSources, AverageOutByTheirGroup) {
  const ErrorSource& height = kErrorSources[Index(&AirErrors::surface_height)];
  EXPECT_EQ(GroupOf(height, SurfaceLocation::kPulse), ErrorGroup::kPulse);
  EXPECT_EQ(GroupOf(height, SurfaceLocation::kLocal), ErrorGroup::kLine);
  EXPECT_EQ(GroupOf(height, SurfaceLocation::kLevel), ErrorGroup::kSurvey);
  const ErrorSource& scan = kErrorSources[Index(&AirErrors::scan)];
  EXPECT_EQ(GroupOf(scan, SurfaceLocation::kLevel), ErrorGroup::kPulse);
}

// The row of a source in docs/budget.md, up to its formula.
std::string RowOf(const ErrorSource& source) {
  std::ostringstream row;
  row << "| `" << source.name << "` | " << source.unit << " | " << source.greatest << " | ";
  if (source.group.has_value())
    row << "a " << kErrorGroupNames[static_cast<std::size_t>(*source.group)];
  else
    row << "its location";
  row << " | ";
  if (source.assumption.empty()) {
    row << "never";
  } else if (!source.Is(&AirErrors::surface_range)) {
    for (std::size_t i = 0; i < source.size(); ++i) row << (i > 0 ? ", " : "") << source.assumed[i];
    row << ": ";
  }
  row << source.assumption << " | ";
  return row.str();
}

TEST(ErrorSources, AreThoseOfTheDocuments) {
  std::ifstream file(BUDGET_DOCUMENT);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  std::size_t at = text.find("| source | unit |");
  ASSERT_NE(at, text.npos);
  for (int line = 0; line < 2; ++line) at = text.find('\n', at) + 1;
  for (const ErrorSource& source : kErrorSources) {
    EXPECT_EQ(text.substr(at, RowOf(source).size()), RowOf(source));
    at = text.find('\n', at) + 1;
  }
  EXPECT_EQ(text[at], '\n') << "docs/budget.md has a source that the program lacks";
}

}  // namespace
}  // namespace albtpu
