#include "server/calls/serving_cost.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "model/core/grid.h"
#include "model/core/limits.h"
#include "model/core/numbers/random.h"
#include "model/core/running/threads.h"
#include "model/dance/input/audio_feed.h"
#include "model/dance/input/dance_music.h"

namespace choreo {
namespace {

/// About this many frames and Looks count fully. Decoding one file beside a single dance must not
/// make all dances expensive.
constexpr double kMemoryFrames = 20 * kTypicalFrames, kMemoryLooks = 20;

double MeasureMusic() {
  constexpr int kRate = 44'100, kFrames = 2 * kTypicalFrames;
  std::vector<float> samples(static_cast<size_t>(kFrames * kRate / kModelFps));
  Random random(1);
  for (float& sample : samples) sample = static_cast<float>(0.1 * random.Normal());
  AudioFeed audio(kRate, 1, 0);
  const ModelInfo model;
  DanceMusic music(model, {}, kDefaultDynamics, &audio);
  const double begin = ThreadCpuSeconds();
  audio.Push(samples, 0, [] {});
  audio.Finish();
  for (int frame = 0; frame < kFrames; frame += kTypicalFrames)
    music.PlanFor({frame, frame + kTypicalFrames}, frame).Hear();
  return (ThreadCpuSeconds() - begin) / kFrames;
}

double MusicSecondsAFrame() {
  static const double measured = MeasureMusic();
  return measured;
}

}  // namespace

ServingCost::ServingCost() : ServingCost(MusicSecondsAFrame()) {}

ServingCost::ServingCost(double seconds_a_frame)
    : cores_(UsableCores()), seconds_(kMemoryFrames * seconds_a_frame), frames_(kMemoryFrames) {}

void ServingCost::Look(const Totals& now, bool dances_alone) {
  const std::lock_guard lock(mutex_);
  const std::optional<Totals> before = std::exchange(last_, now);
  if (!before || !dances_alone || now.dance_frames <= before->dance_frames) return;
  const auto frames = static_cast<double>(now.dance_frames - before->dance_frames);
  const double seconds = (now.cpu_s - before->cpu_s) - (now.sampling_s - before->sampling_s);
  const double kept = std::exp(-std::min(frames / kMemoryFrames, 1 / kMemoryLooks));
  seconds_ = std::max(0.0, kept * seconds_ + seconds);
  frames_ = kept * frames_ + frames;
}

double ServingCost::seconds_a_frame() const {
  const std::lock_guard lock(mutex_);
  return seconds_ / frames_;
}

double ServingCost::LoadOf(double frames_per_second) const {
  return frames_per_second * seconds_a_frame() / cores_;
}

}  // namespace choreo
