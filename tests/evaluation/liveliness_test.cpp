#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "model/dance/delivery/quality_meter.h"
#include "model/evaluation/judges/interpolation_sampler.h"
#include "model/evaluation/judges/long_plans.h"
#include "model/evaluation/tables/liveliness_figures.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/support/fake_sampler.h"
#include "tests/support/synthetic_clips.h"

namespace choreo::liveliness_test {

using testing_support::SyntheticClip;

const Skeleton& Body() { return Skeleton::Smpl24(); }

ClipSet Clips(int frames) {
  return {"set",
          {SyntheticClip("walk_a", frames, 0.1, false), SyntheticClip("turn_b", frames, 0.9, false),
           SyntheticClip("short_c", 300, 0.5, false)}};
}

EvalOptions Short() {
  EvalOptions options;
  options.temperature = 0.3F;
  options.lengths = {10, 30};
  options.windows_per_clip = 2;
  options.best_of = 3;
  options.long_frames = 300;
  options.free_dances = 4;
  return options;
}

TEST(KeyedDances, TakeTheWholeClipUpToAMinuteFromItsMiddle) {
  const ModelInfo model = FakeSampler().model();
  const ClipSet set = Clips(780);
  const auto plans = PlanKeyedDances(model, set, 0.5F);
  ASSERT_EQ(plans.size(), 2U);  // ten seconds are too few
  for (const LongPlan& plan : plans) {
    EXPECT_EQ(plan.start, 10 + 25);
    EXPECT_EQ(plan.frames, 720);
    EXPECT_EQ(plan.keys.size(), 12U);
    EXPECT_EQ(plan.keys.rbegin()->first, 719);
    EXPECT_EQ(plan.history.size(), 10U);
    EXPECT_EQ(plan.audio.cols(), 0);
    EXPECT_TRUE(plan.beats.empty());
    const std::vector<Pose> beside = RealMotionBeside(plan, set);
    for (const auto& [frame, pose] : plan.keys)
      EXPECT_EQ(beside[static_cast<size_t>(frame)].rotations, pose.rotations);
  }
  EXPECT_EQ(PlanKeyedDances(model, Clips(2500), 0)[0].frames, 1800);
}

TEST(KeyedDances, BeatsAreRegularOrShuffled) {
  const std::vector<double> beats = RegularBeats(90, 0.5, 30, 1800);
  EXPECT_LT(beats.front(), -20);
  EXPECT_GT(beats.back(), 1800);
  for (size_t i = 0; i < beats.size(); ++i)
    EXPECT_NEAR(std::fmod(beats[i] + 100, 20), 10, 1e-6) << beats[i];
  const std::vector<double> shuffled = ShuffledBeats(90, 1, 30, 1800);
  EXPECT_EQ(shuffled, ShuffledBeats(90, 1, 30, 1800));
  EXPECT_NE(shuffled, ShuffledBeats(90, 2, 30, 1800));
  EXPECT_NEAR(static_cast<double>(shuffled.size()), static_cast<double>(beats.size()), 10);
  for (size_t i = 1; i < shuffled.size(); ++i) {
    EXPECT_GE(shuffled[i] - shuffled[i - 1], 10);
    EXPECT_LE(shuffled[i] - shuffled[i - 1], 30);
  }
}

TEST(KeyedDances, FootworkKeepsKeysOfRealMotionAndReducesSkating) {
  const ModelInfo model = FakeSampler().model();
  // A standing dancer, pulled over the floor.
  ClipSet set = Clips(780);
  for (int t = 0; t < 780; ++t) {
    Pose& pose = set.clips[0].motion.frames[static_cast<size_t>(t)];
    pose = RestPose(Body());
    pose.root_position.z() += 0.4 * t / 30;
  }
  const LongPlan plan = PlanKeyedDances(model, set, 0)[0];
  const std::vector<Pose> standing = RealThroughFootwork(model, plan, set);
  ASSERT_EQ(standing.size(), 720U);
  for (const auto& [frame, pose] : plan.keys)
    EXPECT_LT(ComparePoses(Body(), standing[static_cast<size_t>(frame)], pose).position_m, 1e-3);
  EXPECT_LT(MeasureLiveliness(model, plan, standing).skate_ratio,
            0.5 * MeasureLiveliness(model, plan, RealMotionBeside(plan, set)).skate_ratio);
}

TEST(KeyedDances, ArmsInsideTheTrunkAreCounted) {
  const ModelInfo model = FakeSampler().model();
  const ClipSet set = Clips(780);
  const LongPlan plan = PlanKeyedDances(model, set, 0)[0];
  std::vector<Pose> poses(99, StandingPose(Body()));
  LongPlan standing = plan;
  standing.history.back() = poses.front();
  standing.keys.clear();
  EXPECT_EQ(MeasureLiveliness(model, standing, poses).arms_inside, 0);
  for (size_t frame = 50; frame < 75; ++frame) {
    poses[frame].rotations.col(Body().left_shoulder) =
        LogMap(ExpMap({0, 0, -1.3}) * ExpMap({0, -0.16, 0}));
    poses[frame].rotations.col(Body().left_elbow) = LogMap(ExpMap({0, 0, -1.4}));
  }
  EXPECT_NEAR(MeasureLiveliness(model, standing, poses).arms_inside, 0.25, 1e-9);
}

// A dance whose mean joint speed peaks every `period` frames from `first` on.
LivelinessFigures Nodding(double period, double first) {
  LivelinessFigures figures;
  for (int step = 0; step < 600; ++step) {
    // speeds[i] belongs to frame i + 1 of the track, which is frame i of the dance.
    figures.speeds.push_back(static_cast<float>(1 + std::cos(2 * M_PI * (step - first) / period)));
  }
  return figures;
}

TEST(HitsOverChance, AreHighOnTheBeatAndLowBesideIt) {
  // 90 a minute: one every 20 frames; five frames count.
  EXPECT_NEAR(HitsOverChance({Nodding(20, 0)}, 90, 0, 30).value, 75, 3);
  EXPECT_NEAR(HitsOverChance({Nodding(20, 10)}, 90, 0, 30).value, -25, 3);
  EXPECT_NEAR(HitsOverChance({Nodding(20, 10)}, 90, 0.5, 30).value, 75, 3);
  // Nodding twice as often hits with half; another tempo hits by chance alone.
  EXPECT_NEAR(HitsOverChance({Nodding(10, 0)}, 90, 0, 30).value, 25, 3);
  EXPECT_NEAR(HitsOverChance({Nodding(17, 0)}, 90, 0, 30).value, 0, 5);
}

std::vector<Table> Evaluate(const ClipSet& set, const std::vector<Method>& methods) {
  const EvalOptions options = Short();
  const Runner runner;
  const Evaluation evaluation{set, methods, options, runner};
  std::vector<Table> tables = EvaluateLiveliness(evaluation);
  std::ranges::move(EvaluateNearness(evaluation), std::back_inserter(tables));
  return tables;
}

double Value(const Table& table, const std::string& figure, const std::string& column) {
  const auto row = std::ranges::find_if(
      table.rows, [&](const TableRow& one) { return one.labels[0] == figure; });
  const auto at = std::ranges::find(table.columns, column, &Column::heading);
  if (row == table.rows.end() || at == table.columns.end()) return NAN;
  return row->cells[static_cast<size_t>(at - table.columns.begin())].value;
}

TEST(Liveliness, InterpolationMovesInStraightLines) {
  InterpolationSampler line(FakeSampler().model());
  Method method{"model", Method::Kind::kModel, &line};
  method.finished = false;  // feet that step are no straight line
  const auto tables = Evaluate(Clips(780), {method});
  const auto figure = [&](const std::string& name, const std::string& column) {
    const double value = Value(tables[0], name, column);
    EXPECT_TRUE(std::isfinite(value)) << name << ", " << column;
    return value;
  };
  EXPECT_LT(figure("limbs' path over chord m/m", "danced ÷ real"), 0.95);
  EXPECT_LT(figure("jerk below 8 Hz m/s³", "danced ÷ real"), 0.9);
  EXPECT_GE(figure("limbs' path over chord m/m", "danced"), 1);
  EXPECT_EQ(figure("seeds differ cm", "danced"), 0);
  EXPECT_EQ(figure("songs differ, 90 and 130 bpm cm", "danced"), 0);
  EXPECT_GT(figure("critic's area under the curve", "danced"), 0.9);
  // Without a key it stands.
  EXPECT_EQ(figure("free: frozen %", "danced"), 100);
  EXPECT_EQ(figure("free: exploded %", "danced"), 0);
  for (const TableRow& row : tables.back().rows) {
    EXPECT_GE(row.cells[1].value, 0.99) << row.labels[0];
    EXPECT_LE(row.cells[1].value, 1.7) << row.labels[0];
    EXPECT_DOUBLE_EQ(row.cells[3].value, row.cells[2].value);  // all samples are one
  }
}

TEST(Liveliness, SeparatesSeedsAndSongsAndIsDeterministic) {
  FakeSampler sampler;
  const ClipSet set = Clips(700);
  InterpolationSampler line(sampler.model());
  // A method that is not the judged one has its name in its tables; one without a network has no
  // tables.
  const std::vector<Method> methods = {{"other", Method::Kind::kModel, &sampler},
                                       {"line", Method::Kind::kModel, &line, true, false},
                                       {"model", Method::Kind::kModel, &sampler}};
  const auto tables = Evaluate(set, methods);
  const auto again = Evaluate(set, methods);
  ASSERT_EQ(tables.size(), 8U);
  for (size_t i = 0; i < tables.size(); ++i) EXPECT_EQ(ToJson(tables[i]), ToJson(again[i]));
  EXPECT_EQ(tables[0].name, "liveliness_set_other");
  EXPECT_GT(Value(tables[0], "seeds differ cm", "danced"), 0);
  EXPECT_EQ(Value(tables[0], "songs differ, half a beat apart cm", "danced"), 0);  // it is deaf
  for (const TableRow& row : tables[0].rows) {
    EXPECT_EQ(row.cells.size(), tables[0].columns.size());
    EXPECT_TRUE(std::isfinite(row.cells[2].value)) << row.labels[0];
  }
  EXPECT_EQ(tables[1].name, "liveliness_bands_set_other");
  EXPECT_EQ(tables[2].name, "weight_set_other");
  EXPECT_EQ(tables[3].name, "liveliness_set");
  EXPECT_EQ(ToJson(tables[3])["rows"], ToJson(tables[0])["rows"]);
  EXPECT_EQ(tables[1].rows[0].labels[0], "pelvis");
  for (const TableRow& row : tables.back().rows) EXPECT_LE(row.cells[3].value, row.cells[2].value);
}

TEST(Liveliness, ClipsThatAreTooShortHaveNoRows) {
  FakeSampler sampler;
  const auto tables = Evaluate(Clips(400), {{"model", Method::Kind::kModel, &sampler}});
  EXPECT_TRUE(std::isnan(Value(tables[0], "median speed cm/s", "danced")));
  EXPECT_TRUE(std::isfinite(Value(tables[0], "free: frozen %", "danced")));
}

}  // namespace choreo::liveliness_test
