#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "model/evaluation/eval_report.h"
#include "model/evaluation/judges/contest.h"
#include "model/evaluation/judges/interpolation_sampler.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/resample.h"
#include "tests/support/expect_error.h"
#include "tests/support/fake_sampler.h"
#include "tests/support/synthetic_clips.h"
#include "tests/support/temporary_folder.h"

namespace choreo::evaluation_test {

using testing_support::SyntheticClip;

ClipSet TwoClips() {
  return {"set",
          {SyntheticClip("walk_a", 150, 0.1, true), SyntheticClip("turn_b", 150, 0.9, false)}};
}

TEST(Runner, DancesDoNotDependOnEachOther) {
  const ClipSet set = TwoClips();
  HearingSampler sampler;
  std::vector<TransitionSpec> requests;
  for (const int frames : {30, 12}) {
    for (const EvalWindow& window : ChooseWindows(set, 10, frames, 3))
      requests.push_back(RequestOf(sampler.model(), set, window, frames, 0.5F, requests.size()));
  }
  int64_t counted = 0;
  const Runner runner([&](int frames) { counted += frames; });
  const Dances dances = runner.Dance(sampler, requests);
  ASSERT_EQ(dances.size(), requests.size());
  EXPECT_EQ(counted, 6 * 30 + 6 * 12);
  for (size_t i = 0; i < requests.size(); ++i) {
    const TransitionRun alone = DanceTransition(sampler, requests[i]);
    ASSERT_EQ(dances[i].size(), alone.frames().size());
    for (size_t t = 0; t < dances[i].size(); ++t)
      ASSERT_EQ(dances[i][t].rotations, alone.frames()[t].pose.rotations);
  }
  requests[1].music->rows.conservativeResize(Eigen::NoChange, 5);
  ExpectError(ErrorCode::kInvalidArgument, "audio_rows", [&] { runner.Dance(sampler, requests); });
}

TEST(InterpolationSampler, WalksTheLineOntoTheKey) {
  const ClipSet set = TwoClips();
  InterpolationSampler sampler(FakeSampler().model());
  TransitionSpec request = RequestOf(sampler.model(), set, {0, 40}, 20, 0.5F, 0);
  request.arrival_frames = 0;
  request.footwork = false;
  const TransitionRun run = DanceTransition(sampler, request);
  const Pose half = InterpolatePoses(request.history.back(), request.target->pose, 0.5);
  EXPECT_LT(ComparePoses(sampler.model().skeleton, run.frames()[9].pose, half).position_m, 1e-5);
  EXPECT_LT(run.arrival()->raw_error_m, 1e-5);
}

TEST(ChooseWindows, AreCentredInEqualPartsWithRoomForTheHistory) {
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
  FakeSampler sampler_;
  std::vector<Method> methods_ = {{"real", Method::Kind::kReal},
                                  {"interpolation", Method::Kind::kInterpolation},
                                  {"music", Method::Kind::kModel, &sampler_, false},
                                  {"model", Method::Kind::kModel, &sampler_}};
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
  // A method that does not know the key ends elsewhere.
  EXPECT_GT(Row("transitions_set", {"30", "music"})[0].value, model[0].value);
}

TEST_F(Tables, KeysAreMissedRawAndMetAsServed) {
  const auto& keys = Row("keys_set", {"30", "model"});
  EXPECT_GT(keys[0].value, 1e-4);  // the fake model misses by a little
  EXPECT_GT(keys[1].value, 0.01);
  EXPECT_LE(keys[5].value, 1);
  EXPECT_LE(keys[6].value, 0.1);
  // Real motion has its keys; a method without them misses, equally before arrival.
  for (const Cell& cell : Row("keys_set", {"30", "real"})) EXPECT_EQ(cell.value, 0);
  EXPECT_EQ(Row("keys_set", {"30", "interpolation"})[5].value, 0);
  const auto& free = Row("keys_set", {"30", "music"});
  EXPECT_GT(free[0].value, keys[0].value);
  EXPECT_GT(free[5].value, 10);
}

TEST_F(Tables, AreDeterministic) {
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

TEST(CheckReportPath, MakesFoldersAndNamesUnwritablePathsAtOnce) {
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

TEST(Contest, RefusesTakenNamesBeforeLoading) {
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

TEST(SetNames, AreUniqueFolderNames) {
  EXPECT_THAT(SetNames({"data/a", "data/b/"}), testing::ElementsAre("a", "b"));
  ExpectError(ErrorCode::kInvalidArgument, "'data/a/': another set is called 'a'", [] {
    SetNames({"data/a", "data/a/"});
  });
  ExpectError(ErrorCode::kInvalidArgument, "--data", [] { SetNames({"old/a", "new/a"}); });
}

}  // namespace choreo::evaluation_test
