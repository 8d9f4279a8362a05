#include "model/evaluation/hearing_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "model/audio/made_song.h"
#include "tests/support/fake_sampler.h"

namespace choreo::hearing_table_test {

class Fake : public FakeSampler {
 public:
  Fake() { model_.controls = {"root_path"}; }
};

const Table& HeardByTheFake() {
  static const Table table = [] {
    std::vector<std::unique_ptr<Sampler>> samplers;
    samplers.push_back(std::make_unique<Fake>());
    SampleQueue queue(std::move(samplers), {});
    const std::vector<NamedSong> songs{{"mine", MakeSong({.seed = 5, .seconds = 20}).mono}};
    return EvaluateHearing(queue, songs, {.first_seed = 3, .seeds = 1, .part_seconds = 10});
  }();
  return table;
}

double Figure(const std::string& row, size_t setting) {
  for (const TableRow& one : HeardByTheFake().rows) {
    if (one.labels[0].starts_with(row)) return one.cells.at(setting).value;
  }
  ADD_FAILURE() << row;
  return NAN;
}

TEST(HearingTable, HasAllFiguresAtUsualSettingsAndFewAtOthers) {
  ASSERT_EQ(HeardByTheFake().rows.size(), 12U);
  for (const char* row :
       {"drums ÷ pad", "silence ÷ drums", "loudness and speed, made", "loudness and speed, mine",
        "seconds from a drop after a pad", "seconds from a drop after silence", "a part again",
        "two songs", "hits over chance, free", "hits over chance, keyed points",
        "hits over chance, keyed on a path", "exploded %"}) {
    EXPECT_TRUE(std::isfinite(Figure(row, 0))) << row;
    EXPECT_EQ(std::isfinite(Figure(row, 1)), std::string("de").find(row[0]) != std::string::npos ||
                                                 std::string(row).starts_with("silence") ||
                                                 std::string(row).starts_with("loud"))
        << row;
    EXPECT_EQ(std::isfinite(Figure(row, 2)), row == std::string("a part again")) << row;
    EXPECT_EQ(std::isfinite(Figure(row, 3)), row == std::string("a part again")) << row;
  }
}

// The fake model is shaken by noise and nods on beats; loudness does not change its speed.
TEST(HearingTable, MeasuresTheEffectOfMusic) {
  EXPECT_NEAR(Figure("silence ÷ drums", 0), 1, 0.2);
  EXPECT_LT(Figure("a part again", 2), Figure("a part again", 3) - 0.1);
  EXPECT_GT(Figure("two songs", 0), 0.5);
}

}  // namespace choreo::hearing_table_test
