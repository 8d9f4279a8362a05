#include "client/cli/report/time_format.h"

#include <cmath>

#include "model/core/limits.h"
#include "model/core/rounded.h"

namespace choreo::cli {

std::string TimeFormat::Of(int64_t frame) const {
  const std::string told = Rounded(Second(frame)) + " s";
  const std::optional<double> count = Count(frame);
  return count ? Rounded(*count) + "c, " + told : told;
}

std::optional<double> TimeFormat::Count(int64_t frame) const {
  if (counts.beats.size() < 2) return std::nullopt;
  const auto count_at = [&](double off) {
    return authoring::CountAt(Second(frame) + off / fps, counts);
  };
  const double part = std::round(4 * count_at(0)) / 4;
  // The first frame may have a key of the frame beside it (FrameForKey).
  const double beyond = frame == 0 ? kMinKeyDistance - 0.5 : 0.5;
  const bool is_part = count_at(-0.5) <= part && part <= count_at(beyond);
  const double count = is_part ? part : count_at(0);
  return count < 0 ? std::nullopt : std::optional(count);
}

}  // namespace choreo::cli
