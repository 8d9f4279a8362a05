#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "model/evaluation/evaluation.h"
#include "model/evaluation/judges/interpolation_sampler.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/support/fake_sampler.h"
#include "tests/support/synthetic_clips.h"

namespace choreo::control_tables_test {

using testing_support::SyntheticClip;

/// Dances like the fake model, but beside its path.
class BesideSampler : public ControlledSampler {
 public:
  explicit BesideSampler(double metres) : metres_(metres) {}
  void OnFrame(const TransitionSpec& /*spec*/, Plan* plan) override {
    plan->poses.back().root_position.x() += metres_;
  }

 private:
  double metres_;
};

/// Keeps its posture and swings the left shoulder at the requested speed: the mean speed of the
/// arm's joints is exactly the factor.
class SwingingSampler : public ControlledSampler {
 public:
  void OnFrame(const TransitionSpec& spec, Plan* plan) override {
    Pose& drawn = plan->poses.back();
    const auto frame = plan->poses.size() - 1;
    Pose pose = frame == 0 ? spec.history.back() : plan->poses[frame - 1];
    const double asked = drawn.rotations(0, model_.skeleton.Find(kTellingJoints[1]));
    const double turn = 2 * std::asin(asked / (2 * MeanRadius(pose)));
    const double side = frame % 2 == 0 ? -1 : 1;
    const int shoulder = model_.skeleton.left_shoulder;
    // About an axis of its own, which the turn does not move.
    pose.rotations.col(shoulder) = LogMap(ExpMap(side * turn * Eigen::Vector3d::UnitZ()) *
                                          ExpMap(pose.rotations.col(shoulder)));
    pose.root_position = drawn.root_position;
    drawn = pose;
  }

 private:
  // Of the arm's joints from that axis, by their shares in the factor.
  double MeanRadius(const Pose& pose) const {
    const Skeleton& skeleton = model_.skeleton;
    const JointPlacement placed = ForwardKinematics(skeleton, pose);
    const auto parent =
        static_cast<size_t>(skeleton.parents[static_cast<size_t>(skeleton.left_shoulder)]);
    const Eigen::Vector3d axis = placed.rotations[parent].col(2);
    const Eigen::Vector3d centre = placed.positions.col(skeleton.left_shoulder);
    const BodyPartWeights weights = WeighBodyParts(skeleton);
    double radius = 0;
    for (int joint = 0; joint < skeleton.joints(); ++joint) {
      // The collar and the shoulder stand still.
      bool moves = false;
      for (int at = joint; at > 0; at = skeleton.parents[static_cast<size_t>(at)])
        moves = moves || at == skeleton.left_shoulder;
      if (!moves) continue;
      const Eigen::Vector3d from = placed.positions.col(joint) - centre;
      radius += weights(1, joint) * from.cross(axis).norm();
    }
    return radius;
  }
};

using Evaluate = std::vector<Table> (*)(const Evaluation&);

/// Makes only the tables that a test needs.
class ControlTablesTest : public testing::Test {
 protected:
  std::vector<Table> TablesOf(Evaluate evaluate, const std::vector<Method>& methods) const {
    const Runner runner;
    return evaluate({set_, methods, options_, runner});
  }
  double Figure(const std::string& table, const std::vector<std::string>& row,
                const std::string& column) {
    const Table& of = Named(table + "_set");
    const auto at = std::ranges::find(of.columns, column, &Column::heading) - of.columns.begin();
    const auto line = std::ranges::find(of.rows, row, &TableRow::labels);
    if (line == of.rows.end()) return std::nan("");
    return line->cells[static_cast<size_t>(at)].value;
  }

