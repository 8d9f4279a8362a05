#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "model/core/random.h"
#include "model/motion/motion.h"
#include "model/training/prepared_clip.h"

namespace choreo {

/// A prepared clip with what it says of itself.
struct ClipTrack {
  std::vector<Pose> poses = {};
  Eigen::MatrixXd energy = {};         ///< [kBodyParts, frames], smoothed, metres a frame
  std::vector<double> beats = {};      ///< frames; of the grid that its notes tell
  std::vector<double> kinematic = {};  ///< frames in which it pauses
  int style = -1;                      ///< index into the styles, or -1
  Eigen::Vector3d stage = Eigen::Vector3d::Zero();  ///< mean place of the root
};

/// `tempo` times as fast as it was danced. `styles`: ascending (StyleOf).
ClipTrack MakeTrack(const PreparedClip& clip, double tempo, const std::vector<std::string>& styles);

/// Beats of a song that the frames from `from` to `to` would be danced to, in frames behind `from`;
/// none where the dance's pauses are too uneven for one.
std::vector<double> BeatsFor(const ClipTrack& track, int64_t from, int64_t to, Random* random);

/// Each row under a Gaussian of `sigma` columns; the ends are held.
Eigen::MatrixXd SmoothRows(const Eigen::MatrixXd& rows, double sigma);

}  // namespace choreo
