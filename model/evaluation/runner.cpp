#include "model/evaluation/runner.h"

#include <algorithm>

#include "model/dance/timeline.h"

namespace choreo {
namespace {

// What comes next in a chain.
TransitionJob NextJob(const ModelInfo& model, const ChainPlan& plan, const Chain& chain) {
  const int at = static_cast<int>(chain.poses.size());
  const auto key = plan.keys.lower_bound(at);
  TransitionJob job;
  TransitionRequest& request = job.request;
  const int to = key != plan.keys.end() ? key->first + 1 : at + kFreeTransitionFrames;
  request.frames = std::min(to, plan.frames) - at;
  if (key != plan.keys.end()) request.target = WorldTarget{key->second, {}};
  request.history = plan.history;
  const auto known = std::min<std::ptrdiff_t>(at, model.history_frames);
  request.history.insert(request.history.end(), chain.poses.end() - known, chain.poses.end());
  request.beats = BeatsAround(plan.beats, /*fps=*/1, at, request.frames);
  request.seed = plan.seed;
  request.first_frame = at;
  request.temperature = plan.temperature;
  if (plan.audio.cols() > 0) {
    request.has_audio = true;
    request.audio_history = plan.audio.middleCols(at, model.history_frames);
    job.audio_rows = plan.audio.middleCols(at + model.history_frames, request.frames);
  }
  return job;
}

}  // namespace

std::vector<TransitionResult> Runner::Dance(StepEngine& engine,
                                            std::span<const TransitionJob> jobs) const {
  return DanceTransitions(engine, jobs, [this](int frames) {
    if (progress_ != nullptr) progress_->Advance(frames, what_);
  });
}

std::vector<Chain> Runner::DanceChains(StepEngine& engine, std::span<const ChainPlan> plans) const {
  std::vector<Chain> chains(plans.size());
  while (true) {
    std::vector<TransitionJob> jobs;
    std::vector<size_t> whose;
    for (size_t i = 0; i < plans.size(); ++i) {
      if (static_cast<int>(chains[i].poses.size()) >= plans[i].frames) continue;
      jobs.push_back(NextJob(engine.model(), plans[i], chains[i]));
      whose.push_back(i);
    }
    if (jobs.empty()) return chains;
    const auto results = Dance(engine, jobs);
    for (size_t i = 0; i < results.size(); ++i) {
      Chain& chain = chains[whose[i]];
      for (const DanceFrame& frame : results[i].frames) chain.poses.push_back(frame.pose);
      if (results[i].arrival) {
        chain.keys[static_cast<int>(chain.poses.size()) - 1] = results[i].arrival->final_error_m;
      }
    }
  }
}

}  // namespace choreo
