#include "config/key_list.h"

#include <variant>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "config/survey_settings.h"

namespace albtpu::config {
namespace {

std::string UnitText(std::string_view unit) { return unit == "1" ? "" : std::string(unit); }

struct Describe {
  ValueFacts operator()(const Number& number) const {
    return {"number", UnitText(number.unit), number.least, number.greatest, {}, "NUMBER"};
  }
  ValueFacts operator()(const ThreeNumbers& numbers) const {
    return {"3 numbers", UnitText(numbers.unit), numbers.least, numbers.greatest, {}, std::string(numbers.shown)};
  }
  ValueFacts operator()(const Word& word) const {
    const std::vector<std::string> words(word.words.begin(), word.words.end());
    return {"one of", "", {}, {}, words, absl::StrJoin(words, "|")};
  }
  ValueFacts operator()(const Text& text) const { return {"text", "", {}, {}, {}, std::string(text.shown)}; }
  ValueFacts operator()(const Path& path) const { return {"path", "", {}, {}, {}, std::string(path.shown)}; }
  ValueFacts operator()(const Paths&) const { return {"list of paths", "", {}, {}, {}, "PATH"}; }
  ValueFacts operator()(const NumberOrPath& either) const {
    ValueFacts facts = (*this)(either.number);
    facts.type = "number or path";
    facts.shown = either.shown;
    return facts;
  }
  ValueFacts operator()(const WholeNumbers& range) const {
    return {"list of whole numbers", "", range.least, range.greatest, {}, "N,N"};
  }
  ValueFacts operator()(const YesOrNo&) const { return {"true or false", "", {}, {}, {}, ""}; }
};

template <typename Table>
void AddTable(const char* section, const Table& table, std::vector<ListedKey>& list) {
  for (const auto& each : table) {
    const KeyDeclaration& key = each.declaration;
    list.push_back({section, std::string(key.key), std::string(key.flag), std::string(key.absent),
                    std::string(key.help), FactsOf(key.values)});
  }
}

void AddSigma(std::vector<ListedKey>& list) {
  for (const ErrorSource& source : kErrorSources) {
    const bool one = source.size() == 1;
    list.push_back({"sigma",
                    std::string(source.name),
                    "",
                    "of the error files, the sensor, or assumed",
                    absl::StrCat("Standard deviation", one ? ": " : absl::StrCat("s ", config::PartsText(source), ": "),
                                 std::string(source.doc)),
                    {one ? "number" : "3 numbers", UnitText(source.unit), 0, source.greatest, {}, ""}});
  }
}

}  // namespace

ValueFacts FactsOf(const KeyValues& values) { return std::visit(Describe(), values); }

std::vector<ListedKey> ListKeys() {
  std::vector<ListedKey> list;
  ForEachSection([&](std::string_view section, const auto& table, const auto&) {
    if (section == "output") AddSigma(list);
    AddTable(section.data(), table, list);
    if (section == "sensor") AddTable("sensor.channel", kChannelKeys, list);
    if (section == "water") AddTable("water.calibration", kCalibrationKeys, list);
  });
  return list;
}

std::string HelpText(const KeyDeclaration& key) {
  const std::string unit = FactsOf(key.values).unit;
  return absl::StrCat(std::string(key.help), unit.empty() ? "" : absl::StrCat(" [", unit, "]"),
                      key.absent.empty() ? "" : absl::StrCat(" (default: ", std::string(key.absent), ")"));
}

std::string RangeText(const ValueFacts& values) {
  if (!values.words.empty()) return absl::StrJoin(values.words, ", ");
  return values.least.has_value() ? absl::StrCat(*values.least, " to ", *values.greatest) : "";
}

}  // namespace albtpu::config
