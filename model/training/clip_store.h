#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "model/core/random.h"
#include "model/flow/transition_tensors.h"
#include "model/motion/pose_codec.h"
#include "model/training/clip_split.h"

namespace choreo {

/// A batch of windows of real motion, tau history frames and then N, in the canonical frame of the
/// last history frame.
struct MotionBatch {
  TransitionTensors transition;
  TrajectoryTensors truth;  ///< the N frames
  torch::Tensor features;   ///< [batch, tau + N, width] absolute, as PoseCodec has them
  torch::Tensor audio;      ///< [batch, tau + N, audio_features], zeros where there is none
  torch::Tensor has_audio;  ///< [batch, 1]

  MotionBatch To(torch::Device device) const;
};

/// Prepared clips of some groups in memory; immutable after construction.
class ClipStore {
 public:
  /// Throws as LoadClips does.
  ClipStore(const std::vector<std::filesystem::path>& folders,
            const std::filesystem::path& splits_file, const std::set<std::string>& groups);

  /// What training varies. Everything off: plain windows with their key and music.
  struct Variation {
    bool mirror = false;
    double drop_key = 0;     ///< probability that a window has no key
    double drop_audio = 0;   ///< probability that its music is masked
    double partial_key = 0;  ///< probability that joints or the root's position are not in the key
    double hold_history =
        0;  ///< probability that only the last few poses are known, the earliest being held
  };
  /// Draws `batch` windows of N = `frames` behind `history` frames.
  MotionBatch Draw(int batch, int history, int frames, const Variation& variation,
                   Random* random) const;

  const std::vector<PreparedClip>& clips() const { return clips_; }
  const Skeleton& skeleton() const { return skeleton_; }
  bool HasMusic() const;

 private:
  std::vector<PreparedClip> clips_;
  std::vector<int64_t> frames_;  // of each
  Skeleton skeleton_;
};

}  // namespace choreo
