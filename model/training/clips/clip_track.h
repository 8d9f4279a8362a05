#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "model/core/numbers/random.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/motion.h"
#include "model/training/clips/prepared_clip.h"

namespace choreo {

/// A prepared clip as training uses it, with its labels.
struct ClipTrack {
  std::vector<Pose> poses = {};
  Eigen::MatrixXd energy = {};  ///< [kBodyParts, frames] smoothed velocity factors, metres a frame
  std::vector<double> beats = {};      ///< frames, of the BeatGrid in the clip's notes
  std::vector<double> kinematic = {};  ///< frames, of kinematic beats
  int style = -1;                      ///< index into the styles, or -1
  GroundFrame stage = {};              ///< mean position and heading of the root
};

/// Makes the track of a clip played at `tempo` times its speed. `styles`: ascending (StyleOf).
ClipTrack MakeTrack(const PreparedClip& clip, double tempo, const std::vector<std::string>& styles);

/// Beats of a song that would suit frames `from` to `to`, in frames after `from`. None if the
/// dance's kinematic beats are too uneven.
std::vector<double> BeatsFor(const ClipTrack& track, int64_t from, int64_t to, Random* random);

/// Smooths each row with a Gaussian of `sigma` columns, holding the end values.
Eigen::MatrixXd SmoothRows(const Eigen::MatrixXd& rows, double sigma);

}  // namespace choreo
