#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "model/evaluation/beat_table.h"
#include "model/evaluation/long_figures.h"
#include "model/evaluation/long_plans.h"
#include "model/evaluation/long_tables.h"
#include "model/evaluation/stress_table.h"
#include "model/motion/kinematics.h"
#include "tests/support/fake_engine.h"
#include "tests/support/synthetic_clips.h"

namespace choreo {
namespace {

using testing_support::SyntheticClip;

const Skeleton& Body() { return Skeleton::Smpl24(); }

ClipSet Clips(bool music) {
  return {"set",
          {SyntheticClip("walk_a", 200, 0.1, music), SyntheticClip("turn_b", 230, 0.9, music)}};
}

EvalOptions Short() {
  EvalOptions options;
  options.temperature = 0.3F;
  options.long_frames = 300;
  options.long_seeds = 4;
  return options;
}

TEST(DanceChains, ReachTheirKeysAndGoOnAlone) {
  const ClipSet set = Clips(false);
  FakeEngine engine(3);
  const auto plans = PlanLongDances(engine.model(), set, KeyTimes::kEachTwoSeconds, 4, Short());
  ASSERT_EQ(plans.size(), 4U);
  std::vector<ChainPlan> chains;
  for (const LongPlan& plan : plans) chains.push_back(plan.chain);
  const auto danced = DanceChains(engine, chains);
  for (size_t i = 0; i < chains.size(); ++i) {
    ASSERT_EQ(danced[i].poses.size(), 300U);
    EXPECT_EQ(danced[i].keys.size(), 5U);
    for (const auto& [frame, error] : danced[i].keys) {
      EXPECT_LE(error, 1e-3);
      EXPECT_LT(ComparePoses(Body(), danced[i].poses[static_cast<size_t>(frame)],
                             chains[i].keys.at(frame))
                    .position_m,
                1e-3);
    }
    const Chain alone = DanceChains(engine, {&chains[i], 1}).front();
    for (size_t t = 0; t < 300; ++t)
      ASSERT_EQ(alone.poses[t].rotations, danced[i].poses[t].rotations);
  }
}

TEST(PlanLongDances, BesideMusicADanceEndsWithIt) {
  const ClipSet set = Clips(true);
  for (const LongPlan& plan :
       PlanLongDances(FakeEngine(1).model(), set, KeyTimes::kNone, 2, Short())) {
    EXPECT_EQ(plan.start, 10);
    EXPECT_EQ(plan.chain.frames, static_cast<int>(set.clips[plan.clip].motion.frames.size()) - 10);
    EXPECT_EQ(plan.chain.audio.cols(), plan.chain.frames + 10);
  }
}

TEST(PlanLongDances, KeysOnBeatsStandOnTheBeatNearestToTheEqualOnes) {
  ClipSet set = Clips(true);
  std::vector<double> beats;
  for (double at = 0; at < 230; at += 24) beats.push_back(at);  // of the clip
  set.beats = {beats, beats};
  const ModelInfo model = FakeEngine(1).model();
  const auto equal = PlanLongDances(model, set, KeyTimes::kEqual, 2, Short());
  const auto on = PlanLongDances(model, set, KeyTimes::kOnBeats, 2, Short());
  ASSERT_EQ(equal[1].chain.keys.size(), 2U);
  EXPECT_TRUE(equal[1].chain.keys.contains(99));
  ASSERT_EQ(on[1].chain.keys.size(), 2U);
  for (const auto& [frame, pose] : on[1].chain.keys) {
    EXPECT_EQ((frame + on[1].start) % 24, 0);
    EXPECT_EQ(pose.root_position,
              set.clips[1].motion.frames[static_cast<size_t>(frame + on[1].start)].root_position);
  }
}

TEST(LongFigures, SeeDriftFreezeExplosionAndABentKnee) {
  const PreparedClip clip = SyntheticClip("a", 150, 0.1, false);
  const LongFigures real = MeasureLong(Body(), 30, clip.motion.frames, {50});
  EXPECT_EQ(real.key_accelerations.size(), 1U);
  EXPECT_LT(real.bent_backwards, 0.05);
  const RealRange range = RangeOf({real}, {TrackJoints(Body(), clip.motion.frames)}, 30);
  EXPECT_FALSE(range.Frozen(real));
  EXPECT_FALSE(range.Exploded(real));
  EXPECT_EQ(range.JointsWithin(real), 1);

  std::vector<Pose> freezes = clip.motion.frames;
  for (size_t t = 110; t < 150; ++t) freezes[t] = freezes[110];
  EXPECT_TRUE(range.Frozen(MeasureLong(Body(), 30, freezes, {})));

  std::vector<Pose> drifts = clip.motion.frames;
  for (size_t t = 0; t < 150; ++t) {
    drifts[t].root_position.x() += 0.1 * static_cast<double>(t);
    drifts[t].rotations.col(Body().left_knee) = Eigen::Vector3d(-1, 0, 0);
  }
  const LongFigures gone = MeasureLong(Body(), 30, drifts, {});
  EXPECT_GT(gone.reach_m, 13);
  EXPECT_TRUE(range.Exploded(gone));
  EXPECT_GT(gone.bent_backwards, 0.2);
  EXPECT_LT(range.JointsWithin(gone), 1);
}

TEST(ScoreBeats, CountsMaximaAtMostTwoFramesOff) {
  std::vector<float> speeds;
  for (int step = 0; step < 100; ++step)  // maxima at frames 10, 20, ..., 100
    speeds.push_back(static_cast<float>(std::cos(2 * M_PI * (step + 1) / 10)));
  const BeatFigures on = ScoreBeats(speeds, {12, 22, 32, 42, 300}, 30);
  EXPECT_NEAR(on.hit_rate, 4.0 / 9, 1e-9);  // the last maximum may still rise
  EXPECT_NEAR(on.coverage, 9.0 / 4, 1e-9);
  EXPECT_EQ(ScoreBeats(speeds, {13, 23}, 30).hit_rate, 0);
  EXPECT_EQ(ScoreBeats(speeds, {}, 30).hit_rate, 0);
}

TEST(BeatTable, ADanceOnItsSongsBeatsIsAboveChance) {
  ClipSet set = Clips(true);
  auto& beats = set.beats;
  beats.resize(2);
  for (double at = 10; at < 190; at += 20) beats[0].push_back(at);
  for (double at = 16; at < 220; at += 20) beats[1].push_back(at);
  BeatTable table(set);
  for (size_t clip : {0U, 1U}) {
    std::vector<float> speeds(180, 0.0F);
    for (const double beat : beats[clip]) {
      const double frame = beat - 10;  // of a dance that starts at frame 10
      if (frame >= 2 && frame < 178) speeds[static_cast<size_t>(frame) - 1] = 1;
    }
    table.Add("on the beat", clip, 10, speeds);
    table.Add("real", clip, 10, speeds);
  }
  const Table result = table.Finish();
  ASSERT_EQ(result.rows.size(), 2U);
  EXPECT_EQ(result.rows[0].labels[0], "real");
  const auto& cells = result.rows[1].cells;
  EXPECT_EQ(cells[1].value, 100);
  EXPECT_LT(cells[2].value, 60);
  EXPECT_DOUBLE_EQ(cells[3].value, cells[1].value - cells[2].value);
  EXPECT_EQ(cells[5].value, 1);
}

TEST(EvaluateLongDances, TellsTheSameStoryTwiceAndCountsItsFrames) {
  FakeEngine engine(4);
  for (const bool music : {false, true}) {
    const ClipSet set = Clips(music);
    const auto tables = EvaluateLongDances(set, engine, Short(), nullptr);
    const auto again = EvaluateLongDances(set, engine, Short(), nullptr);
    ASSERT_EQ(tables.size(), again.size());
    for (size_t i = 0; i < tables.size(); ++i) EXPECT_EQ(ToJson(tables[i]), ToJson(again[i]));
    EXPECT_EQ(tables[0].rows.size(), 3U);
    const Table& influence = tables.back();
    // Without keys another seed leads elsewhere; the fake dancer hears the song, too.
    EXPECT_GT(influence.rows[0].cells[1].value, 0);
    ASSERT_EQ(influence.columns.size(), music ? 4U : 2U);
    EXPECT_GT(influence.rows[0].cells.back().value, 0);
    int64_t frames = 0;
    for (const LongPlan& plan : PlanLongDances(engine.model(), set, KeyTimes::kNone, 4, Short()))
      frames += plan.chain.frames;
    EXPECT_GE(CountLongFrames(set, engine.model(), Short()), 2 * frames);
  }
}

TEST(EvaluateStress, WarnsOfWhatNobodyCanDoAndMeetsItsKeys) {
  FakeEngine engine(4);
  const Table table = EvaluateStress(Clips(false), engine, Short());
  ASSERT_EQ(table.rows.size(), 6U);
  EXPECT_EQ(table.rows[0].cells[3].value, 0);    // 90 degrees in a second: fast, but possible
  EXPECT_EQ(table.rows[2].cells[3].value, 100);  // in a tenth of a second
  EXPECT_EQ(table.rows[3].cells[3].value, 100);  // six metres in a second
  for (const TableRow& row : table.rows) EXPECT_LE(row.cells[7].value, 1);
}

}  // namespace
}  // namespace choreo
