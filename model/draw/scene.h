#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/body/doll.h"
#include "model/draw/view.h"
#include "model/motion/skeleton_motion.h"

/// Shows several dancers in one picture. The camera moves over the floor with the middle of the
/// dancers.
namespace choreo {

/// The side from which the camera looks: relative to a single dancer's heading in the first frame,
/// or to the front of the stage, +Z, for several.
enum class CameraSide {
  kFront,
  kThreeQuarter,
  kSide,  ///< the left
  kBack,
  kFollow  ///< three quarters from the front, turning with a single dancer
};
/// Names, indexed by CameraSide.
inline constexpr std::array<const char*, 5> kCameraNames = {"front", "three-quarter", "side",
                                                            "back", "follow"};
/// Throws Error(kInvalidArgument) whose field is "camera" for another name.
CameraSide FindCamera(const std::string& name);

/// Smoothing of the path that the camera follows, seconds.
inline constexpr double kCameraLag = 0.6;

using Scene = std::vector<SkeletonMotion>;

/// Throws Error(kInvalidArgument) for no dancers, a dancer without frames, or different rates.
void CheckScene(const Scene& scene);

/// The number of frames of the longest motion. Shorter ones hold their last pose.
int64_t CountFrames(const Scene& scene);
const Pose& PoseOf(const SkeletonMotion& dancer, int64_t frame);

/// The mean position of the roots on the floor, x and z.
Eigen::Vector2d MiddleOf(const Scene& scene, int64_t frame);

/// The parts of all bodies at a frame.
std::vector<PlacedPart> DollsAt(const Scene& scene, int64_t frame);

/// A frame and the floor position (x, z) at the middle of its picture, metres.
struct FramedScene {
  int64_t frame = 0;
  Eigen::Vector2d middle;
};
/// Views of these frames for pictures of this aspect (width over height), wide enough for all
/// dancers. The default side is three quarters from the front for one dancer, the front for
/// several. Throws Error(kInvalidArgument), whose field is "camera", if the camera is to follow
/// several dancers.
std::vector<View> ViewsOf(const Scene& scene, const std::vector<FramedScene>& frames, double aspect,
                          std::optional<CameraSide> side = {});

}  // namespace choreo
