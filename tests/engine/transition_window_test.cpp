#include "model/engine/transition_window.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/motion/kinematics.h"

namespace choreo {
namespace {

using testing::Each;

ModelInfo Model(bool hears_music) {
  ModelInfo model;
  model.skeleton = Skeleton::Smpl24();
  model.history_frames = 3;
  model.audio_features = 2;
  model.hears_music = hears_music;
  return model;
}

TransitionSpec SpecWithMusic(const ModelInfo& model) {
  TransitionSpec spec;
  spec.frames = 5;
  spec.history.assign(static_cast<size_t>(model.history_frames), RestPose(model.skeleton));
  spec.has_audio = true;
  spec.audio_history = Eigen::MatrixXf::Constant(model.audio_features, model.history_frames, 4);
  return spec;
}

// What the network is given of a row of music in the first frame.
std::vector<float> Heard(const ModelInfo& model) {
  TransitionWindow window(model, SpecWithMusic(model));
  const std::vector<float> row(static_cast<size_t>(model.audio_features), 7);
  const StepInput input{.audio_row = row};
  window.Advance(input);
  EXPECT_EQ(window.has_audio(), model.hears_music);
  return {window.audio().begin(), window.audio().end()};
}

TEST(TransitionWindowTest, GivesTheNetworkTheMusicOfHistoryAndFrame) {
  EXPECT_THAT(Heard(Model(true)), testing::ElementsAre(4, 4, 4, 4, 4, 4, 7, 7));
}

TEST(TransitionWindowTest, KeepsMusicFromANetworkThatLearntWithout) {
  EXPECT_THAT(Heard(Model(false)), Each(0));
}

}  // namespace
}  // namespace choreo
