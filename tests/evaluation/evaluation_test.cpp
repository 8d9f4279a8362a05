#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "model/evaluation/contest.h"
#include "model/evaluation/eval_report.h"
#include "model/evaluation/interpolation_engine.h"
#include "model/motion/kinematics.h"
#include "model/motion/resample.h"
#include "tests/support/expect_error.h"
#include "tests/support/fake_engine.h"
#include "tests/support/synthetic_clips.h"
#include "tests/support/temporary_folder.h"

namespace choreo::evaluation_test {

using testing_support::SyntheticClip;

ClipSet TwoClips() {
  return {"set",
          {SyntheticClip("walk_a", 150, 0.1, true), SyntheticClip("turn_b", 150, 0.9, false)}};
}

TEST(DanceTransitions, GivesTheBitsOfOneAfterTheOther) {
  const ClipSet set = TwoClips();
  FakeEngine engine(3);  // fewer slots than inputs
  std::vector<TransitionInput> inputs;
  for (const int frames : {30, 12}) {
    for (const EvalWindow& window : ChooseWindows(set, 10, frames, 3))
      inputs.push_back(InputOf(engine.model(), set, window, frames, 0.5F, inputs.size()));
  }
  int64_t counted = 0;
  const auto results = DanceTransitions(engine, inputs, [&](int frames) { counted += frames; });
  ASSERT_EQ(results.size(), inputs.size());
  EXPECT_EQ(engine.free_slots(), 3);
  EXPECT_EQ(counted, 6 * 30 + 6 * 12);
  for (size_t i = 0; i < inputs.size(); ++i) {
    const TransitionResult alone = DanceTransitions(engine, {&inputs[i], 1}).front();
    ASSERT_EQ(results[i].frames.size(), alone.frames.size());
    EXPECT_EQ(results[i].arrival->raw_error_m, alone.arrival->raw_error_m);
    for (size_t t = 0; t < alone.frames.size(); ++t)
      ASSERT_EQ(results[i].frames[t].pose.rotations, alone.frames[t].pose.rotations);
  }
}

TEST(DanceTransitions, FreesItsSlotsWhenAJobIsWrong) {
  const ClipSet set = TwoClips();
  FakeEngine engine(4);
  std::vector<TransitionInput> inputs;
  for (const EvalWindow& window : ChooseWindows(set, 10, 20, 2))
    inputs.push_back(InputOf(engine.model(), set, window, 20, 0.5F, 0));
  inputs[1].audio_rows.conservativeResize(Eigen::NoChange, 5);
  ExpectError(ErrorCode::kInvalidArgument, "audio_rows", [&] { DanceTransitions(engine, inputs); });
  EXPECT_EQ(engine.free_slots(), 4);
}

TEST(InterpolationEngine, WalksTheLineOntoTheKey) {
  const ClipSet set = TwoClips();
  InterpolationEngine engine(FakeEngine(1).model(), 2);
  TransitionInput input = InputOf(engine.model(), set, {0, 40}, 20, 0.5F, 0);
  input.request.arrival_frames = 0;
  input.request.footwork = false;
  const auto result = DanceTransitions(engine, {&input, 1}).front();
  const Pose half = InterpolatePoses(input.request.history.back(), input.request.target->pose, 0.5);
  EXPECT_LT(ComparePoses(engine.model().skeleton, result.frames[9].pose, half).position_m, 1e-5);
  EXPECT_LT(result.arrival->raw_error_m, 1e-5);
}

TEST(ChooseWindows, StandInTheMiddlesOfEqualPartsAndLeaveRoomForTheHistory) {
  const ClipSet set = TwoClips();
  const auto windows = ChooseWindows(set, 10, 30, 3);
  ASSERT_EQ(windows.size(), 6U);
  EXPECT_EQ(windows[0].start, 18);
  EXPECT_EQ(windows[1].start, 65);
  EXPECT_EQ(windows[2].start, 111);
  EXPECT_EQ(windows[3].clip, 1U);
  EXPECT_TRUE(ChooseWindows(set, 10, 145, 3).empty());
  EXPECT_EQ(ChooseWindows(set, 10, 60, 9).size(), 4U);  // two fit side by side
}

class Tables : public testing::Test {
 protected:
  const Table& Find(const std::string& name) const {
    return *std::ranges::find(tables_, name, &Table::name);
  }
  // The cells of the row with these labels.
  const std::vector<Cell>& Row(const std::string& table,
                               const std::vector<std::string>& labels) const {
    return std::ranges::find(Find(table).rows, labels, &TableRow::labels)->cells;
  }

