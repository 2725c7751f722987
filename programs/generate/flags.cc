#include "programs/generate/flags.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>

#include "programs/command_line/checks.h"

namespace albtpu::programs {

CLI::Validator NumberIn(double least, double most, bool open_below) {
  const std::string remedy = std::string("give a number ") + (open_below ? "above " : "from ") +
                             CLI::detail::to_string(least) + (open_below ? " and up to " : " to ") +
                             CLI::detail::to_string(most);
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        double x = 0;
        const bool number = CLI::detail::lexical_cast(text, x);
        if (number && std::isfinite(x) && x <= most && (open_below ? x > least : x >= least)) return {};
        return "'" + text + "' is not a finite number in the range; " + remedy;
      },
      "", "number");
}

CLI::Validator Seed() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        std::int64_t seed = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
        if (error == std::errc() && end == text.data() + text.size() && seed >= 0) return {};
        return "'" + text + "' is not a seed; give a whole number from 0 to 9223372036854775807";
      },
      "", "seed");
}

void AddThreads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Number of threads (default: all cores)")
      ->type_name("N")
      ->check(WholeIn(1, 4096));
}

}  // namespace albtpu::programs
