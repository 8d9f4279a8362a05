#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <torch/types.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "model/core/error.h"
#include "model/papers/networks/flow_checkpoint.h"
#include "model/papers/training/flow_losses.h"
#include "model/papers/training/paper_options.h"
#include "model/training/clips/clip_split.h"
#include "tests/support/load_checkpoint.h"
#include "tests/support/synthetic_clips.h"
#include "tests/support/temporary_folder.h"

namespace choreo::paper_trainer_test {

using testing_support::WriteSyntheticData;

class PaperTrainerTest : public testing::Test {
 protected:
  void SetUp() override { WriteSyntheticData(folder_.path()); }

  // A run of a few steps on the synthetic clips; flows are small.
  PaperOptions Options(const std::string& name, int64_t steps) const {
    PaperOptions options;
    options.preset = "ablation";
    options.data = {folder_.path()};
    options.splits = folder_.path() / "splits.json";
    options.run = folder_.path() / name;
    options.steps = steps;
    options.batch = 8;
    options.longest = 12;
    options.flow.flow_steps = 2;
    options.flow.hidden = 40;
    options.report_every = 2;
    return options;
  }

  static std::string HashOf(const std::filesystem::path& run) {
    return LoadCheckpoint(run / "checkpoint.safetensors").hash;
  }

  TemporaryFolder folder_;
};

TEST_F(PaperTrainerTest, TheSameRunMakesTheSameCheckpointAndLeavesItsCurves) {
  TrainFlow(Options("a", 4));
  TrainFlow(Options("b", 4));
  for (const char* file : {"curves.csv", "curves.png", "validation.png", "state.safetensors"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "a" / file)) << file;
  }
  const Checkpoint a = LoadCheckpoint(folder_.path() / "a" / "checkpoint.safetensors");
  const Checkpoint b = LoadCheckpoint(folder_.path() / "b" / "checkpoint.safetensors");
  const auto expected = b.model->named_parameters();
  for (const auto& item : a.model->named_parameters()) {
    EXPECT_TRUE(torch::equal(item.value(), expected[item.key()])) << item.key();
  }
}

TEST_F(PaperTrainerTest, CheckpointHasItsNameAndMusicFlag) {
  PaperOptions options = Options("mine", 2);
  options.name = "mine";
  TrainFlow(options);
  const auto config = [&](const std::string& run) {
    return LoadCheckpoint(folder_.path() / run / "checkpoint.safetensors").model->config();
  };
  EXPECT_EQ(config("mine").name, "mine");
  EXPECT_TRUE(config("mine").hears_music);

  for (const char* with_music : {"train_0.clip", "train_1.clip"}) {
    ASSERT_TRUE(std::filesystem::remove(folder_.path() / with_music));
  }
  TrainFlow(Options("deaf", 2));
  EXPECT_EQ(config("deaf").name, "ablation");
  EXPECT_FALSE(config("deaf").hears_music);
}

