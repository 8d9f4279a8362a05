#include "client/describe_styles.h"

#include <cmath>

namespace choreo::client {

std::string DescribeStyles(const std::optional<StyleFigures>& figures) {
  if (!figures) return "Whether they show was not measured.";
  const auto percent = [](double share) { return std::to_string(std::llround(share)) + " %"; };
  return std::string(figures->shows() ? "They show" : "They do not show") + ": in " +
         percent(figures->recognised) +
         " of seconds a classifier recognises the requested style, by chance in " +
         percent(figures->chance) + ".";
}

}  // namespace choreo::client
