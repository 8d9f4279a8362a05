#include "client/cli/options.h"

#include <charconv>
#include <cmath>

namespace choreo::cli {
namespace {

/// Empty where the text is a finite number that `holds`.
template <typename Predicate>
CLI::Validator NumberThat(const std::string& limit, const std::string& name,
                          const Predicate& holds) {
  return {[limit, holds](const std::string& text) -> std::string {
            double value = 0;
            const bool is_number = CLI::detail::lexical_cast(text, value);
            if (is_number && std::isfinite(value) && holds(value)) return {};
            return text + " is not " + limit;
          },
          name};
}

}  // namespace

const CLI::Validator& AboveZero() {
  static const CLI::Validator kCheck =
      NumberThat("a number above 0", "> 0", [](double value) { return value > 0; });
  return kCheck;
}

const CLI::Validator& AtLeastZero() {
  static const CLI::Validator kCheck =
      NumberThat("a number of at least 0", ">= 0", [](double value) { return value >= 0; });
  return kCheck;
}

const CLI::Validator& AtLeastOne() {
  static const CLI::Validator kCheck =
      NumberThat("a whole number of at least 1", ">= 1",
                 [](double value) { return value >= 1 && value == std::floor(value); });
  return kCheck;
}

void AddSeed(CLI::App& command, std::optional<uint64_t>& seed, const std::string& help) {
  static const CLI::Validator kCheck(
      [](const std::string& text) -> std::string {
        uint64_t value = 0;
        const char* end = text.data() + text.size();
        const auto [stop, code] = std::from_chars(text.data(), end, value);
        if (code == std::errc() && stop == end) return {};
        return text + " is not a whole number from 0 to 18446744073709551615";
      },
      "");
  command.add_option("--seed", seed, help)->check(kCheck);
}

}  // namespace choreo::cli
