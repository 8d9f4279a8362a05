#include "tests/samplers/sampled.h"

#include <unistd.h>

#include <algorithm>
#include <optional>

#include "bench/random_checkpoints.h"
#include "model/core/numbers/random.h"
#include "model/motion/kinematics/kinematics.h"

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
  spec.arrival_frames = seed % 4 == 3 ? 6 : 0;
  if (seed % 2 == 1) {
    MusicRows& music = spec.music.emplace();
    music.history.resize(model.music_features.count, model.history_frames);
    music.rows.resize(model.music_features.count, frames);
    for (auto* rows : {&music.history, &music.rows})
      for (float& value : rows->reshaped()) value = static_cast<float>(random.Normal());
  }
  spec.seed = seed;
  spec.candidate = static_cast<uint32_t>(seed % 4);
  spec.first_frame = 1000 + static_cast<int64_t>(seed);
  spec.temperature = 0.7F;
  return spec;
}

std::vector<Plan> SampleInTurn(Sampler* sampler, std::span<const TransitionSpec> specs) {
  std::vector<std::optional<Slices<Plan>>> samplings;
  std::vector<ValidSpec> valid;
  for (const TransitionSpec& spec : specs) valid.emplace_back(spec, sampler->model());
  for (const ValidSpec& spec : valid) samplings.emplace_back(sampler->Sample(spec));
  std::vector<Plan> plans(specs.size());
  for (bool any = true; any;) {
    any = false;
    for (size_t i = 0; i < specs.size(); ++i) {
      if (!samplings[i]) continue;
      any = true;
      if (samplings[i]->Continue()) continue;
      plans[i] = samplings[i]->Take();
      samplings[i].reset();
    }
  }
  return plans;
}

// A likelihood is a sum of some 82 terms of about a nat that may cancel: what rounding does to it
// grows with the root of their number.
constexpr float kLikelihoodSize = 9;
double LargestDifference(const Plan& a, const Plan& b) {
  EXPECT_EQ(a.poses.size(), b.poses.size());
  EXPECT_EQ(a.log_likelihoods.size(), b.log_likelihoods.size());
  double largest = 0;
  for (size_t i = 0; i < a.poses.size(); ++i) {
    const Pose &one = a.poses[i], &other = b.poses[i];
    largest = std::max(largest, (one.root_position - other.root_position).cwiseAbs().maxCoeff());
    largest = std::max(largest, (one.rotations - other.rotations).cwiseAbs().maxCoeff());
  }
  EXPECT_EQ(a.contacts.size(), b.contacts.size());
  for (size_t i = 0; i < a.contacts.size(); ++i) {
    for (size_t foot = 0; foot < 4; ++foot)
      largest = std::max<double>(largest, std::abs(a.contacts[i][foot] - b.contacts[i][foot]));
  }
  for (size_t i = 0; i < a.log_likelihoods.size(); ++i) {
    const float wanted = a.log_likelihoods[i], made = b.log_likelihoods[i];
    EXPECT_TRUE(std::isfinite(made));
    largest = std::max<double>(
        largest, std::abs(wanted - made) / std::max(kLikelihoodSize, std::abs(wanted)));
  }
  return largest;
}

void ExpectSameBits(const Plan& a, const Plan& b) {
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (size_t t = 0; t < a.poses.size(); ++t) {
    ASSERT_EQ(a.poses[t].root_position, b.poses[t].root_position) << "frame " << t;
    ASSERT_EQ(a.poses[t].rotations, b.poses[t].rotations) << "frame " << t;
  }
  ASSERT_EQ(a.contacts, b.contacts);
  ASSERT_EQ(a.log_likelihoods, b.log_likelihoods);
}

}  // namespace choreo
