#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "model/body/doll.h"
#include "model/draw/view.h"
#include "model/motion/skeleton_motion.h"

/// All who are seen in one picture. One dancer is followed by the camera and seen three quarters
/// from her front; several are seen from the front of the stage, +Z, from the middle between them.
namespace choreo {

using Stage = std::vector<SkeletonMotion>;

/// Throws Error(kInvalidArgument) for nobody, a dancer without frames, and rates that differ.
void CheckStage(const Stage& stage);

/// The frames of the longest motion. Whoever is done holds her last pose.
int64_t CountFrames(const Stage& stage);
const Pose& PoseOf(const SkeletonMotion& dancer, int64_t frame);

/// The mean of the roots' places over the floor, x and z.
Eigen::Vector2d MiddleOf(const Stage& stage, int64_t frame);

/// The bodies at a frame.
std::vector<PlacedPart> FiguresAt(const Stage& stage, int64_t frame);

/// The views of these frames, each with its place on the floor in the middle, in pictures of this
/// aspect (width over height) in which everybody fits.
struct FramedStage {
  int64_t frame = 0;
  Eigen::Vector2d middle;
};
std::vector<View> ViewsOf(const Stage& stage, const std::vector<FramedStage>& frames,
                          double aspect);

}  // namespace choreo
