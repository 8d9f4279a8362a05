#include "model/papers/samplers/autoregressive_flow.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/motion/kinematics/kinematics.h"

namespace choreo::autoregressive_flow_test {

using testing::Each;
using testing::ElementsAre;

ModelInfo Model(bool hears_music) {
  ModelInfo model;
  model.skeleton = Skeleton::Smpl24();
  model.history_frames = 3;
  if (hears_music) model.music_features.count = 2;
  return model;
}

/// Records the network's music input frame by frame, and outputs zeros.
class ListeningStepper : public FlowStepper {
 public:
  explicit ListeningStepper(std::vector<std::vector<float>>* heard) : heard_(heard) {}
  void StartTransition(Eigen::MatrixXf) override {}
  void Step(FlowFrame* frame) override {
    heard_->emplace_back(frame->audio.begin(), frame->audio.end());
    EXPECT_EQ(frame->frame, static_cast<int>(heard_->size()) - 1);
    std::ranges::fill(frame->features, 0.0F);
  }

 private:
  std::vector<std::vector<float>>* heard_;
};

// What the network is given of music that is 4 in the history, then 7 and 8.
std::vector<std::vector<float>> Heard(const ModelInfo& model) {
  std::vector<std::vector<float>> heard;
  AutoregressiveFlowSampler sampler(model, {.audio_features = 2}, "cpu",
                                    [&] { return std::make_unique<ListeningStepper>(&heard); });
  TransitionSpec spec;
  spec.frames = 2;
  spec.history.assign(static_cast<size_t>(model.history_frames), RestPose(model.skeleton));
  spec.music = {Eigen::MatrixXf::Constant(2, model.history_frames, 4),
                Eigen::MatrixXf::Constant(2, 2, 7)};
  spec.music->rows.col(1).setConstant(8);
  EXPECT_EQ(sampler.Sample(ValidSpec(spec, sampler.model())).Finish().poses.size(), 2U);
  return heard;
}

TEST(AutoregressiveFlowTest, GivesTheNetworkTheMusicOfHistoryAndFrame) {
  EXPECT_THAT(Heard(Model(true)), ElementsAre(ElementsAre(4, 4, 4, 4, 4, 4, 7, 7),
                                              ElementsAre(4, 4, 4, 4, 7, 7, 8, 8)));
}

TEST(AutoregressiveFlowTest, WithholdsMusicFromANetworkTrainedWithout) {
  EXPECT_THAT(Heard(Model(false)), ElementsAre(Each(0), Each(0)));
}

}  // namespace choreo::autoregressive_flow_test
