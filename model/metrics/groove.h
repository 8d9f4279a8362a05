#pragma once

#include <vector>

#include "model/metrics/joint_track.h"
#include "model/motion/skeleton.h"

/// What tells a dance that lives from poses that melt into each other. All are pure functions of
/// joint positions, so that real motion is measured alike. Thread-safe.
namespace choreo {

/// How far wrists and ankles go, and how far they had to: sums over the four of them and over the
/// spans between keys, metres. Path over chord is 1 for who goes straight from key to key.
struct LimbTravel {
  double path = 0;   ///< along the way, frame by frame, in the world
  double chord = 0;  ///< straight from a key to the next
};
/// Spans lead from the track's first frame to keys[0], from there to keys[1], ... Keys ascend and
/// lie within the track. Throws Error(kInvalidArgument) for a skeleton without knees or elbows,
/// whose children the limbs' ends are.
LimbTravel MeasureLimbTravel(const Skeleton& skeleton, const JointTrack& track,
                             const std::vector<int>& keys);

/// How much the pelvis bounces, metres: the root mean square of the height of joint 0 without what
/// is slower than kBounceHz (band_filter.h).
inline constexpr double kBounceHz = 1;
double PelvisBounce(const JointTrack& track, double fps);

/// Median over joints and frames of the third difference of positions, m/s^3 (Pace), after a
/// low-pass at kJerkHz, which takes most of a recording's noise away; RawJerk is without.
inline constexpr double kJerkHz = 8;
double SmoothJerk(const JointTrack& track, double fps);
double RawJerk(const JointTrack& track, double fps);

/// How often limbs snap straight or out of it, as legs do that are drawn to their full length:
/// steps (frame i to i + 1) in which a hinge turns faster than 240 degrees a second (8 degrees a
/// frame at 30 fps) from or to less than 5 degrees of flexion. Flexion is the angle between the
/// bones above and below the joint, 0 where they are in line. Each limb counts by itself.
struct Snaps {
  int knees = 0, elbows = 0;
};

/// Joints that the skeleton has no role for do not count.
Snaps CountSnaps(const Skeleton& skeleton, double fps, const JointTrack& track);

/// Physical foot contact score, PFC (EDGE, Tseng et al. 2023, Section 4.1): accelerating the body
/// takes a foot that stands. Mean over frames of |a| / max|a| * left * right, times 10 000, as in
/// the authors' eval_pfc.py: a is the root's acceleration without its downward part, left and right
/// the way over the floor of the slower of ankle and toes, metres a frame. 0 for fewer than three
/// frames. Throws Error(kInvalidArgument) if the skeleton lacks a foot joint.
double PhysicalFootContact(const Skeleton& skeleton, const JointTrack& track);

}  // namespace choreo
