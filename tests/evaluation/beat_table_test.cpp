#include "model/evaluation/tables/beat_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/synthetic_clips.h"

namespace choreo::beat_table_test {

TEST(ScoreBeats, CountsSpeedMaximaWithinTwoFrames) {
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
  ClipSet set{"set",
              {testing_support::SyntheticClip("walk_a", 200, 0.1, true),
               testing_support::SyntheticClip("turn_b", 230, 0.9, true)}};
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

}  // namespace choreo::beat_table_test
