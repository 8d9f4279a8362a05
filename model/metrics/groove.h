#pragma once

#include <vector>

#include "model/metrics/joint_track.h"
#include "model/motion/skeleton.h"

/// Distinguishes a lively dance from poses that blend into each other. Pure functions of joint
/// positions, so real motion is measured in the same way. Thread-safe.
namespace choreo {

/// How far wrists and ankles travel, and how far they had to: sums over the four of them and the
/// spans between keys, metres. Path over chord is 1 for straight travel from key to key.
struct LimbTravel {
  double path = 0;   ///< frame by frame, in the world
  double chord = 0;  ///< straight from key to key
};
/// Spans lead from the track's first frame to keys[0], then to keys[1], ... Keys ascend within the
/// track. Throws Error(kInvalidArgument) for a skeleton without knees or elbows, whose children are
/// the limbs' ends.
LimbTravel MeasureLimbTravel(const Skeleton& skeleton, const JointTrack& track,
                             const std::vector<int>& keys);

/// Pelvis bounce, metres: the root mean square of joint 0's height, without frequencies below
/// kBounceHz (band_filter.h).
inline constexpr double kBounceHz = 1;
double PelvisBounce(const JointTrack& track, double fps);

/// Median over joints and frames of the third difference of positions, m/s^3 (Pace), after a
/// low-pass at kJerkHz that removes most recording noise; RawJerk omits the low-pass.
inline constexpr double kJerkHz = 8;
double SmoothJerk(const JointTrack& track, double fps);
double RawJerk(const JointTrack& track, double fps);

/// How often limbs snap straight or out of it, like legs pulled to full length: steps (frame i to i
/// + 1) in which a hinge turns faster than 240 degrees a second (8 degrees a frame at 30 fps) from
/// or to less than 5 degrees of flexion. Flexion is the angle between the bones above and below the
/// joint, 0 if they are aligned. Each limb counts separately.
struct Snaps {
  int knees = 0, elbows = 0;
};

/// Ignores joints that the skeleton has no role for.
Snaps CountSnaps(const Skeleton& skeleton, double fps, const JointTrack& track);

/// Physical foot contact score, PFC (EDGE, Tseng et al. 2023, Section 4.1): accelerating the body
/// takes a standing foot. Mean over frames of |a| / max|a| * left * right, times 10 000, as in the
/// authors' eval_pfc.py: a is the root's acceleration without its downward part; left and right are
/// the floor distances that the slower of ankle and toes travels, metres a frame. 0 for fewer than
/// three frames. Throws Error(kInvalidArgument) if the skeleton lacks a foot joint.
double PhysicalFootContact(const Skeleton& skeleton, const JointTrack& track);

}  // namespace choreo
