#include "model/training/trainer/trainer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <torch/nn/modules/linear.h>
#include <torch/optim/adam.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <cmath>

#include "model/core/error.h"
#include "model/core/files/safetensors.h"
#include "model/training/flow_matching/flow_training.h"
#include "model/training/trainer/adam.h"
#include "tests/support/synthetic_clips.h"
#include "tests/support/temporary_folder.h"

namespace choreo::trainer_test {

using testing_support::WriteSyntheticData;

class TrainerTest : public testing::Test {
 protected:
  void SetUp() override { WriteSyntheticData(folder_.path()); }

  // A run of a few steps on the synthetic clips.
  TrainOptions Options(const std::string& name, int64_t steps) const {
    TrainOptions options;
    options.data = {folder_.path()};
    options.splits = folder_.path() / "splits.json";
    options.run = folder_.path() / name;
    options.steps = steps;
    options.batch = 4;
    options.report_every = 2;
    return options;
  }

  // As few windows as each measurement needs. Measuring takes the time of such short runs.
  static void Train(const TrainOptions& options) {
    TrainContinuousFlow(options, {.measured_windows = 36,
                                  .prior_batches = 9,
                                  .turn_batches = 3,
                                  .response_batches = 3,
                                  .validation_windows = 2});
  }

  TemporaryFolder folder_;
};

TEST_F(TrainerTest, ContinuousFlowResumesExactlyAndContinuesFromAnother) {
  TrainOptions options = Options("whole", 2);
  Train(options);
  const auto weights = [](const TrainOptions& run) {
    return ReadSafetensors(run.run / "checkpoint.safetensors");
  };
  const Safetensors whole = weights(options);
  options.run = folder_.path() / "parts";
  for (const int64_t stop : {1, 0}) {
    options.stop_after = stop;
    Train(options);
    options.resume = true;
  }
  const Safetensors parts = weights(options);
  EXPECT_EQ(parts.tensors.size(), whole.tensors.size());
  for (const auto& [name, tensor] : whole.tensors)
    EXPECT_EQ(parts.tensors.at(name).data, tensor.data) << name;

  TrainOptions further = Options("further", 1);
  further.from = options.run / "checkpoint.safetensors";
  further.rate = 0;  // the base's statistics stay
  Train(further);
  EXPECT_EQ(weights(further).tensors.at("head.weight").data, whole.tensors.at("head.weight").data);
}

TEST_F(TrainerTest, BlendsWithTheWeightsThatItStartedFrom) {
  TrainOptions base = Options("base", 1), further = Options("further", 2);
  Train(base);
  further.from = base.run / "checkpoint.safetensors";
  further.keep_statistics = true;
  const auto bias = [](const TrainOptions& options) {
    return ReadSafetensors(options.run / "checkpoint.safetensors").tensors.at("head.bias").data;
  };
  Train(further);
  const std::vector<float> before = bias(base), trained = bias(further);
  ASSERT_NE(before, trained);
  further.resume = true;  // rewrites the finished run
  further.blend = 0.25;
  Train(further);
  const std::vector<float> blended = bias(further);
  for (size_t i = 0; i < blended.size(); ++i)
    EXPECT_FLOAT_EQ(blended[i], std::lerp(before[i], trained[i], 0.25F));
}

TEST_F(TrainerTest, UnusableOptionsAreNamed) {
  const auto failure = [](TrainOptions options) -> std::string {
    try {
      options.Check();
    } catch (const Error& error) {
      return error.field();
    }
    return "";
  };
  TrainOptions options = Options("x", 4);
  EXPECT_EQ(failure(options), "");
  options.batch = 1;
  EXPECT_EQ(failure(options), "--batch");
  EXPECT_EQ(failure(Options("x", 0)), "--steps");
  options = Options("x", 4);
  options.keep_statistics = true;
  EXPECT_EQ(failure(options), "--keep-statistics");
  options = Options("x", 4);
  options.blend = 0.5;
  EXPECT_EQ(failure(options), "--blend") << "with nothing";
  options.from = "base";
  EXPECT_EQ(failure(options), "");
  options.blend = 0;
  EXPECT_EQ(failure(options), "--blend");
}

// In a run of the usual size.
TEST_F(TrainerTest, ResumesWithTheOriginalOptions) {
  TrainOptions options = Options("run", 2);
  options.stop_after = 1;
  TrainContinuousFlow(options);
  options.resume = true;
  const auto started_as = [&](const std::string& text) {
    Safetensors state = ReadSafetensors(options.run / "state.safetensors");
    state.metadata["options"] = text;
    WriteSafetensors(options.run / "state.safetensors", state);
  };
  const std::string rest = "--steps 2 --batch 4 --rate 0.001 ";
  // The state of a version that listed all presets' options.
  started_as("--preset default " + rest +
             "--shortest 5 --longest 100 --clip 1 --flow-steps 0 --hidden 0 --condition-width -1 "
             "--tempo 0.5 --seed 1 --truth-decay 0.99995");
  TrainContinuousFlow(options);
  for (const char* other : {"--clip 1 --tempo 0.5 --seed 2", "--clip 1 --tempo 0.5",
                            "--clip 1 --tempo 0.5 --seed 1 --keep-statistics"}) {
    started_as("--preset default " + rest + other);
    EXPECT_THAT([&] { TrainContinuousFlow(options); },
                testing::ThrowsMessage<Error>(testing::HasSubstr("the run was started as")))
        << other;
  }
}

// A card lists only its preset's options.
TEST_F(TrainerTest, ItsCommandNamesItsOwnOptions) {
  TrainOptions options = Options("x", 4);
  options.keep_statistics = true;
  options.name = "mine";
  options.blend = 0.7;
  EXPECT_EQ(options.Command(), "choreo-lab train --data " + folder_.path().filename().string() +
                                   " --splits splits.json --preset default --steps 4 --batch 4 "
                                   "--rate 0.001 --clip 1 --tempo 0.5 --seed 1 --keep-statistics "
                                   "--name mine --blend 0.7");
}

TEST(AdamTest, TakesTheStepsOfTheReference) {
  // One parameter, gradient 2 w: torch's own Adam is the reference.
  torch::nn::Linear ours(2, 1), reference(2, 1);
  {
    torch::NoGradGuard no_grad;
    reference->weight.copy_(ours->weight);
    reference->bias.copy_(ours->bias);
  }
  Adam adam(*ours);
  torch::optim::Adam optimiser(reference->parameters(), torch::optim::AdamOptions(0.01));
  for (int step = 0; step < 20; ++step) {
    adam.ZeroGrad();
    ours->weight.square().sum().backward();
    adam.Step(0.01, 1e9);
    optimiser.zero_grad();
    reference->weight.square().sum().backward();
    optimiser.step();
  }
  EXPECT_TRUE(torch::allclose(ours->weight, reference->weight, 1e-5, 1e-7));
}

}  // namespace choreo::trainer_test
