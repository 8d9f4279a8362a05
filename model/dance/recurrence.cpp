#include "model/dance/recurrence.h"

#include <algorithm>
#include <cmath>

#include "model/audio/format.h"
#include "model/core/error.h"
#include "model/core/limits.h"
#include "model/dance/validation.h"

namespace choreo {
namespace {

constexpr double kShortestApart_s = 0.5;  // of cuts

}  // namespace

void CheckPassages(std::span<const Passage> passages, const std::string& field) {
  if (passages.size() > kMostPassages) {
    throw InvalidArgument(field, std::to_string(passages.size()) + " passages, the limit is " +
                                     std::to_string(kMostPassages));
  }
  double end = 0;
  for (size_t i = 0; i < passages.size(); ++i) {
    const Passage& passage = passages[i];
    const std::string at = field + "[" + std::to_string(i) + "]";
    const auto check = [&](const char* name, double seconds, double least, double most,
                           bool is_inside) {
      const bool good = seconds >= least && (is_inside ? seconds < most : seconds <= most);
      if (!good) {
        throw InvalidArgument(at + name, Show(seconds) + " s is not in [" + Show(least) + ", " +
                                             Show(most) + (is_inside ? ")" : "]"));
      }
    };
    check(".from", passage.from, end, kMaxAudioSeconds, true);
    check(".to", passage.to, passage.from, kMaxAudioSeconds, false);
    check(".like", passage.like, 0, passage.from, true);
    end = passage.to;
  }
}

Recurrence::Recurrence(double fps, std::span<const Passage> passages) : fps_(fps) {
  Give(passages, 0);
}

void Recurrence::Give(std::span<const Passage> passages, int64_t from) {
  if (passages.empty()) return;
  const auto frame = [this](double seconds) -> int64_t { return std::llround(seconds * fps_); };
  const int64_t begin = std::max<int64_t>(from, frame(passages.front().from));
  std::erase_if(stretches_, [begin](const Stretch& one) { return one.from >= begin; });
  if (!stretches_.empty()) stretches_.back().to = std::min(stretches_.back().to, begin);
  for (const Passage& passage : passages) {
    const int64_t first = frame(passage.from);
    const Stretch stretch{std::max(first, begin), frame(passage.to), first - frame(passage.like)};
    if (stretch.to <= stretch.from || stretch.lag <= 0) continue;
    const bool goes_on = !stretches_.empty() && stretches_.back().to == stretch.from &&
                         stretches_.back().lag == stretch.lag;
    if (goes_on) {
      stretches_.back().to = stretch.to;
    } else {
      stretches_.push_back(stretch);
    }
  }
  Cut();
}

int64_t Recurrence::Origin(int64_t frame) const {
  for (size_t left = stretches_.size(); left > 0;) {
    const Stretch& stretch = stretches_[--left];
    if (frame < stretch.from || frame >= stretch.to) continue;
    // What it is like may have come back itself, within the same stretch, too.
    frame -= stretch.lag;
    if (frame >= stretch.from) ++left;
  }
  return frame;
}

std::vector<int64_t> Recurrence::Origins(int64_t from, int64_t to) const {
  std::vector<int64_t> origins;
  bool any = false;
  for (int64_t frame = from; frame < to; ++frame) {
    origins.push_back(Origin(frame));
    any |= origins.back() != frame;
  }
  return any ? origins : std::vector<int64_t>();
}

void Recurrence::Cut() {
  std::vector<int64_t> all;
  for (const Stretch& stretch : stretches_)
    all.insert(all.end(),
               {stretch.from - stretch.lag, stretch.to - stretch.lag, stretch.from, stretch.to});
  std::ranges::sort(all);
  cuts_.clear();
  const auto apart = static_cast<int64_t>(std::lround(kShortestApart_s * fps_));
  for (const int64_t frame : all) {
    if (cuts_.empty() || frame - cuts_.back() >= apart) cuts_.push_back(frame);
  }
}

}  // namespace choreo
