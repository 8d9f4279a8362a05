#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// How lively each part of the body is: the velocity factors of paper C, Section 3.3.2, Eq. 1.
enum class BodyPart { kTrunk, kLeftArm, kRightArm, kLeftLeg, kRightLeg };
inline constexpr int kBodyParts = 5;

/// "trunk", "left_arm", "right_arm", "left_leg", "right_leg", in the order of BodyPart.
inline constexpr std::array<std::string_view, kBodyParts> kBodyPartNames = {
    "trunk", "left_arm", "right_arm", "left_leg", "right_leg"};

/// All of them, for messages: "trunk, left_arm, ...".
std::string BodyPartNames();

/// The part of that name, or none.
std::optional<BodyPart> FindBodyPart(std::string_view name);

/// What may be asked of a part.
inline constexpr float kMaxVelocityFactor = 10;  ///< a multiplier of a reference
inline constexpr float kMaxVelocity = 0.5F;      ///< metres a frame

/// What is added to the energy of body parts that nobody asks anything of: to EnergyLevel
/// (flow/motion_prior.h), of the frames before and of those to come.
struct EnergyShift {
  double before = 0, now = 0;
};

/// What paper C calls done as told (Section 4.3).
inline constexpr double kVelocityTolerance = 0.01;  ///< delta_v: 1 cm a frame
inline constexpr double kRootTolerance = 0.07;      ///< delta_r: the root off its path, 7 cm

/// [5, joints]: the share that each joint has in each part's factor. A joint belongs to one part;
/// every row sums to 1.
using BodyPartWeights = Eigen::Matrix<double, kBodyParts, Eigen::Dynamic>;

/// The weights before they are made shares, by joint name (paper C, Figure 4; its authors' code):
/// legs 1, 2, 3, 4 from hip over knee and ankle to toes (a heel: 4); arms 1, 2, 3, 4 from shoulder
/// over elbow and wrist to hand (a thumb: 4; a collar belongs to its arm: 1); trunk: the root, the
/// spine, the chest and the neck 1, the head 2. Throws Error(kInvalidArgument) naming a joint that
/// none of these is, or a part that has no joint.
BodyPartWeights WeighBodyParts(const Skeleton& skeleton);

/// Velocity factors of one frame, metres a frame, each at least 0: of each part the weighted mean
/// of its joints' speeds from the frame before. The root's speed is that of its position in the
/// world, the other joints' that of their positions less the root's, axes the world's (the paper's
/// p_t^r, p_t^b). Positions are [3, joints], metres, joint 0 the root. Thread-safe; moving or
/// turning the scene does not change them.
std::array<double, kBodyParts> VelocityFactors(const BodyPartWeights& weights,
                                               const Eigen::Matrix3Xd& positions_before,
                                               const Eigen::Matrix3Xd& positions);

/// Their mean over the steps between successive poses, of which there are at least two.
std::array<double, kBodyParts> MeanVelocityFactors(const Skeleton& skeleton,
                                                   std::span<const Pose> poses);

}  // namespace choreo