// An ablation leaves out one thing.
TEST_F(PaperTrainerTest, WithoutKeyLossRolloutsStillHaveGradients) {
  const auto curves = [&](PaperOptions options) {
    options.flow.rollout_loss = 0.5;
    TrainFlow(options);
    std::ifstream file(options.run / "curves.csv");
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_THAT(curves(Options("all", 2)), testing::HasSubstr("key_pose_dm"));
  for (const bool keys : {true, false}) {
    PaperOptions options = Options(keys ? "no_key_loss" : "no_keys", 2);
    options.no_key_loss = keys;
    options.flow.no_keys = !keys;
    const std::string text = curves(options);
    EXPECT_THAT(text, testing::Not(testing::HasSubstr("key_pose_dm")));
    EXPECT_THAT(text, testing::HasSubstr("contact_l1"));
    EXPECT_THAT(text, testing::HasSubstr("rollout_dm"));
    EXPECT_EQ(LoadCheckpoint(options.run / "checkpoint.safetensors").model->config().keys, keys);
  }
}

TEST_F(PaperTrainerTest, SizesAreOptionsAndWeightsTakeHalfTheBytes) {
  PaperOptions options = Options("sized", 1);
  options.flow.flow_steps = 3;
  options.flow.hidden = 48;
  options.flow.condition_width = 0;
  TrainFlow(options);
  const auto path = options.run / "checkpoint.safetensors";
  const Checkpoint checkpoint = LoadCheckpoint(path);
  const FlowConfig& config = checkpoint.model->config();
  EXPECT_EQ(config.flow_steps, 3);
  EXPECT_EQ(config.hidden, 48);
  EXPECT_EQ(config.condition_width, 0);
  uintmax_t numbers = 0;
  for (const auto& parameter : checkpoint.model->parameters()) numbers += parameter.numel();
  EXPECT_LT(std::filesystem::file_size(path), 3 * numbers);
}

TEST_F(PaperTrainerTest, RolloutsBeginAtTheRequestedStep) {
  PaperOptions options = Options("late", 3);
  options.report_every = 1;
  options.flow.rollout_from = 2;
  TrainFlow(options);
  std::ifstream file(options.run / "curves.csv");
  std::string header;
  std::getline(file, header);
  EXPECT_THAT(header, testing::HasSubstr("key_pose_dm"));
  options.run = folder_.path() / "never";
  options.flow.rollout_from = 3;
  TrainFlow(options);
  std::ifstream other(options.run / "curves.csv");
  std::getline(other, header);
  EXPECT_THAT(header, testing::Not(testing::HasSubstr("key_pose_dm")));
}

TEST_F(PaperTrainerTest, AFlowMayDrawInnovations) {
  PaperOptions options = Options("innovations", 1);
  options.preset = "paper-f";
  options.flow.flow_steps = 1;
  TrainFlow(options);
  const auto model = [&] { return LoadCheckpoint(options.run / "checkpoint.safetensors").model; };
  EXPECT_TRUE(model()->config().innovations);
  const auto buffers = model()->named_buffers();
  EXPECT_GT(buffers["predict"].abs().max().item<double>(), 0.5);  // poses go on
  options.run = folder_.path() / "features";
  options.flow.no_innovations = true;
  TrainFlow(options);
  EXPECT_FALSE(model()->config().innovations);
}

TEST_F(PaperTrainerTest, AResumedRunEqualsAnUninterruptedOne) {
  TrainFlow(Options("whole", 4));
  // Killed after the report of step 2: what is left is its state. The learning rate must be that of
  // a run of 4 steps.
  const auto step_of = [&](const std::string& run) {
    return ReadSafetensors(folder_.path() / run / "state.safetensors").metadata.at("step");
  };
  EXPECT_EQ(step_of("whole"), "4");
  PaperOptions options = Options("halves", 4);
  options.stop_after = 2;
  TrainFlow(options);
  EXPECT_EQ(step_of("halves"), "2");
  // It can be judged before it ends.
  EXPECT_TRUE(std::filesystem::exists(options.run / "checkpoint.safetensors"));
  options.stop_after = 0;
  options.resume = true;
  TrainFlow(options);
  const Checkpoint whole = LoadCheckpoint(folder_.path() / "whole" / "checkpoint.safetensors");
  const Checkpoint halves = LoadCheckpoint(options.run / "checkpoint.safetensors");
  const auto expected = whole.model->named_parameters();
  for (const auto& item : halves.model->named_parameters()) {
    EXPECT_TRUE(torch::equal(item.value(), expected[item.key()])) << item.key();
  }
}

TEST_F(PaperTrainerTest, FlowContinuesFromAnother) {
  const PaperOptions first = Options("first", 2);
  TrainFlow(first);
  PaperOptions further = Options("further", 1);
  Checkpoint base = LoadCheckpoint(first.run / "checkpoint.safetensors");
  further.from = folder_.path() / "bound.safetensors";
  const nlohmann::json bound = {{"clips_by_terms", {{"for study alone", 3}}}};
  SaveCheckpoint(further.from, base.model, {{"data", bound}});
  further.rate = 0;  // what it took up stays as it was
  TrainFlow(further);
  const Checkpoint theirs = LoadCheckpoint(further.from);
  const Checkpoint ours = LoadCheckpoint(further.run / "checkpoint.safetensors");
  const auto expected = theirs.model->named_parameters();
  for (const auto& item : ours.model->named_parameters())
    EXPECT_TRUE(torch::equal(item.value(), expected[item.key()])) << item.key();
  EXPECT_THAT(ours.card, testing::HasSubstr(theirs.hash));
  EXPECT_THAT(ours.card, testing::HasSubstr("[3 clips] for study alone"));
}

// Whatever the name: each run's checkpoint has the same one.
TEST_F(PaperTrainerTest, ResumesWithTheSamePretrainedCheckpoint) {
  const PaperOptions base = Options("base", 1);
  TrainFlow(base);
  PaperOptions other = Options("other", 1);
  other.seed = 2;
  TrainFlow(other);
  PaperOptions further = Options("further", 2);
  further.from = base.run / "checkpoint.safetensors";
  further.stop_after = 1;
  TrainFlow(further);
  further.resume = true;
  further.stop_after = 0;
  for (const auto& wrong : {other.run / "checkpoint.safetensors", std::filesystem::path()}) {
    further.from = wrong;
    EXPECT_THAT([&] { TrainFlow(further); },
                testing::ThrowsMessage<Error>(testing::HasSubstr("from another checkpoint")));
  }
  further.from = folder_.path() / "renamed.safetensors";
  std::filesystem::copy_file(base.run / "checkpoint.safetensors", further.from);
  TrainFlow(further);
  EXPECT_THAT(LoadCheckpoint(further.run / "checkpoint.safetensors").card,
              testing::HasSubstr(HashOf(base.run)));
}

TEST_F(PaperTrainerTest, TheBaselineLearnsAndResumesExactly) {
  PaperOptions options = Options("baseline", 12);
  options.preset = kInbetweenerPreset;
  options.flow.hidden = 32;
  options.rate = 0.01;
  options.report_every = 1;
  TrainInbetweener(options);
  const auto checkpoint = [&] { return ReadSafetensors(options.run / "checkpoint.safetensors"); };
  const std::string whole = checkpoint().metadata.at("hash");
  EXPECT_THAT(checkpoint().metadata.at("config"), testing::HasSubstr("\"hidden\":32"));
  std::ifstream file(options.run / "curves.csv");
  std::string header, line;
  std::getline(file, header);
  const auto column = [&](const std::string& name) {
    std::istringstream names(header), values(line);
    std::string of, value;
    while (std::getline(names, of, ',') && std::getline(values, value, ',') && of != name) {
    }
    return std::stod(value);
  };
  std::getline(file, line);
  const double first = column("l2p_ratio_10");
  while (std::getline(file, line) && file.peek() != EOF) {
  }
  EXPECT_LT(column("l2p_ratio_10"), first);

  options.run = folder_.path() / "parts";
  for (const int64_t stop : {3, 0}) {
    options.stop_after = stop;
    TrainInbetweener(options);
    options.resume = true;
  }
  EXPECT_EQ(checkpoint().metadata.at("hash"), whole);
}

TEST_F(PaperTrainerTest, ControllersResumeExactly) {
  PaperOptions options = Options("controllers", 3);
  options.preset = "controllers-paper";
  options.batch = 4;
  TrainControllers(options);
  const auto hash = [](const PaperOptions& run) {
    return ReadSafetensors(run.run / "checkpoint.safetensors").metadata.at("hash");
  };
  const std::string whole = hash(options);
  options.run = folder_.path() / "parts";
  for (const int64_t stop : {1, 3, 0}) {
    options.stop_after = stop;
    TrainControllers(options);
    options.resume = true;
  }
  EXPECT_EQ(hash(options), whole);
  options.controllers.one_lstm = true;
  EXPECT_THAT([&] { TrainControllers(options); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("--one-lstm")));
}

TEST_F(PaperTrainerTest, ControllersContinueFromAnotherNetwork) {
  PaperOptions first = Options("first", 1);
  first.preset = "controllers-paper";
  first.batch = 4;
  TrainControllers(first);
  PaperOptions further = first;
  further.run = folder_.path() / "further";
  further.from = first.run / "checkpoint.safetensors";
  further.rate = 0;  // what it took up stays as it was
  further.name = "further";
  TrainControllers(further);
  const Safetensors theirs = ReadSafetensors(further.from);
  const Safetensors ours = ReadSafetensors(further.run / "checkpoint.safetensors");
  ASSERT_EQ(ours.tensors.size(), theirs.tensors.size());
  for (const auto& [name, tensor] : theirs.tensors)
    EXPECT_EQ(ours.tensors.at(name).data, tensor.data) << name;
  EXPECT_THAT(ours.metadata.at("card"), testing::HasSubstr(theirs.metadata.at("hash")));
  EXPECT_THAT(ours.metadata.at("config"), testing::HasSubstr("\"name\":\"further\""));

  further.run = folder_.path() / "one LSTM";
  further.controllers.one_lstm = true;
  EXPECT_THAT([&] { TrainControllers(further); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("its shape does not fit")));
}

TEST_F(PaperTrainerTest, UnusableOptionsAreNamed) {
  const auto failure = [](PaperOptions options) -> std::string {
    try {
      options.Check();
    } catch (const Error& error) {
      return error.field();
    }
    return "";
  };
  PaperOptions options = Options("x", 4);
  EXPECT_EQ(failure(options), "");
  options.batch = 1;
  EXPECT_EQ(failure(options), "--batch");
  options = Options("x", 0);
  EXPECT_EQ(failure(options), "--steps");
  options = Options("x", 4);
  options.longest = 3;
  EXPECT_EQ(failure(options), "--longest");
}

// Paper C, Section 4: the longest grows by one frame an epoch, the shortest by four every five.
TEST(Curriculum, TransitionsGrowLonger) {
  constexpr int64_t kSteps = 660, kEpoch = 10;  // 66 epochs: 5 to 70 frames
  const auto at = [&](int64_t epoch) { return CurriculumAt(epoch * kEpoch, kSteps, 5, 70); };
  EXPECT_EQ(at(0), (LengthRange{5, 5}));
  EXPECT_EQ(CurriculumAt(kEpoch - 1, kSteps, 5, 70), at(0));
  EXPECT_EQ(at(1), (LengthRange{5, 6}));
  EXPECT_EQ(at(4), (LengthRange{5, 9}));
  EXPECT_EQ(at(5), (LengthRange{9, 10}));
  EXPECT_EQ(at(65), (LengthRange{57, 70}));
  EXPECT_EQ(CurriculumAt(kSteps - 1, kSteps, 5, 70), at(65));
}

TEST_F(PaperTrainerTest, BatchesOfOtherTempiKeepTheirPath) {
  const auto clips = LoadClips({folder_.path()}, folder_.path() / "splits.json", kTrainGroup);
  Random random(5);
  const MotionBatch batch = DrawMotion(clips, 40, 10, 20, {.tempo = 1}, torch::kCPU, &random);
  const TorchKinematics kinematics(clips.front().skeleton);
  // Faster motion goes further, and stays consistent.
  const torch::Tensor steps = batch.truth.position.diff(1, 1).norm(2, -1).mean(1);
  EXPECT_GT((steps.max() / steps.min()).item<double>(), 1.2);
  EXPECT_TRUE(batch.features.isfinite().all().item<bool>());
  const MotionBatch some = batch.First(3);
  EXPECT_EQ(some.features.size(0), 3);
  EXPECT_TRUE(torch::equal(some.truth.position, batch.truth.position.narrow(0, 0, 3)));
  EXPECT_EQ(batch.First(0).audio.size(0), 1);
}

TEST_F(PaperTrainerTest, BatchesHoldCanonicalWindowsAndTheirKeys) {
  const auto clips = LoadClips({folder_.path()}, folder_.path() / "splits.json", kTrainGroup);
  Random random(5);
  const MotionBatch batch = DrawMotion(clips, 6, 10, 20, {}, torch::kCPU, &random);
  EXPECT_EQ(batch.transition.frames, 20);
  EXPECT_EQ(batch.features.sizes(), (std::vector<int64_t>{6, 30, 82}));
  // The last history frame stands over the origin, facing +Z; the key is the last frame.
  const torch::Tensor last = batch.transition.history_position.select(1, 9);
  EXPECT_LT(last.select(1, 0).abs().max().item<double>(), 1e-6);
  EXPECT_LT(last.select(1, 2).abs().max().item<double>(), 1e-6);
  EXPECT_TRUE(torch::equal(batch.transition.target_position, batch.truth.position.select(1, 19)));
  // Two of five clips have music; the others get zeros.
  const MotionBatch many = DrawMotion(clips, 60, 10, 20, {}, torch::kCPU, &random);
  const auto heard = static_cast<int>(many.has_audio.sum().item<double>());
  EXPECT_GT(heard, 0);
  EXPECT_LT(heard, 60);
  EXPECT_TRUE(torch::equal(many.audio.abs().amax({1, 2}) > 0, many.has_audio.squeeze(1) > 0));
  // Truth has no distance from itself, interpolation does.
  const TorchKinematics kinematics(clips.front().skeleton);
  EXPECT_LT(JointDistance(kinematics, batch.truth, batch.truth).max().item<double>(), 1e-4);
  EXPECT_GT(
      JointDistance(kinematics, Interpolate(batch.transition), batch.truth).min().item<double>(),
      1e-3);
}

}  // namespace choreo::paper_trainer_test
