#include "model/evaluation/keyed_dances.h"

#include <algorithm>

#include "model/core/random.h"
#include "model/dance/foot_lock.h"

namespace choreo {
namespace {

constexpr int kSpan = 60;  // frames between keys
constexpr int kFewestSeconds = 20, kMostSpans = 30;

}  // namespace

std::vector<LongPlan> PlanKeyedDances(const ModelInfo& model, const ClipSet& set,
                                      float temperature) {
  std::vector<LongPlan> plans;
  for (size_t clip = 0; clip < set.clips.size(); ++clip) {
    const std::vector<Pose>& poses = set.clips[clip].motion.frames;
    if (static_cast<double>(poses.size()) < kFewestSeconds * model.fps) continue;
    const int usable = static_cast<int>(poses.size()) - model.history_frames;
    const int spans = std::min(usable / kSpan, kMostSpans);
    LongPlan plan;
    plan.clip = clip;
    plan.start = model.history_frames + (usable - spans * kSpan) / 2;
    plan.frames = spans * kSpan;
    plan.temperature = temperature;
    const auto first = poses.begin() + plan.start;
    plan.history.assign(first - model.history_frames, first);
    for (int key = kSpan - 1; key < plan.frames; key += kSpan) plan.keys[key] = first[key];
    plans.push_back(std::move(plan));
  }
  return plans;
}

std::vector<double> RegularBeats(double bpm, double phase, double fps, int frames) {
  const double period = 60 * fps / bpm;
  std::vector<double> beats;
  for (double at = (phase - 2) * period; at < frames + 2 * period; at += period)
    beats.push_back(at);
  return beats;
}

std::vector<double> ShuffledBeats(double bpm, uint64_t seed, double fps, int frames) {
  const double period = 60 * fps / bpm;
  Random random(seed);
  std::vector<double> beats;
  for (double at = -2 * period; at < frames + 2 * period; at += period * random.Uniform(0.5, 1.5))
    beats.push_back(at);
  return beats;
}

std::vector<Pose> RealThroughFootLock(const ModelInfo& model, const LongPlan& plan,
                                      const ClipSet& set) {
  const std::vector<Pose> real = RealMotionBeside(plan, set);
  std::vector<Pose> emitted = plan.history;
  int from = 0;
  for (const auto& [key, pose] : plan.keys) {
    const int frames = key + 1 - from;
    if (FootLock::Fits(model.skeleton, model.fps, frames)) {
      FootLock lock(model.skeleton, model.fps, frames, emitted, Target{pose, {}});
      for (; from <= key; ++from) emitted.push_back(RoundToFloat(lock.Apply(real[from])));
    }
    for (; from <= key; ++from) emitted.push_back(real[from]);
  }
  emitted.erase(emitted.begin(), emitted.begin() + std::ssize(plan.history));
  return emitted;
}

}  // namespace choreo
