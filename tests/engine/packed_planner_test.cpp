#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "model/engine/engines.h"
#include "model/motion/rotation.h"
#include "tests/engine/engine_dances.h"

// The packed planner against LibTorch's.
namespace choreo {
namespace {

using Planner = std::shared_ptr<const TransitionPlanner>;

struct Planners {
  explicit Planners(const std::filesystem::path& path)
      : torch(MakeTransitionPlanner(path, {}, EngineKind::kTorch)),
        packed(MakeTransitionPlanner(path, {}, EngineKind::kPacked)),
        model(MakeEngine(path, {}, 1, EngineKind::kPacked)->model()) {}
  Planner torch, packed;
  ModelInfo model;
};

// Metres, radians, and the condition's own units.
double LargestDifference(const TransitionPlan& a, const TransitionPlan& b) {
  EXPECT_EQ(a.poses.size(), b.poses.size());
  EXPECT_EQ(a.static_condition.size(), b.static_condition.size());
  double largest = 0;
  for (size_t i = 0; i < a.poses.size(); ++i) {
    const Pose &one = a.poses[i], &other = b.poses[i];
    largest = std::max(largest, (one.root_position - other.root_position).cwiseAbs().maxCoeff());
    for (Eigen::Index joint = 0; joint < one.rotations.cols(); ++joint) {
      largest = std::max(
          largest, RotationDifference(one.rotations.col(joint), other.rotations.col(joint)).norm());
    }
  }
  for (size_t i = 0; i < a.static_condition.size(); ++i) {
    largest = std::max<double>(largest, std::abs(a.static_condition[i] - b.static_condition[i]));
  }
  return largest;
}

bool SameBits(const TransitionPlan& a, const TransitionPlan& b) {
  return a.static_condition == b.static_condition &&
         std::ranges::equal(a.poses, b.poses, [](const Pose& one, const Pose& other) {
           return one.root_position == other.root_position && one.rotations == other.rotations;
         });
}

class PackedPlannerTest : public testing::TestWithParam<Shape> {
 protected:
  PackedPlannerTest() : checkpoint_(GetParam()) { SetTorchThreads(1); }
  SmallCheckpoint checkpoint_;
};

INSTANTIATE_TEST_SUITE_P(Shapes, PackedPlannerTest,
                         testing::Values(Shape::kPlannerAndPerceptron, Shape::kPlannerOnCondition,
                                         Shape::kPerceptronOnCondition, Shape::kEncodedRecurrent),
                         [](const auto& instance) { return ShapeName(instance.param); });

TEST_P(PackedPlannerTest, PlansAsLibTorchDoes) {
  const Planners planners(checkpoint_.path());
  // Seeds make different masks, no key among them; some lengths have no wave of variety.
  for (const uint64_t seed : {7, 8, 9, 10, 15}) {
    for (const int frames : {1, 2, 4, 12, 60, 200}) {
      const TransitionSpec spec = RandomSpec(planners.model, seed, frames);
      EXPECT_LT(LargestDifference(planners.packed->Plan(spec), planners.torch->Plan(spec)), 1e-4)
          << "seed " << seed << ", " << frames << " frames";
    }
  }
}

TEST(PackedPlanner, PlansTheShippedModelAsLibTorchDoes) {
  SetTorchThreads(1);
  const Planners planners(std::filesystem::path(CHOREO_SOURCE_DIR) /
                          "model/checkpoints/free.safetensors");
  for (const uint64_t seed : {7, 9, 10}) {
    for (const int frames : {5, 30, 60, 150}) {
      const TransitionSpec spec = RandomSpec(planners.model, seed, frames);
      EXPECT_LT(LargestDifference(planners.packed->Plan(spec), planners.torch->Plan(spec)), 1e-4)
          << "seed " << seed << ", " << frames << " frames";
    }
  }
}

// A key half a turn away: whichever way round is gone, both go it.
TEST(PackedPlanner, TurnsTheWayThatLibTorchTurns) {
  SetTorchThreads(1);
  const Planners planners(std::filesystem::path(CHOREO_SOURCE_DIR) /
                          "model/checkpoints/free.safetensors");
  for (const double rate : {-0.2, 0.2}) {
    TransitionSpec spec = RandomSpec(planners.model, 7, 30);
    for (size_t t = 0; t < spec.history.size(); ++t)
      spec.history[t].rotations.col(0) = Eigen::Vector3d(0, rate * static_cast<double>(t), 0);
    spec.target->pose.rotations.col(0) =
        spec.history.back().rotations.col(0) + Eigen::Vector3d(0, 2.9, 0);
    EXPECT_LT(LargestDifference(planners.packed->Plan(spec), planners.torch->Plan(spec)), 1e-4);
  }
}

// Behind its first second a plan that no root position leads goes nowhere (temperature 0: nothing
// but the plan), whichever engine makes it.
TEST(PackedPlanner, APlanThatIsLedNowhereStaysWhereItIs) {
  SetTorchThreads(1);
  const Planners planners(std::filesystem::path(CHOREO_SOURCE_DIR) /
                          "model/checkpoints/free.safetensors");
  for (const bool key : {false, true}) {
    TransitionSpec spec = RandomSpec(planners.model, 7, 90);
    spec.temperature = 0;
    if (key) {
      spec.target->mask.root_position = false;
    } else {
      spec.target.reset();
    }
    for (const Planner& planner : {planners.packed, planners.torch}) {
      const TransitionPlan plan = planner->Plan(spec);
      Eigen::Vector3d walked = plan.poses[89].root_position - plan.poses[45].root_position;
      walked.y() = 0;
      EXPECT_LT(walked.norm(), 1e-4) << key;
    }
  }
  TransitionSpec led = RandomSpec(planners.model, 7, 90);
  led.target->mask.root_position = true;
  led.target->pose.root_position = led.history.back().root_position + Eigen::Vector3d(2, 0, 0);
  const TransitionPlan plan = planners.packed->Plan(led);
  EXPECT_GT((plan.poses[89].root_position - plan.poses[45].root_position).norm(), 0.3);
}

// Plans that are made at once, of all lengths, have the bits that they have alone.
TEST_P(PackedPlannerTest, APlanIsTheSameWhateverElseIsPlanned) {
  const Planners planners(checkpoint_.path());
  const auto spec = [&](int i) {
    return RandomSpec(planners.model, static_cast<uint64_t>(i), 3 + 17 * (i % 11));
  };
  constexpr int kPlans = 40, kThreads = 3;
  std::vector<TransitionPlan> alone;
  for (int i = 0; i < kPlans; ++i) {
    const Planner fresh = MakeTransitionPlanner(checkpoint_.path(), {}, EngineKind::kPacked);
    std::thread([&] { alone.push_back(fresh->Plan(spec(i))); }).join();  // a scratch of its own
  }
  std::vector<std::thread> threads;
  std::vector<int> differing(kThreads);
  for (int thread = 0; thread < kThreads; ++thread) {
    threads.emplace_back([&, thread] {
      for (int n = 0; n < kPlans; ++n) {
        const int i = (n * (2 * thread + 1) + thread) % kPlans;
        if (!SameBits(planners.packed->Plan(spec(i)), alone[static_cast<size_t>(i)]))
          ++differing[static_cast<size_t>(thread)];
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(differing, std::vector<int>(kThreads));
}

}  // namespace
}  // namespace choreo
