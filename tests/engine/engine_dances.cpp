#include "tests/engine/engine_dances.h"

#include <unistd.h>

#include <algorithm>

#include "bench/random_checkpoints.h"
#include "model/core/random.h"
#include "model/motion/kinematics.h"

namespace choreo {
namespace {

Pose RandomPose(Random* random, const Pose& base, double size) {
  Pose pose = base;
  for (double& value : pose.root_position) value += size * random->Normal();
  for (double& value : pose.rotations.reshaped()) value += size * random->Normal();
  return pose;
}

}  // namespace

std::string ShapeName(Shape shape) { return shape == Shape::kRaw ? "Raw" : "Encoded"; }

FlowConfig SmallConfig(Shape shape) {
  FlowConfig config;
  config.name = "random-weights-of-a-test";
  config.flow_steps = 2;
  config.hidden = 24;
  config.max_transition_frames = 200;
  config.temperature = 0.4;
  if (shape == Shape::kEncoded) {
    config.condition_width = 20;
    config.innovations = true;
  }
  return config;
}

SmallCheckpoint::SmallCheckpoint(Shape shape) {
  // Tests may run side by side, and so may whole builds.
  std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
  std::ranges::replace(name, '/', '_');
  path_ = std::filesystem::path(testing::TempDir()) /
          ("engine_" + ShapeName(shape) + name + "_" + std::to_string(getpid()) + ".safetensors");
  WriteRandomCheckpoint(path_, SmallConfig(shape), Skeleton::Smpl24(), 3);
}

SmallCheckpoint::~SmallCheckpoint() { std::filesystem::remove(path_); }

TransitionSpec RandomSpec(const ModelInfo& model, uint64_t seed, int frames) {
  Random random(seed);
  TransitionSpec spec;
  spec.frames = frames;
  Pose pose = RandomPose(&random, RestPose(model.skeleton), 0.2);
  for (int t = 0; t < model.history_frames; ++t) {
    pose = RandomPose(&random, pose, 0.02);
    spec.history.push_back(pose);
  }
  spec.target = Target{RandomPose(&random, pose, 0.3), {}};
  if (seed % 3 == 0) {
    spec.target->mask.root_position = false;
    spec.target->mask.joints.assign(static_cast<size_t>(model.skeleton.joints()), true);
    spec.target->mask.joints[5] = false;
  }
  if (seed % 5 == 0) spec.target.reset();
  spec.has_audio = seed % 2 == 1;
  if (spec.has_audio) {
    spec.audio_history.resize(model.audio_features, model.history_frames);
    for (float& value : spec.audio_history.reshaped()) value = static_cast<float>(random.Normal());
  }
  spec.seed = seed;
  spec.candidate = static_cast<uint32_t>(seed % 4);
  spec.first_frame = 1000 + static_cast<int64_t>(seed);
  spec.temperature = 0.7F;
  return spec;
}

std::vector<float> RandomAudioRow(const ModelInfo& model, uint64_t seed, int frame) {
  std::vector<float> row(static_cast<size_t>(model.audio_features));
  FillNormal(seed, 77, frame, row);
  return row;
}

Pose Emit(const Pose& raw, int frame) {
  Pose pose = raw;
  pose.root_position.x() += 0.001 * frame;
  pose.rotations(1, 3) += 0.002;
  return pose;
}

void DanceTogether(StepEngine* engine, std::vector<Dancer>* dancers) {
  for (int frame = 0;; ++frame) {
    std::vector<StepInput> inputs;
    std::vector<std::vector<float>> rows;
    std::vector<Dancer*> stepping;
    for (Dancer& dancer : *dancers) {
      if (frame < dancer.spec.frames) stepping.push_back(&dancer);
    }
    if (stepping.empty()) return;
    for (Dancer* dancer : stepping) {
      rows.push_back(dancer->spec.has_audio
                         ? RandomAudioRow(engine->model(), dancer->spec.seed, frame)
                         : std::vector<float>());
      inputs.push_back({dancer->slot, frame > 0 ? &dancer->emitted.back() : nullptr, rows.back()});
    }
    std::vector<StepOutput> outputs(stepping.size());
    engine->Step(inputs, outputs);
    for (size_t i = 0; i < stepping.size(); ++i) {
      stepping[i]->outputs.push_back(outputs[i]);
      stepping[i]->emitted.push_back(Emit(outputs[i].pose, frame));
    }
  }
}

std::vector<StepOutput> DanceAlone(StepEngine* engine, const TransitionSpec& spec) {
  std::vector<Dancer> one(1);
  one[0] = {spec, engine->Admit(spec), {}, {}};
  DanceTogether(engine, &one);
  engine->Release(one[0].slot);
  return one[0].outputs;
}

void ExpectSameBits(const std::vector<StepOutput>& a, const std::vector<StepOutput>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t t = 0; t < a.size(); ++t) {
    ASSERT_EQ(a[t].pose.root_position, b[t].pose.root_position) << "frame " << t;
    ASSERT_EQ(a[t].pose.rotations, b[t].pose.rotations) << "frame " << t;
    ASSERT_EQ(a[t].contacts, b[t].contacts) << "frame " << t;
    ASSERT_EQ(a[t].log_likelihood, b[t].log_likelihood) << "frame " << t;
  }
}

// A likelihood is a sum of some 82 terms of about a nat that may cancel: what rounding does to it
// grows with the root of their number.
constexpr float kLikelihoodSize = 9;
double LargestStepDifference(StepEngine* reference, StepEngine* other, uint64_t seed, int frames) {
  const ModelInfo& model = reference->model();
  const TransitionSpec spec =
      RandomSpec(model, seed, std::min(frames, model.max_transition_frames));
  EXPECT_EQ(reference->Admit(spec), other->Admit(spec));
  std::vector<StepInput> in(1);
  std::vector<StepOutput> expected(1), actual(1);
  Pose previous;
  double largest = 0;
  for (int frame = 0; frame < spec.frames; ++frame) {
    const std::vector<float> row = RandomAudioRow(model, seed, frame);
    in[0] = {0, frame > 0 ? &previous : nullptr, {}};
    if (spec.has_audio) in[0].audio_row = row;
    reference->Step(in, expected);
    other->Step(in, actual);
    const Pose &a = expected[0].pose, &b = actual[0].pose;
    largest = std::max(largest, (a.root_position - b.root_position).cwiseAbs().maxCoeff());
    largest = std::max(largest, (a.rotations - b.rotations).cwiseAbs().maxCoeff());
    for (size_t foot = 0; foot < 4; ++foot) {
      largest = std::max<double>(largest,
                                 std::abs(expected[0].contacts[foot] - actual[0].contacts[foot]));
    }
    EXPECT_EQ(expected[0].log_likelihood.has_value(), actual[0].log_likelihood.has_value());
    if (expected[0].log_likelihood && actual[0].log_likelihood) {
      const float wanted = *expected[0].log_likelihood, made = *actual[0].log_likelihood;
      largest = std::max<double>(
          largest, std::abs(wanted - made) / std::max(kLikelihoodSize, std::abs(wanted)));
      EXPECT_TRUE(std::isfinite(made));
    }
    previous = Emit(a, frame);
  }
  return largest;
}

}  // namespace choreo
