#pragma once

#include <torch/types.h>

#include <memory>
#include <string>
#include <vector>

#include "model/core/random.h"
#include "model/flow/flow_sampler.h"
#include "model/training/prepared_clip.h"

namespace choreo {

/// A batch of windows of equal shape as the continuous flow sees them; see FlowNetwork for what
/// the tensors are. Time stands before features, float32.
struct WindowBatch {
  int frames = 0, to_key = 0;
  torch::Tensor z = {};                     ///< [batch, w, dimensions] real motion, white
  torch::Tensor scales = {};                ///< [batch, dimensions] as FlowWindow has them
  std::vector<double> surprise = {};        ///< [batch], the same
  torch::Tensor keyed = {};                 ///< [batch, dimensions] in {0, 1}
  torch::Tensor mean = {};                  ///< [batch, tau + w, dimensions], history in front
  torch::Tensor features = {}, whole = {};  ///< of WindowFeatures
  torch::Tensor history_joints = {};        ///< [batch, tau, 3 joints] metres
  /// The mean as poses: root positions [batch, w, 3] and local rotations [batch, w, joints, 3, 3].
  torch::Tensor base_root = {}, base_turns = {};
  /// Of the real motion: the turn in the world that a unit of each of a joint's coordinates makes
  /// [batch, w, joints, 3, 3], and the way from its parent to it [batch, w, joints, 3] in metres.
  torch::Tensor axes = {}, bones = {};
  std::vector<WindowRequest> requests = {};   ///< what each was asked for
  std::vector<std::vector<Pose>> truth = {};  ///< [batch][w] canonical frame
};

/// Prepared clips with what they say of themselves: the energy of body parts, their root path,
/// beats, style. Immutable after construction.
class WindowClips {
 public:
  explicit WindowClips(const std::vector<PreparedClip>& clips);

  /// What training varies, each a probability. All zero: whole keys, no other label.
  struct Variation {
    double mirror = 0;
    double tempo = 0;  ///< danced up to a third faster or slower
    double no_key = 0;
    double partial_key = 0;                             ///< joints or the root's position are open
    double beats = 0, energy = 0, path = 0, style = 0;  ///< that the label is told
    double hold_history = 0;  ///< only the last few poses are known, the earliest being held
    double astray = 0;        ///< starts out of balance, as dances of a model do, and comes back
  };
  /// Windows of `frames` frames whose key stands `to_key` frames behind the history.
  WindowBatch Draw(const FlowModelParts& model, int batch, int frames, int to_key,
                   const Variation& variation, Random* random) const;

  /// The longest way to a key behind `history` frames that some clip has.
  int Longest(int history) const;
  const Skeleton& skeleton() const { return skeleton_; }
  const std::vector<std::string>& styles() const { return styles_; }
  std::array<double, kBodyParts> MedianFactors() const;
  /// [dimensions, lags] of velocities, both sides alike, as MotionPrior has it.
  Eigen::MatrixXd VelocityCovariance(int lags) const;

 private:
  struct Track {
    double tempo = 1;
    std::vector<Pose> poses = {};
    Eigen::MatrixXd energy = {};         // [kBodyParts, frames], smoothed, metres a frame
    std::vector<double> beats = {};      // frames; of music, or of the dance's own grid
    std::vector<double> kinematic = {};  // frames in which it pauses
    int style = -1;
  };
  Track MakeTrack(const PreparedClip& clip, double tempo) const;
  std::vector<double> Beats(const Track& track, int64_t from, int64_t to, Random* random) const;

  Skeleton skeleton_;
  std::vector<std::string> styles_;
  std::vector<Track> tracks_;  // by tempo, the clips' own first
  size_t clips_ = 0;
};

}  // namespace choreo
