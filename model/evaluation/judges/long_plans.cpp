#include "model/evaluation/judges/long_plans.h"

#include <algorithm>
#include <cmath>

#include "model/core/grid.h"
#include "model/core/numbers/random.h"
#include "model/plan/footwork.h"

namespace choreo {
namespace {

constexpr int kEqualInterval = 100;
constexpr int kMinInterval = 15;  // between keys on beats
constexpr int kMinSeconds = 20, kMaxSpans = 30;

// The pose at frame `at` of a clip that is played forwards, backwards, forwards, ...
const Pose& PoseBackAndForth(const PreparedClip& clip, int at) {
  const int last = static_cast<int>(clip.motion.frames.size()) - 1;
  const int phase = at % (2 * std::max(last, 1));
  return clip.motion.frames[static_cast<size_t>(std::min(last, std::min(phase, 2 * last - phase)))];
}

int IntervalOf(KeyTimes times) {
  return times == KeyTimes::kEachTwoSeconds ? kTypicalFrames : kEqualInterval;
}

std::vector<int> KeyFrames(KeyTimes times, int interval, int frames,
                           const std::vector<double>& beats) {
  std::vector<int> keys;
  if (times == KeyTimes::kNone) return keys;
  for (int equal = interval - 1; equal < frames; equal += interval) {
    int frame = equal;
    if (times == KeyTimes::kOnBeats && !beats.empty()) {
      const auto nearest = std::ranges::min_element(
          beats, {}, [equal](double beat) { return std::abs(beat - equal); });
      frame = static_cast<int>(std::lround(*nearest));
    }
    const int earliest = keys.empty() ? kMinInterval : keys.back() + kMinInterval;
    if (frame >= earliest && frame < frames) keys.push_back(frame);
  }
  return keys;
}

}  // namespace

std::vector<LongPlan> PlanLongDances(const ModelInfo& model, const ClipSet& set, KeyTimes times,
                                     int count, const EvalOptions& options) {
  const int history = model.history_frames;
  const auto clips = static_cast<int>(set.clips.size());
  std::vector<LongPlan> plans;
  for (int i = 0; i < count; ++i) {
    LongPlan plan;
    plan.clip = static_cast<size_t>(i % clips);
    const PreparedClip& clip = set.clips[plan.clip];
    const auto length = static_cast<int>(clip.motion.frames.size());
    if (length <= history) continue;
    const bool music = clip.audio.cols() > 0;
    const int spare = std::max(0, length - history - (music ? options.long_frames : 1));
    const int places = (count + clips - 1) / clips;
    plan.start = history + (places > 1 ? spare * (i / clips) / (places - 1) : 0);
    plan.frames = music ? std::min(options.long_frames, length - plan.start) : options.long_frames;
    plan.history = RealPoses(set, {plan.clip, plan.start}, 0, history);
    if (music) plan.audio = clip.audio.middleCols(plan.start - history, history + plan.frames);
    plan.beats = set.BeatsBetween(plan.clip, plan.start, plan.frames);
    for (const int frame : KeyFrames(times, IntervalOf(times), plan.frames, plan.beats))
      plan.keys[frame] = PoseBackAndForth(clip, plan.start + frame);
    plan.seed = static_cast<uint64_t>(i);
    plan.temperature = options.temperature;
    plans.push_back(std::move(plan));
  }
  return plans;
}

std::vector<Pose> RealMotionBeside(const LongPlan& plan, const ClipSet& set) {
  std::vector<Pose> poses;
  for (int frame = 0; frame < plan.frames; ++frame)
    poses.push_back(PoseBackAndForth(set.clips[plan.clip], plan.start + frame));
  return poses;
}

std::vector<LongPlan> PlanKeyedDances(const ModelInfo& model, const ClipSet& set, float temperature,
                                      int interval) {
  std::vector<LongPlan> plans;
  for (size_t clip = 0; clip < set.clips.size(); ++clip) {
    const std::vector<Pose>& poses = set.clips[clip].motion.frames;
    if (static_cast<double>(poses.size()) < kMinSeconds * model.fps) continue;
    const int usable = static_cast<int>(poses.size()) - model.history_frames;
    const int spans = std::min(usable / kTypicalFrames, kMaxSpans);
    LongPlan plan;
    plan.clip = clip;
    plan.start = model.history_frames + (usable - spans * kTypicalFrames) / 2;
    plan.frames = spans * kTypicalFrames;
    plan.temperature = temperature;
    plan.history = RealPoses(set, {plan.clip, plan.start}, 0, model.history_frames);
    for (const int key : KeyFrames(KeyTimes::kEachTwoSeconds, interval, plan.frames, {}))
      plan.keys[key] = poses[plan.start + key];
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

std::vector<Pose> RealThroughFootwork(const ModelInfo& model, const LongPlan& plan,
                                      const ClipSet& set) {
  const std::vector<Pose> real = RealMotionBeside(plan, set);
  std::vector<Pose> emitted = plan.history;
  size_t from = 0;
  const auto stand = [&](size_t to, bool keyed) {
    std::vector<Pose> piece(real.begin() + static_cast<std::ptrdiff_t>(from),
                            real.begin() + static_cast<std::ptrdiff_t>(to));
    StandOnFeet({.skeleton = model.skeleton,
                 .history = std::span(emitted).last(plan.history.size()),
                 .keyed = keyed,
                 .fps = model.fps,
                 .options = model.plan_options.footwork},
                &piece);
    std::vector<Pose> standing;
    for (const Pose& pose : piece) standing.push_back(RoundToFloat(pose));
    emitted.insert(emitted.end(), standing.begin(), standing.end());
    from = to;
  };
  for (const auto& [key, pose] : plan.keys) stand(static_cast<size_t>(key) + 1, true);
  if (from < real.size()) stand(real.size(), false);
  emitted.erase(emitted.begin(), emitted.begin() + std::ssize(plan.history));
  return emitted;
}

}  // namespace choreo
