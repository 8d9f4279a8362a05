#include "model/evaluation/tables/hearing_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "model/audio/music/made_song.h"
#include "tests/support/fake_sampler.h"

namespace choreo::hearing_table_test {

class Fake : public FakeSampler {
 public:
  Fake() { model_.controls = {"root_path"}; }
};

double Figure(const Table& table, const std::string& row, size_t setting) {
  for (const TableRow& one : table.rows) {
    if (one.labels[0].starts_with(row)) return one.cells.at(setting).value;
  }
  ADD_FAILURE() << row;
  return NAN;
}

TEST(HearingTable, HasAllFiguresAndMeasuresTheEffectOfMusic) {
  std::vector<std::unique_ptr<Sampler>> samplers;
  samplers.push_back(std::make_unique<Fake>());
  SampleQueue queue(std::move(samplers), {});
  const std::vector<NamedSong> songs{{"mine", MakeSong({.seed = 5, .seconds = 20}).mono}};
  const Table table =
      EvaluateHearing(queue, songs, {.first_seed = 3, .seeds = 1, .part_seconds = 10});
  ASSERT_EQ(table.rows.size(), 18U);
  for (const char* row :
       {"drums ÷ pad", "silence ÷ drums", "loudness and speed, made", "loudness and speed, mine",
        "seconds from a drop after a pad", "seconds from a drop after silence", "a part again",
        "two songs", "hits %, free", "hits %, free on a path", "hits %, keyed",
        "hits %, keyed on a path", "hits over chance, free points",
        "hits over chance, free on a path", "hits over chance, keyed points",
        "hits over chance, keyed on a path", "rarely fast frames %", "exploded %"}) {
    EXPECT_TRUE(std::isfinite(Figure(table, row, 0))) << row;
    const std::string name = row;
    const bool drops = name.starts_with("seconds"), varies = name == "a part again";
    const bool energetic =
        !drops && !varies && !name.starts_with("two") && !name.starts_with("hits");
    EXPECT_EQ(std::isfinite(Figure(table, row, 1)), energetic || drops || varies) << row;
    EXPECT_EQ(std::isfinite(Figure(table, row, 2)), energetic) << row;
    EXPECT_EQ(std::isfinite(Figure(table, row, 3)), varies) << row;
    EXPECT_EQ(std::isfinite(Figure(table, row, 4)), varies) << row;
  }
  // The fake model is shaken by noise and nods on beats; loudness does not change its speed.
  EXPECT_NEAR(Figure(table, "silence ÷ drums", 0), 1, 0.2);
  EXPECT_LT(Figure(table, "a part again", 3), Figure(table, "a part again", 4) - 0.1);
  EXPECT_GT(Figure(table, "two songs", 0), 0.5);
  const double hits = Figure(table, "hits %, free", 0);
  EXPECT_GT(hits, Figure(table, "hits over chance, free points", 0));
  EXPECT_LE(hits, 100);
}

}  // namespace choreo::hearing_table_test
