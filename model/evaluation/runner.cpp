#include "model/evaluation/runner.h"

#include <algorithm>

#include "model/dance/timeline/timeline.h"

namespace choreo {
namespace {

/// The next transition of a long dance, and how many of its frames are used.
struct Next {
  TransitionSpec spec;
  int danced;
};

Next NextOf(const ModelInfo& model, const LongPlan& plan, const LongDance& chain) {
  const int at = static_cast<int>(chain.poses.size());
  const auto key = plan.keys.lower_bound(at);
  Next out;
  TransitionSpec& spec = out.spec;
  const auto next = key == plan.keys.end() ? std::nullopt : std::optional<int64_t>(key->first);
  const int longest = LongestToKey(model.max_transition_frames, model.sight_frames);
  const auto to = static_cast<int>(TransitionEnd(at, next, longest));
  spec.frames = to - at;
  out.danced = std::min(to, plan.frames) - at;
  if (next && *next + 1 == to) {
    spec.target = Target{key->second, {}};
  } else if (next && IsInSight(at, *next, model.sight_frames)) {
    spec.later = {Target{key->second, {}}, static_cast<int>(*next + 1 - to)};
  }
  spec.history = plan.history;
  spec.stage = chain.stage;
  const auto known = std::min<std::ptrdiff_t>(at, model.history_frames);
  spec.history.insert(spec.history.end(), chain.poses.end() - known, chain.poses.end());
  spec.beats = BeatsAround(plan.beats, /*fps=*/1, at, spec.frames);
  spec.seed = plan.seed;
  spec.first_frame = at;
  spec.temperature = plan.temperature;
  spec.style = plan.style;
  if (!plan.finished) {
    spec.arrival_frames = 0;
    spec.footwork = false;
  }
  if (plan.audio.cols() > 0 && model.music_features) {
    const int history = model.history_frames;
    // The dance ends with the plan, even if the audio is longer.
    MusicRows& music = spec.music.emplace();
    music.history = plan.audio.middleCols(at, history);
    music.rows = Eigen::MatrixXf::Zero(plan.audio.rows(), spec.frames);
    music.rows.leftCols(out.danced) = plan.audio.middleCols(at + history, out.danced);
  }
  return out;
}

}  // namespace

Dances Runner::Dance(Sampler& sampler, std::span<const TransitionSpec> requests) const {
  Dances dances;
  for (const TransitionSpec& request : requests) {
    std::vector<Pose>& poses = dances.emplace_back();
    const TransitionRun run = DanceTransition(sampler, request, danced_);
    for (const DanceFrame& frame : run.frames()) poses.push_back(frame.pose);
  }
  return dances;
}

std::vector<LongDance> Runner::DanceLong(Sampler& sampler, std::span<const LongPlan> plans) const {
  std::vector<LongDance> chains;
  for (const LongPlan& plan : plans) {
    LongDance& chain = chains.emplace_back();
    while (static_cast<int>(chain.poses.size()) < plan.frames) {
      const Next next = NextOf(sampler.model(), plan, chain);
      const TransitionRun run = DanceTransition(sampler, next.spec, danced_);
      const auto danced = static_cast<size_t>(next.danced);
      for (size_t i = 0; i < danced; ++i) chain.poses.push_back(run.frames()[i].pose);
      chain.stage = run.StateAfter(danced).stage;
      if (run.arrival() && danced == run.frames().size())
        chain.keys[static_cast<int>(chain.poses.size()) - 1] = run.arrival()->final_error_m;
    }
  }
  return chains;
}

}  // namespace choreo
