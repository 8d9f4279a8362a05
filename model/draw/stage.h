#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "model/body/doll.h"
#include "model/draw/view.h"
#include "model/motion/skeleton_motion.h"

/// Everybody in one picture. The camera follows a single dancer, seen three quarters from her
/// front; it sees several from the front of the stage, +Z, around their middle.
namespace choreo {

using Stage = std::vector<SkeletonMotion>;

/// Throws Error(kInvalidArgument) for no dancers, a dancer without frames, or different rates.
void CheckStage(const Stage& stage);

/// The frames of the longest motion. Shorter ones hold their last pose.
int64_t CountFrames(const Stage& stage);
const Pose& PoseOf(const SkeletonMotion& dancer, int64_t frame);

/// The mean position of the roots on the floor, x and z.
Eigen::Vector2d MiddleOf(const Stage& stage, int64_t frame);

/// The bodies at a frame.
std::vector<PlacedPart> FiguresAt(const Stage& stage, int64_t frame);

/// The views of these frames, each centred on its floor position, for pictures of this aspect
/// (width over height), wide enough for everybody.
struct FramedStage {
  int64_t frame = 0;
  Eigen::Vector2d middle;
};
std::vector<View> ViewsOf(const Stage& stage, const std::vector<FramedStage>& frames,
                          double aspect);

}  // namespace choreo
