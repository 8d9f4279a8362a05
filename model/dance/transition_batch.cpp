#include "model/dance/transition_batch.h"

#include "model/core/error.h"

namespace choreo {
namespace {

int FramesOf(const TransitionInput& given) { return given.stop.value_or(given.request.frames); }

struct Active {
  size_t index;
  TransitionRun run;
  int slot;
};

}  // namespace

std::vector<TransitionResult> DanceTransitions(StepEngine& engine,
                                               std::span<const TransitionInput> transitions,
                                               const std::function<void(int)>& danced) {
  const auto is_danced = [&](const Active& one) {
    return one.run.done() == FramesOf(transitions[one.index]);
  };
  std::vector<TransitionResult> results(transitions.size());
  std::vector<Active> active;
  size_t next = 0;
  try {
    while (next < transitions.size() || !active.empty()) {
      while (next < transitions.size() && engine.free_slots() > 0) {
        const TransitionInput& given = transitions[next];
        if (given.request.has_audio && (given.audio_rows.rows() != engine.model().audio_features ||
                                        given.audio_rows.cols() < FramesOf(given))) {
          throw InvalidArgument("audio_rows", "is not [audio_features, frames]");
        }
        TransitionRun run(engine.model(), given.request);
        const int slot = engine.Admit(run.spec());
        active.push_back({next++, std::move(run), slot});
      }
      std::vector<StepInput> inputs;
      for (const Active& one : active) {
        const TransitionInput& given = transitions[one.index];
        inputs.push_back({one.slot, one.run.previous(), {}});
        if (given.request.has_audio) {
          inputs.back().audio_row = {given.audio_rows.col(one.run.done()).data(),
                                     static_cast<size_t>(given.audio_rows.rows())};
        }
      }
      std::vector<StepOutput> outputs(inputs.size());
      engine.Step(inputs, outputs);
      for (size_t i = 0; i < active.size(); ++i) {
        auto& [index, run, slot] = active[i];
        results[index].frames.push_back(run.Take(outputs[i]));
        results[index].arrival = run.arrival();
        results[index].stage = run.stage();
        if (is_danced(active[i])) engine.Release(slot);
      }
      std::erase_if(active, is_danced);
      if (danced) danced(static_cast<int>(inputs.size()));
    }
  } catch (...) {
    for (const Active& one : active) engine.Release(one.slot);
    throw;
  }
  return results;
}

}  // namespace choreo
