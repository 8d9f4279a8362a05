#include "client/cli/report/time_format.h"

#include <cmath>

#include "model/core/rounded.h"

namespace choreo::cli {

std::string TimeFormat::Of(int64_t frame) const {
  const double second = static_cast<double>(frame) / fps;
  const std::string told = Rounded(second) + " s";
  if (counts.beats.size() < 2) return told;
  const auto count_at = [&](double off) { return authoring::CountAt(second + off / fps, counts); };
  // Shows the frame nearest to count 9 as 9c.
  const double part = std::round(4 * count_at(0)) / 4;
  const bool is_part = count_at(-0.5) <= part && part <= count_at(0.5);
  const double count = is_part ? part : count_at(0);
  return count < 0 ? told : Rounded(count) + "c, " + told;
}

}  // namespace choreo::cli
