#pragma once

#include <cmath>
#include <vector>

#include "model/flow/window/flow_model.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/support/synthetic_clips.h"

/// Scenes for tests of windows and sampling.
namespace choreo {

inline constexpr int kTau = 10;

/// A smooth, untrained prior.
inline FlowModelParts Parts() {
  const Skeleton& skeleton = Skeleton::Smpl24();
  const int dimensions = 3 + 3 * skeleton.joints();
  Eigen::MatrixXd covariance(dimensions, 60);
  for (int lag = 0; lag < covariance.cols(); ++lag)
    covariance.col(lag).setConstant(1e-4 * std::exp(-0.5 * std::pow(lag / 6.0, 2)));
  return {skeleton,
          {.window_frames = 40},
          MotionPrior(covariance),
          Eigen::MatrixXd::Identity(dimensions, dimensions)};
}

/// History and key out of a synthetic dance, in the canonical frame.
struct Scene {
  WindowRequest request;
  std::vector<Pose> truth;
};

inline Scene MakeScene(int frames) {
  const PreparedClip clip = testing_support::SyntheticClip("a", kTau + frames, 0.4, false);
  std::vector<Pose> poses = clip.motion.frames;
  const GroundFrame ground = GroundFrame::Of(poses[kTau - 1]);
  for (Pose& pose : poses) pose = ground.ToLocal(pose);
  Scene scene{{{.frames = frames, .target = Target{poses.back(), {}}}, frames}, {}};
  scene.request.history.assign(poses.begin(), poses.begin() + kTau);
  scene.truth.assign(poses.begin() + kTau, poses.end());
  return scene;
}

inline double Apart(const Pose& a, const Pose& b) {
  return ComparePoses(Skeleton::Smpl24(), a, b).position_m;
}

}  // namespace choreo
