#include "model/engine/flow_engine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/motion/kinematics.h"

namespace choreo::transition_window_test {

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
  FlowRow row_of_frame;
  window.FillRow(&row_of_frame);
  EXPECT_EQ(row_of_frame.has_audio, model.hears_music);
  return {row_of_frame.audio.begin(), row_of_frame.audio.end()};
}

TEST(TransitionWindowTest, GivesTheNetworkTheMusicOfHistoryAndFrame) {
  EXPECT_THAT(Heard(Model(true)), testing::ElementsAre(4, 4, 4, 4, 4, 4, 7, 7));
}

TEST(TransitionWindowTest, KeepsMusicFromANetworkThatLearntWithout) {
  EXPECT_THAT(Heard(Model(false)), Each(0));
}

}  // namespace choreo::transition_window_test
