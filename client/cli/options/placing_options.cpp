#include "client/cli/options/placing_options.h"

#include <charconv>
#include <cmath>

#include "client/cli/options/options.h"
#include "model/core/error.h"

namespace choreo::cli {

std::vector<double> ParseNumbers(std::string_view text, const std::string& field) {
  std::vector<double> numbers;
  while (true) {
    const std::string_view item = text.substr(0, text.find(','));
    double number = 0;
    const char* end = item.data() + item.size();
    const auto [stop, code] = std::from_chars(item.data(), end, number);
    if (code != std::errc() || stop != end || !std::isfinite(number))
      throw InvalidArgument(field, "\"" + std::string(item) + "\" is not a number");
    numbers.push_back(number);
    if (item.size() == text.size()) return numbers;
    text.remove_prefix(item.size() + 1);
  }
}

void AddPlacing(CLI::App& command, authoring::Placing& placing, const std::string& whose) {
  command
      .add_option_function<std::string>(
          "--place",
          [&placing](const std::string& text) {
            const std::vector<double> numbers = ParseNumbers(text, "--place");
            if (numbers.size() != 2)
              throw InvalidArgument("--place", "\"" + text + "\" is not X,Z, metres");
            placing.place = {numbers[0], numbers[1]};
          },
          "X,Z: where " + whose + " stands, metres.")
      ->type_name("X,Z");
  command
      .add_option(
          "--facing", placing.facing,
          "Degrees that say which way " + whose + " faces: 0 is to the audience, 90 along x.")
      ->check(NumberFrom(-authoring::kMaxFacing, authoring::kMaxFacing));
}

}  // namespace choreo::cli
