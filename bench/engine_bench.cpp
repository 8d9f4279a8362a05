#include <benchmark/benchmark.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "model/engine/engines.h"
#include "model/motion/kinematics.h"

/// Frames a second of an engine, by how many streams step together. Run it on a quiet machine and
/// quote ratios.
namespace choreo {
namespace {

constexpr int kFrames = 60;  // of each transition

StepEngine& Engine() {
  static const std::unique_ptr<StepEngine> engine = MakeEngine(
      std::filesystem::path(CHOREO_SOURCE_DIR) / "model/checkpoints/default.safetensors", Device{},
      64);
  return *engine;
}

TransitionSpec Spec(const ModelInfo& model, uint64_t seed) {
  TransitionSpec spec;
  spec.frames = kFrames;
  spec.history.assign(static_cast<size_t>(model.history_frames), RestPose(model.skeleton));
  Pose key = RestPose(model.skeleton);
  key.root_position.x() += 0.5;
  spec.target = Target{key, {}};
  spec.seed = seed;
  spec.temperature = static_cast<float>(model.default_temperature);
  return spec;
}

// Whole transitions, admission (the plan) included.
void TransitionsTogether(benchmark::State& state) {
  StepEngine& engine = Engine();
  const auto streams = static_cast<size_t>(state.range(0));
  std::vector<StepInput> inputs(streams);
  std::vector<StepOutput> outputs(streams);
  std::vector<Pose> previous(streams);
  for (auto _ : state) {
    for (size_t i = 0; i < streams; ++i) {
      inputs[i] = {};
      inputs[i].slot = engine.Admit(Spec(engine.model(), i));
    }
    for (int frame = 0; frame < kFrames; ++frame) {
      engine.Step(inputs, outputs);
      for (size_t i = 0; i < streams; ++i) {
        previous[i] = outputs[i].pose;
        inputs[i].previous = &previous[i];
      }
    }
    for (const StepInput& input : inputs) engine.Release(input.slot);
  }
  state.SetItemsProcessed(state.iterations() * kFrames * static_cast<int64_t>(streams));  // frames
}
BENCHMARK(TransitionsTogether)
    ->Arg(1)
    ->Arg(16)
    ->Arg(64)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace choreo

BENCHMARK_MAIN();
