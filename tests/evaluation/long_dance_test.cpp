#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "model/evaluation/evaluation.h"
#include "model/evaluation/judges/long_figures.h"
#include "model/evaluation/judges/long_plans.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/support/fake_sampler.h"
#include "tests/support/synthetic_clips.h"

namespace choreo::long_dance_test {

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

TEST(DanceLong, ReachesKeysAndContinuesWithoutThem) {
  const ClipSet set = Clips(false);
  FakeSampler sampler;
  const auto plans = PlanLongDances(sampler.model(), set, KeyTimes::kEachTwoSeconds, 4, Short());
  ASSERT_EQ(plans.size(), 4U);
  const auto danced = Runner().DanceLong(sampler, plans);
  for (size_t i = 0; i < plans.size(); ++i) {
    ASSERT_EQ(danced[i].poses.size(), 300U);
    EXPECT_EQ(danced[i].keys.size(), 5U);
    for (const auto& [frame, error] : danced[i].keys) {
      EXPECT_LE(error, 1e-3);
      EXPECT_LT(
          ComparePoses(Body(), danced[i].poses[static_cast<size_t>(frame)], plans[i].keys.at(frame))
              .position_m,
          1e-3);
    }
    const LongDance alone = Runner().DanceLong(sampler, {&plans[i], 1}).front();
    for (size_t t = 0; t < 300; ++t)
      ASSERT_EQ(alone.poses[t].rotations, danced[i].poses[t].rotations);
  }
}

// As in a stream, whose last transition is cut, not shortened.
TEST(DanceLong, ShorterDanceIsAPrefix) {
  const ClipSet set = Clips(false);
  FakeSampler sampler;
  LongPlan plan = PlanLongDances(sampler.model(), set, KeyTimes::kNone, 1, Short()).front();
  const LongDance whole = Runner().DanceLong(sampler, {&plan, 1}).front();
  plan.frames = 200;  // in the middle of a transition
  const LongDance part = Runner().DanceLong(sampler, {&plan, 1}).front();
  ASSERT_EQ(part.poses.size(), 200U);
  for (size_t t = 0; t < 200; ++t)
    ASSERT_EQ(part.poses[t].rotations, whole.poses[t].rotations) << t;
}

TEST(PlanLongDances, DanceEndsWithItsMusic) {
  const ClipSet set = Clips(true);
  for (const LongPlan& plan :
       PlanLongDances(FakeSampler().model(), set, KeyTimes::kNone, 2, Short())) {
    EXPECT_EQ(plan.start, 10);
    EXPECT_EQ(plan.frames, static_cast<int>(set.clips[plan.clip].motion.frames.size()) - 10);
    EXPECT_EQ(plan.audio.cols(), plan.frames + 10);
  }
}

TEST(PlanLongDances, KeysComeFromTheRealMotion) {
  const ClipSet set = Clips(false);
  for (const LongPlan& plan :
       PlanLongDances(FakeSampler().model(), set, KeyTimes::kEachTwoSeconds, 4, Short())) {
    const std::vector<Pose> beside = RealMotionBeside(plan, set);
    ASSERT_EQ(beside.size(), 300U);
    for (const auto& [frame, pose] : plan.keys)
      EXPECT_EQ(beside[static_cast<size_t>(frame)].root_position, pose.root_position);
    // After the clip's end it is traversed backwards: no step is longer than the clip's own.
    for (size_t t = 1; t < beside.size(); ++t)
      EXPECT_LT((beside[t].root_position - beside[t - 1].root_position).norm(), 0.2) << t;
  }
}

TEST(PlanLongDances, KeysMoveToTheNearestBeat) {
  ClipSet set = Clips(true);
  std::vector<double> beats;
  for (double at = 0; at < 230; at += 24) beats.push_back(at);  // of the clip
  set.beats = {beats, beats};
  const ModelInfo model = FakeSampler().model();
  const auto equal = PlanLongDances(model, set, KeyTimes::kEqual, 2, Short());
  const auto on = PlanLongDances(model, set, KeyTimes::kOnBeats, 2, Short());
  ASSERT_EQ(equal[1].keys.size(), 2U);
  EXPECT_TRUE(equal[1].keys.contains(99));
  ASSERT_EQ(on[1].keys.size(), 2U);
  for (const auto& [frame, pose] : on[1].keys) {
    EXPECT_EQ((frame + on[1].start) % 24, 0);
    EXPECT_EQ(pose.root_position,
              set.clips[1].motion.frames[static_cast<size_t>(frame + on[1].start)].root_position);
  }
}

TEST(LongFigures, DetectDriftFreezeExplosionAndABentKnee) {
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
  EXPECT_EQ(MeasureLong(Body(), 30, freezes, {}).stillest, 0);

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

TEST(LongFigures, CountSnapsOfTheWholeDance) {
  Skeleton straight = Body();  // SMPL's legs are not, at rest
  const Eigen::Vector3d thigh = straight.offsets.col(straight.left_knee);
  straight.offsets.col(straight.feet[0]) =
      straight.offsets.col(straight.feet[0]).norm() * thigh.normalized();
  std::vector<Pose> poses(60, RestPose(straight));
  for (const size_t t : {10U, 20U, 21U})
    poses[t].rotations.col(straight.left_knee) = Eigen::Vector3d(0.5, 0, 0);
  const LongFigures figures = MeasureLong(straight, 30, poses, {});
  EXPECT_EQ(figures.snaps.knees, 4);
  EXPECT_EQ(figures.snaps.elbows, 0);
}

TEST(LongFigures, StillestIsTheSlowestFifth) {
  // Ten seconds at 1 m/s, but for 40 frames at a tenth of it; a fifth has 60 steps.
  const auto walk = [](int slow_from, int slow_frames) {
    std::vector<Pose> poses(301, RestPose(Body()));
    for (int t = 1; t <= 300; ++t) {
      const bool slow = t > slow_from && t <= slow_from + slow_frames;
      poses[static_cast<size_t>(t)].root_position =
          poses[static_cast<size_t>(t) - 1].root_position +
          Eigen::Vector3d(0, 0, (slow ? 0.1 : 1.0) / 30);
    }
    return MeasureLong(Body(), 30, poses, {});
  };
  const RealRange range = RangeOf({walk(0, 0)}, {}, 30);
  EXPECT_NEAR(walk(0, 0).stillest, 1, 1e-6);
  for (const int from : {0, 47, 130, 233, 260}) {
    const LongFigures dance = walk(from, 40);
    EXPECT_NEAR(dance.stillest, 0.1, 1e-6) << from;
    EXPECT_EQ(range.Frozen(dance), from >= 233) << from;  // that is in the last fifth alone
  }
  // Less than half a fifth is a pause, which no median shows.
  EXPECT_NEAR(walk(130, 29).stillest, 1, 1e-6);
  // The last fifth is among them for any length.
  const PreparedClip clip = SyntheticClip("a", 153, 0.1, false);
  const LongFigures figures = MeasureLong(Body(), 30, clip.motion.frames, {});
  EXPECT_LE(figures.stillest, figures.late_speed);
  EXPECT_GT(figures.stillest, 0);
}

TEST(MeasureReal, MeasuresClipsWithKeysEveryTwoSeconds) {
  const ClipSet set = Clips(false);
  const RealDances real = MeasureReal(set, FakeSampler().model());
  ASSERT_EQ(real.clips.size(), 2U);
  EXPECT_EQ(real.clips[0].key_accelerations.size(), 3U);  // of 200 frames
  EXPECT_EQ(real.range.top_speed, std::max(real.clips[0].top_speed, real.clips[1].top_speed));
  EXPECT_FALSE(real.range.Frozen(real.clips[0]));
  EXPECT_EQ(real.range.low.size(), static_cast<size_t>(Body().joints()));
}

// A minute of standing still at `path`(seconds), with a hand that waves `rate` times a second.
std::vector<Pose> Minute(const std::function<Eigen::Vector3d(double)>& path,
                         const std::function<double(double)>& wave) {
  std::vector<Pose> poses;
  for (int t = 0; t < 1800; ++t) {
    Pose pose = RestPose(Body());
    pose.root_position += path(t / 30.0);
    pose.rotations(2, Body().left_shoulder) = wave(t / 30.0);
    poses.push_back(pose);
  }
  return poses;
}

TEST(LongFigures, DriftIsTravelSinkingOrAPaceChange) {
  const auto measure = [](auto path, auto wave) {
    return MeasureLong(Body(), 30, Minute(path, wave), {});
  };
  const auto nowhere = [](double) { return Eigen::Vector3d(0, 0, 0); };
  const auto steady = [](double s) { return std::sin(6 * s); };
  const LongFigures stays = measure(nowhere, steady);
  const RealRange calm = RangeOf({stays}, {}, 30);
  EXPECT_EQ(stays.seconds, 60);
  EXPECT_NEAR(stays.away_m_per_min, 0, 1e-9);
  EXPECT_NEAR(stays.rise_m, 0, 1e-9);
  EXPECT_NEAR(stays.pace_change, 1, 0.01);
  EXPECT_FALSE(calm.Drifted(stays));

  const auto away = [](double speed) {
    return [speed](double s) { return Eigen::Vector3d(0, 0, speed * s / 60); };
  };
  EXPECT_NEAR(measure(away(2.5), steady).away_m_per_min, 2.5, 1e-6);
  EXPECT_FALSE(calm.Drifted(measure(away(2.5), steady)));
  EXPECT_TRUE(calm.Drifted(measure(away(3.5), steady)));
  // Where real dancers go further, others may, too.
  EXPECT_FALSE(RangeOf({measure(away(4), steady)}, {}, 30).Drifted(measure(away(3.5), steady)));
  // Round and round a circle of three metres is not drift.
  const auto round = [](double s) {
    return Eigen::Vector3d(3 * std::cos(s / 2) - 3, 0, 3 * std::sin(s / 2));
  };
  EXPECT_FALSE(calm.Drifted(measure(round, steady)));

  // 24 cm in a minute: 20 cm between the middles of the first and the last ten seconds.
  const auto sinks = [](double s) { return Eigen::Vector3d(0, -0.24 * s / 60, 0); };
  EXPECT_NEAR(measure(sinks, steady).rise_m, -0.2, 1e-6);
  EXPECT_TRUE(calm.Drifted(measure(sinks, steady)));

  // A wave whose periods slow down little by little, to a third.
  const auto slows = [](double s) { return std::sin(6 * (s - s * s / 180)); };
  const LongFigures slower = measure(nowhere, slows);
  EXPECT_NEAR(slower.pace_change, (1.0 - 2 * 55.0 / 180) / (1.0 - 2 * 5.0 / 180), 0.03);
  EXPECT_TRUE(calm.Drifted(slower));
}

std::vector<Table> Evaluate(const std::function<std::vector<Table>(const Evaluation&)>& evaluate,
                            const ClipSet& set, Sampler& sampler) {
  const EvalOptions options = Short();
  const std::vector<Method> methods = {{"model", Method::Kind::kModel, &sampler}};
  const Runner runner;
  return evaluate({set, methods, options, runner});
}

TEST(EvaluateLongDances, IsDeterministic) {
  FakeSampler sampler;
  for (const bool music : {false, true}) {
    const ClipSet set = Clips(music);
    const auto tables = Evaluate(EvaluateLongDances, set, sampler);
    const auto again = Evaluate(EvaluateLongDances, set, sampler);
    EXPECT_EQ(tables.size(), music ? 2U : 1U);
    ASSERT_EQ(tables.size(), again.size());
    for (size_t i = 0; i < tables.size(); ++i) EXPECT_EQ(ToJson(tables[i]), ToJson(again[i]));
    EXPECT_EQ(tables[0].rows.size(), 4U);
    EXPECT_EQ(tables[0].columns[3].heading, "last fifth m/s");
    EXPECT_EQ(tables[0].columns[4].heading, "stillest fifth m/s");
    for (const TableRow& row : tables[0].rows) {
      ASSERT_EQ(row.cells.size(), tables[0].columns.size());
      EXPECT_LE(row.cells[4].value, row.cells[3].value) << row.labels[0];
    }
    EXPECT_GT(tables[0].rows[0].cells[4].value, 0);  // real motion never stands
  }
}

TEST(EvaluateStress, WarnsOfImpossibleKeysAndMeetsThem) {
  FakeSampler sampler;
  const Table table = Evaluate(EvaluateStress, Clips(false), sampler).front();
  const auto row = [&](const std::vector<std::string>& labels) {
    return std::ranges::find(table.rows, labels, &TableRow::labels)->cells;
  };
  ASSERT_EQ(table.rows.size(), 12U);
  EXPECT_EQ(row({"standing to lying", "30"})[3].value, 0);  // 90 degrees in a second: possible
  EXPECT_EQ(row({"standing to lying", "3"})[3].value, 100);
  EXPECT_EQ(row({"standing to lying 6 m away", "30"})[3].value, 100);
  for (const TableRow& any : table.rows)
    EXPECT_TRUE(any.labels[0] == "no key" || any.cells[7].value <= 1) << any.labels[0];
  // Real motion requires only what people can do, and arrives. Without a request there is no
  // verdict.
  for (const char* frames : {"3", "10", "30", "90"}) {
    EXPECT_EQ(row({"real motion", frames})[3].value, 0);
    EXPECT_EQ(row({"real motion", frames})[4].value, 0);
    EXPECT_EQ(row({"real motion", frames})[7].value, 0);
  }
  EXPECT_GT(row({"real motion", "30"})[2].value, row({"almost the same pose", "30"})[2].value);
  EXPECT_TRUE(std::isnan(row({"no key", "30"})[3].value));
  EXPECT_GT(row({"no key", "30"})[5].value, 0);
}

}  // namespace choreo::long_dance_test
