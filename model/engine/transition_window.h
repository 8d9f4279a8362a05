#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "model/engine/flow_tile.h"
#include "model/engine/step_engine.h"
#include "model/motion/contacts.h"
#include "model/motion/kinematics.h"
#include "model/motion/pose_codec.h"

namespace choreo {

/// What paper F's engine keeps of one transition in progress: the features of the last tau emitted
/// frames, the last tau + 1 music rows, and where it stands. Features are encoded anew from the
/// poses that StepInput::previous hands back, so a transition is a function of poses alone.
///
/// Per frame: Advance, read the inputs, Finish. Nothing allocates there. Not thread-safe.
class TransitionWindow {
 public:
  /// The spec is valid (ValidateSpec).
  TransitionWindow(const ModelInfo& model, const TransitionSpec& spec);

  SlotProgress progress() const { return {frame_, frames_, has_audio_}; }
  /// Moves the windows on by what was emitted and what is heard; `input` is what the next frame
  /// needs (ValidateSteps).
  void Advance(const StepInput& input);

  /// Inputs of the frame to be stepped.
  int frame() const { return frame_; }
  bool has_audio() const { return has_audio_; }
  std::span<const float> past() const { return past_; }    ///< [tau, width], oldest first
  std::span<const float> audio() const { return audio_; }  ///< [tau + 1, audio_features]
  /// Its noise, temperature applied.
  FrameNoise noise() const {
    FrameNoise noise = first_noise_;
    noise.frame += frame_;
    return noise;
  }

  /// Follows the model's features [width] of the frame and decodes them; the frame is then done.
  void Finish(std::span<const float> features, StepOutput* output);

 private:
  Eigen::Map<Eigen::VectorXf> PastRow(int row) {
    return {past_.data() + static_cast<std::ptrdiff_t>(row) * codec_.width(), codec_.width()};
  }

  Skeleton skeleton_;
  double fps_;
  int tau_, audio_features_;
  PoseCodec codec_;
  std::vector<float> past_, audio_;

  int frames_;     // N
  int frame_ = 0;  // next to be stepped
  FrameNoise first_noise_;
  bool has_audio_;
  Pose last_;  // emitted before `frame_`
  JointPlacement last_placement_;
  ContactDetector contacts_;

  // Kept for their memory.
  JointPlacement placement_;
  PoseCodec::Decoded decoded_;
};

}  // namespace choreo
