#include "model/dance/input/recurrence.h"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <set>

#include "model/audio/signal/format.h"
#include "model/core/error.h"
#include "model/core/grid.h"
#include "model/dance/timeline/validation.h"

namespace choreo {

void CheckPassages(std::span<const Passage> passages, const std::string& field) {
  double end = kMinReturn_s;
  for (size_t i = 0; i < passages.size(); ++i) {
    const Passage& passage = passages[i];
    const std::string at = field + "[" + std::to_string(i) + "]";
    const auto check = [&](const char* name, double seconds, double least, double most) {
      if (seconds >= least && seconds <= most) return;
      throw InvalidArgument(
          at + name, Show(seconds) + " s is not in [" + Show(least) + ", " + Show(most) + "]");
    };
    check(".from", passage.from, end, kMaxAudioSeconds);
    check(".to", passage.to, passage.from, kMaxAudioSeconds);
    check(".like", passage.like, 0, passage.from - kMinReturn_s);
    end = passage.to;
  }
}

Recurrence::Recurrence(double fps, std::span<const Passage> passages)
    : fps_(fps), count_(passages.size()) {
  Apply(passages, 0);
}

void Recurrence::Give(std::span<const Passage> passages, int64_t from, const std::string& field) {
  if (count_ + passages.size() > kMaxPassages) {
    throw InvalidArgument(field, std::to_string(count_ + passages.size()) +
                                     " passages in all, the limit is " +
                                     std::to_string(kMaxPassages));
  }
  count_ += passages.size();
  given_.push_back({from, {passages.begin(), passages.end()}});
}

void Recurrence::StartTransition(int64_t frame) {
  for (; !given_.empty() && given_.front().from <= frame; given_.pop_front())
    Apply(given_.front().passages, given_.front().from);
}

void Recurrence::Apply(std::span<const Passage> passages, int64_t from) {
  if (passages.empty()) return;
  const auto frame = [this](double seconds) -> int64_t { return std::llround(seconds * fps_); };
  const int64_t begin = std::max<int64_t>(from, frame(passages.front().from));
  std::erase_if(stretches_, [begin](const Stretch& one) { return one.from >= begin; });
  if (!stretches_.empty()) stretches_.back().to = std::min(stretches_.back().to, begin);
  for (const Passage& passage : passages) {
    const int64_t first = frame(passage.from);
    const Stretch stretch{std::max(first, begin), frame(passage.to), first - frame(passage.like)};
    if (stretch.to <= stretch.from) continue;
    const bool goes_on = !stretches_.empty() && stretches_.back().to == stretch.from &&
                         stretches_.back().lag == stretch.lag;
    if (goes_on) {
      stretches_.back().to = stretch.to;
    } else {
      stretches_.push_back(stretch);
    }
  }
}

int64_t Recurrence::Origin(int64_t frame) const {
  for (size_t left = stretches_.size(); left > 0;) {
    const Stretch& stretch = stretches_[--left];
    if (frame < stretch.from || frame >= stretch.to) continue;
    // The original may be a repetition itself, even within the same stretch.
    frame -= stretch.lag;
    if (frame >= stretch.from) ++left;
  }
  return frame;
}

std::optional<int64_t> Recurrence::NextCut(int64_t least) const {
  for (int64_t frame = least; frame <= least + kTypicalFrames; ++frame) {
    if (Origin(frame) % kTypicalFrames == 0) return frame;
  }
  return std::nullopt;
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

std::vector<int64_t> CutsOf(std::span<const Passage> passages, double fps) {
  struct Stretch {
    int64_t from, to, lag;
  };
  std::vector<Stretch> stretches;
  std::set<int64_t> cuts;
  for (const Passage& passage : passages) {
    const int64_t from = std::llround(passage.from * fps), to = std::llround(passage.to * fps);
    const int64_t lag = from - std::llround(passage.like * fps);
    stretches.push_back({from, to, lag});
    cuts.insert({from - lag, to - lag, from, to});
  }
  // Copies cuts to the first originals, and from them to all repetitions.
  for (const auto& [from, to, lag] : std::views::reverse(stretches)) {
    for (auto cut = cuts.find(to); *cut > from; --cut) cuts.insert(*cut - lag);
  }
  for (const auto& [from, to, lag] : stretches) {
    for (auto cut = cuts.find(from - lag); *cut < to - lag; ++cut) cuts.insert(*cut + lag);
  }
  const std::vector<int64_t> bounds(cuts.begin(), cuts.end());
  const auto fill = [&](int64_t from, int64_t to) {
    for (auto bound = std::ranges::lower_bound(bounds, from); *bound < to; ++bound) {
      for (int64_t cut = *bound + kTypicalFrames; cut + kTypicalFrames / 2 <= bound[1];
           cut += kTypicalFrames)
        cuts.insert(cut);
    }
  };
  for (const auto& [from, to, lag] : stretches) {
    fill(from - lag, to - lag);
    fill(from, to);
  }
  return {cuts.begin(), cuts.end()};
}

}  // namespace choreo
