#include "model/evaluation/runner.h"

#include <algorithm>

#include "model/dance/timeline.h"

namespace choreo {
namespace {

TransitionInput NextInput(const ModelInfo& model, const LongPlan& plan, const LongDance& chain) {
  const int at = static_cast<int>(chain.poses.size());
  const auto key = plan.keys.lower_bound(at);
  TransitionInput input;
  TransitionRequest& request = input.request;
  const auto next = key == plan.keys.end() ? std::nullopt : std::optional<int64_t>(key->first);
  const auto to = static_cast<int>(TransitionEnd(at, next, model.max_transition_frames));
  request.frames = to - at;
  input.stop = std::min(to, plan.frames) - at;
  if (next && *next + 1 == to) request.target = Target{key->second, {}};
  request.history = plan.history;
  request.stage = chain.stage;
  const auto known = std::min<std::ptrdiff_t>(at, model.history_frames);
  request.history.insert(request.history.end(), chain.poses.end() - known, chain.poses.end());
  request.beats = BeatsAround(plan.beats, /*fps=*/1, at, request.frames);
  request.seed = plan.seed;
  request.first_frame = at;
  request.temperature = plan.temperature;
  request.style = plan.style;
  if (!plan.finished) {
    request.arrival_frames = 0;
    request.footwork = false;
  }
  if (plan.audio.cols() > 0) {
    request.has_audio = true;
    request.audio_history = plan.audio.middleCols(at, model.history_frames);
    input.audio_rows = plan.audio.middleCols(at + model.history_frames, *input.stop);
  }
  return input;
}

}  // namespace

Dances Runner::Dance(StepEngine& engine, std::span<const TransitionInput> inputs) const {
  Dances dances;
  for (const TransitionResult& result : DanceTransitions(engine, inputs, danced_)) {
    std::vector<Pose>& poses = dances.emplace_back();
    for (const DanceFrame& frame : result.frames) poses.push_back(frame.pose);
  }
  return dances;
}

std::vector<LongDance> Runner::DanceLong(StepEngine& engine,
                                         std::span<const LongPlan> plans) const {
  std::vector<LongDance> chains(plans.size());
  while (true) {
    std::vector<TransitionInput> inputs;
    std::vector<size_t> whose;
    for (size_t i = 0; i < plans.size(); ++i) {
      if (static_cast<int>(chains[i].poses.size()) >= plans[i].frames) continue;
      inputs.push_back(NextInput(engine.model(), plans[i], chains[i]));
      whose.push_back(i);
    }
    if (inputs.empty()) return chains;
    const auto results = DanceTransitions(engine, inputs, danced_);
    for (size_t i = 0; i < results.size(); ++i) {
      LongDance& chain = chains[whose[i]];
      for (const DanceFrame& frame : results[i].frames) chain.poses.push_back(frame.pose);
      chain.stage = results[i].stage;
      if (results[i].arrival)
        chain.keys[static_cast<int>(chain.poses.size()) - 1] = results[i].arrival->final_error_m;
    }
  }
}

}  // namespace choreo
