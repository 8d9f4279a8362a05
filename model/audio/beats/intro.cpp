#include "model/audio/beats/intro.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/audio/beats/half_beats.h"
#include "model/audio/beats/onset_sums.h"
#include "model/audio/beats/same_tempo.h"

namespace choreo {
namespace {

using Path = std::vector<BarPointer::Step>;

double SoundOn(const OnsetSums& sums, std::span<const BarPointer::Step> beats) {
  double sum = 0;
  for (const BarPointer::Step& beat : beats) sum += sums.OnBeat(beat.frame);
  return sum;
}

}  // namespace

Path CountIntro(std::span<const Onset> onsets, Path path, const IntroOptions& options) {
  const std::vector<bool> strong = AreStrong(onsets, path);
  const auto drums = static_cast<size_t>(std::ranges::find(strong, true) - strong.begin());
  if (drums < 2 || drums + options.leading >= path.size()) return path;
  const std::span<const BarPointer::Step> own = std::span(path).first(drums);
  const double period = path[drums + options.leading / 2].period;
  const auto is_near = [period](double frames) {
    return std::abs(frames - period) <= std::max(1.0, kSameTempo * period);
  };
  const auto strays = [&](const BarPointer::Step& beat) { return !is_near(beat.period); };
  if (2 * std::ranges::count_if(own, strays) < std::ssize(own)) return path;
  const double bpm = 60 * kOnsetRate / period;
  BarPointer pointer(BarPatterns().first(1), {bpm * (1 - kSameTempo), bpm * (1 + kSameTempo)});
  const int64_t end = path[drums + options.leading].frame;
  for (const Onset& onset : onsets.first(static_cast<size_t>(end))) pointer.Add(onset);
  Path intro = pointer.Path();
  std::erase_if(intro, [&](const BarPointer::Step& beat) {
    return static_cast<double>(beat.frame) > static_cast<double>(path[drums].frame) - period / 2;
  });
  const OnsetSums sums(onsets);
  if (intro.empty() || !is_near(static_cast<double>(path[drums].frame - intro.back().frame)) ||
      SoundOn(sums, intro) < options.as_much * SoundOn(sums, own))
    return path;
  const int beats = path[drums].beats;
  for (size_t back = 1; back <= intro.size(); ++back) {
    BarPointer::Step& beat = intro[intro.size() - back];
    const int before = path[drums].in_bar - static_cast<int>(back % static_cast<size_t>(beats));
    beat.in_bar = (before + beats) % beats;
    beat.beats = beats;
    beat.pattern = path[drums].pattern;
  }
  intro.insert(intro.end(), path.begin() + static_cast<std::ptrdiff_t>(drums), path.end());
  return intro;
}

}  // namespace choreo