  const ClipSet set_ = {
      "set", {SyntheticClip("walk_a", 300, 0.1, false), SyntheticClip("turn_b", 300, 0.9, false)}};
  InterpolationSampler line_{ControlledSampler().model()};
  BesideSampler near_{0.05}, beside_{0.09};
  SwingingSampler swinging_;
  FakeSampler plain_;
  const std::vector<Method> methods_ = {{"real", Method::Kind::kReal},
                                        {"still", Method::Kind::kModel, &line_, false},
                                        {"near", Method::Kind::kModel, &near_},
                                        {"beside", Method::Kind::kModel, &beside_},
                                        {"swinging", Method::Kind::kModel, &swinging_},
                                        {"plain", Method::Kind::kModel, &plain_},
                                        {"model", Method::Kind::kModel, &line_, true, true, false}};
  const EvalOptions options_{.windows_per_clip = 1};
  std::vector<Table> tables_;  // evaluated so far

 private:
  const Table& Named(const std::string& name) {
    const auto known = std::ranges::find(tables_, name, &Table::name);
    if (known != tables_.end()) return *known;
    const Evaluate evaluate = name == "multipliers_set" || name == "constant_set"
                                  ? EvaluateMultipliers
                              : name == "repetition_set" ? EvaluateRepetition
                              : name == "drawn_set"      ? EvaluateDrawnPaths
                                                         : EvaluateControls;
    std::ranges::move(TablesOf(evaluate, methods_), std::back_inserter(tables_));
    return *std::ranges::find(tables_, name, &Table::name);
  }
};

TEST_F(ControlTablesTest, RealMotionIsTheYardstick) {
  for (const std::string length : {"10", "50", "100", "150"}) {
    EXPECT_EQ(Figure("lrp", {"real"}, length), 0);
    EXPECT_EQ(Figure("lrp_ratio", {"real"}, length), 0);
    EXPECT_EQ(Figure("lrp_turned", {"real"}, length), 0);
    EXPECT_EQ(Figure("avf", {"real"}, length), 1);
    EXPECT_EQ(Figure("art", {"real"}, length), 1);
    EXPECT_GE(Figure("control_skate", {"real"}, length), 0);
  }
  for (const std::string_view part : kBodyPartNames)
    EXPECT_DOUBLE_EQ(Figure("multipliers", {"real", "1.0"}, std::string(part)), 1);
  EXPECT_EQ(Figure("repetition", {"real"}, "still at the end, 250"), 0);
  // Every table has as many rows as there are methods.
  for (const Table& table : tables_) {
    if (table.label_headings.size() != 1) continue;
    EXPECT_EQ(table.rows.size(), 2U + 2 * 5 + 1) << table.name;
  }
}

TEST_F(ControlTablesTest, InterpolationIsTheUnitForEverySampler) {
  for (const std::string length : {"50", "150"}) {
    EXPECT_EQ(Figure("lrp_ratio", {"interpolation"}, length), 1);
    EXPECT_NEAR(Figure("lrp_ratio", {"model, network alone"}, length), 1, 1e-3);
    EXPECT_EQ(Figure("art", {"model, network alone"}, length), 1);
    EXPECT_GT(Figure("lrp", {"interpolation"}, length), 1);
    // Without keys it never leaves its posture.
    EXPECT_GT(Figure("lrp_ratio", {"still"}, length), 1);
  }
  EXPECT_GT(Figure("multipliers", {"interpolation", "1.0"}, "left_arm"), 0);
  EXPECT_TRUE(std::isnan(Figure("multipliers", {"interpolation", "0.5"}, "left_arm")));
}

TEST_F(ControlTablesTest, ARootWithinSevenCentimetresCounts) {
  EXPECT_EQ(Figure("art", {"near, network alone"}, "100"), 1);
  EXPECT_EQ(Figure("art", {"beside, network alone"}, "100"), 0);
  EXPECT_EQ(Figure("art", {"near, network alone"}, "mean"), 1);
  // A method without paths does not get the path.
  EXPECT_LT(Figure("art", {"plain, network alone"}, "150"), 1);
}

TEST_F(ControlTablesTest, FactorsMultiplySpeeds) {
  for (const auto& [times, scale] :
       std::map<std::string, double>{{"0.5", 0.5}, {"1.0", 1}, {"1.5", 1.5}}) {
    EXPECT_NEAR(Figure("multipliers", {"swinging, network alone", times}, "left_arm"), scale, 0.01);
    EXPECT_NEAR(Figure("multipliers", {"swinging, network alone", times}, "right_arm"), 0, 1e-4);
  }
  // One that takes none has the one row.
  EXPECT_FALSE(std::isnan(Figure("multipliers", {"plain", "1.0"}, "left_arm")));
  EXPECT_TRUE(std::isnan(Figure("multipliers", {"plain", "0.5"}, "left_arm")));
}

TEST_F(ControlTablesTest, ConstantFactorsAreComparedWithTheReference) {
  for (const auto& [times, scale] :
       std::map<std::string, double>{{"0.5", 0.5}, {"1.0", 1}, {"1.5", 1.5}}) {
    EXPECT_NEAR(Figure("constant", {"swinging, network alone", times}, "left_arm"), scale, 0.01);
    EXPECT_NEAR(Figure("constant", {"swinging, network alone", times}, "right_arm"), 0, 1e-4);
  }
  // Real dancers had no requests: their speeds are their own.
  const double own = Figure("constant", {"real", "1.0"}, "left_arm");
  EXPECT_GT(std::abs(own - 1), 0.01);
  EXPECT_TRUE(std::isnan(Figure("constant", {"plain", "0.5"}, "left_arm")));
}

TEST_F(ControlTablesTest, SwingingMotionIsRepetitive) {
  EXPECT_GT(Figure("repetition", {"swinging, network alone"}, "repeated, 250"), 0.5);
  EXPECT_LT(Figure("repetition", {"real"}, "repeated, 250"), 0.5);
}

TEST_F(ControlTablesTest, DrawnPathsAreFollowedAndEndAtTheKey) {
  for (const std::string path : {"as danced", "straight", "on the spot", "a bow"}) {
    EXPECT_LT(Figure("drawn", {path, "model"}, "root off path mean cm"), 1) << path;
    EXPECT_LT(Figure("drawn", {path, "model"}, "key missed cm"), 0.01) << path;
    EXPECT_NEAR(Figure("drawn", {path, "near, network alone"}, "root off path mean cm"), 5, 1e-3);
    // The fake model itself misses keys slightly.
    EXPECT_NEAR(Figure("drawn", {path, "near, network alone"}, "key missed cm"), 5, 0.5) << path;
    // A method without paths can't take one.
    EXPECT_TRUE(std::isnan(Figure("drawn", {path, "plain"}, "skating"))) << path;
  }
  EXPECT_GT(Figure("drawn", {"as danced", "real"}, "root asked m/s"), 0);
  EXPECT_TRUE(std::isnan(Figure("drawn", {"a bow", "real"}, "skating")));
  // A bow is a detour; on the spot only the height changes, and stopping.
  const auto asked = [&](const std::string& path) {
    return Figure("drawn", {path, "interpolation"}, "root asked m/s");
  };
  EXPECT_GT(asked("a bow"), asked("straight") + 0.1);
  EXPECT_LT(asked("on the spot"), 0.15);
}

TEST_F(ControlTablesTest, OmitsTransitionsThatAreTooLongForTheModel) {
  class Brief : public ControlledSampler {
   public:
    Brief() { model_.max_transition_frames = 150; }
  } brief;
  const std::vector<Method> methods = {{"brief", Method::Kind::kModel, &brief},
                                       {"model", Method::Kind::kModel, &line_}};
  const Table table = TablesOf(EvaluateRepetition, methods).at(0);
  const auto row =
      std::ranges::find(table.rows, std::vector<std::string>{"brief"}, &TableRow::labels);
  ASSERT_NE(row, table.rows.end());
  // Two cells a length: 150 frames are the second, 200 the third.
  EXPECT_FALSE(std::isnan(row->cells[2].value));
  EXPECT_TRUE(std::isnan(row->cells[4].value));
}

TEST_F(ControlTablesTest, ModelWithoutControlsHasNoTables) {
  for (const Evaluate evaluate :
       {EvaluateControls, EvaluateMultipliers, EvaluateRepetition, EvaluateDrawnPaths})
    EXPECT_TRUE(TablesOf(evaluate, {{"model", Method::Kind::kModel, &plain_}}).empty());
}

}  // namespace choreo::control_tables_test