  ClipSet set_ = TwoClips();
  FakeEngine engine_{8};
  std::vector<Method> methods_ = {{"real", Method::Kind::kReal},
                                  {"interpolation", Method::Kind::kInterpolation},
                                  {"music", Method::Kind::kEngine, &engine_, false},
                                  {"model", Method::Kind::kEngine, &engine_}};
  EvalOptions options_{.lengths = {12, 30}, .windows_per_clip = 3, .temperature = 0.3F};
  Runner runner_;
  Evaluation evaluation_{set_, methods_, options_, runner_};
  std::vector<Table> tables_ = EvaluateTransitions(evaluation_);
};

TEST_F(Tables, RealMotionIsTheYardstickAndInterpolationTheUnit) {
  const auto& real = Row("transitions_set", {"30", "real"});
  EXPECT_EQ(real[0].value, 0);
  EXPECT_EQ(real[2].value, 0);
  const auto& line = Row("transitions_set", {"30", "interpolation"});
  EXPECT_GT(line[0].value, 0.1);
  EXPECT_DOUBLE_EQ(line[1].value, 1);
  const auto& model = Row("transitions_set", {"30", "model"});
  EXPECT_NEAR(model[1].value, model[0].value / line[0].value, 1e-9);
  ASSERT_TRUE(model[1].interval);
  EXPECT_LE(model[1].interval->low, model[1].value);
  EXPECT_GE(model[1].interval->high, model[1].value);
  // Who does not know the key ends elsewhere.
  EXPECT_GT(Row("transitions_set", {"30", "music"})[0].value, model[0].value);
}

TEST_F(Tables, KeysAreMissedRawAndMetAsServed) {
  const auto& keys = Row("keys_set", {"30", "model"});
  EXPECT_GT(keys[0].value, 1e-4);  // the fake model misses by a little
  EXPECT_GT(keys[1].value, 0.01);
  EXPECT_LE(keys[5].value, 1);
  EXPECT_LE(keys[6].value, 0.1);
  // Real motion has its keys, who is told of none misses it, and by the same before arrival.
  for (const Cell& cell : Row("keys_set", {"30", "real"})) EXPECT_EQ(cell.value, 0);
  EXPECT_EQ(Row("keys_set", {"30", "interpolation"})[5].value, 0);
  const auto& free = Row("keys_set", {"30", "music"});
  EXPECT_GT(free[0].value, keys[0].value);
  EXPECT_GT(free[5].value, 10);
}

TEST_F(Tables, AreTheSameAgain) {
  const std::vector<Table> again = EvaluateTransitions(evaluation_);
  ASSERT_EQ(again.size(), tables_.size());
  for (size_t i = 0; i < again.size(); ++i) EXPECT_EQ(ToJson(again[i]), ToJson(tables_[i]));
}

TEST_F(Tables, ASetThatIsTooShortHasNoRows) {
  options_.lengths = {145};
  tables_ = EvaluateTransitions(evaluation_);
  EXPECT_TRUE(Find("transitions_set").rows.empty());
}

TEST(Table, ReadsAsMarkdownAndAsJson) {
  Table table{.name = "t",
              .title = "Title",
              .note = "Note.",
              .label_headings = {"who"},
              .columns = {{"m", 2}, {"s", 1}},
              .rows = {{{"a–b"}, {Cell{1.234, Interval{1, 2}}, Cell{}}},
                       {{"c"}, {Cell{5, Interval{5, 5}}, Cell{2, {}}}}},
              .plot = {}};
  EXPECT_EQ(ToMarkdown(table),
            "### Title\n\nNote.\n\n"
            "| who |                m |   s |\n"
            "|:----|-----------------:|----:|\n"
            "| a–b | 1.23 (1.00–2.00) |   – |\n"
            "| c   |             5.00 | 2.0 |\n");
  const nlohmann::json json = ToJson(table);
  EXPECT_EQ(json["rows"][0]["m interval"][1], 2);
  EXPECT_TRUE(json["rows"][0]["s"].is_null());
}

TEST(CheckReportPath, MakesFoldersAndNamesWhatCannotBeWrittenFirst) {
  const TemporaryFolder folder;
  const auto there = folder.path() / "not" / "yet" / "figures.json";
  CheckReportPath(there);
  EXPECT_TRUE(std::filesystem::is_directory(there.parent_path()));
  EXPECT_TRUE(std::filesystem::is_empty(there.parent_path()));
  std::ofstream(there) << "old";
  CheckReportPath(there);
  EXPECT_EQ(std::filesystem::file_size(there), 3U);  // untouched
  for (const auto& nowhere : {there / "below_a_file.json", folder.path()})
    ExpectError(ErrorCode::kInvalidArgument, "--json", [&] { CheckReportPath(nowhere); });
  EXPECT_EQ(PictureBeside(there, "pair_set_a, b/c").filename(), "figures_pair_set_a__b_c.png");
}

TEST(Contest, RefusesNamesThatAreTakenBeforeItLoadsAnything) {
  for (const auto& [others, why] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"a=/absent", "a=/absent/too"}, "another row is called 'a'"},
           {{"real=/absent"}, "another row is called 'real'"},
           {{"full=/absent"}, "another row is called 'full'"},
           {{"a="}, "'a=' is not NAME=CHECKPOINT"},
           {{"/absent"}, "'/absent' is not NAME=CHECKPOINT"}}) {
    ContestOptions options;
    options.model = "/absent";
    options.others = others;
    options.name = "full";
    ExpectError(ErrorCode::kInvalidArgument, why, [&] { MakeContest(options); });
  }
  ContestOptions options;
  options.model = "/absent";
  options.name = "interpolation";
  ExpectError(ErrorCode::kInvalidArgument, "--name", [&] { MakeContest(options); });
}

TEST(SetNames, AreThoseOfFoldersEachOnce) {
  EXPECT_THAT(SetNames({"data/a", "data/b/"}), testing::ElementsAre("a", "b"));
  ExpectError(ErrorCode::kInvalidArgument, "'data/a/': another set is called 'a'", [] {
    SetNames({"data/a", "data/a/"});
  });
  ExpectError(ErrorCode::kInvalidArgument, "--data", [] { SetNames({"old/a", "new/a"}); });
}

}  // namespace choreo::evaluation_test
