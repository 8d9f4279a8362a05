#pragma once

#include <vector>

#include "model/metrics/joint_track.h"
#include "model/motion/skeleton.h"

/// Distinguishes a lively dance from poses that blend into each other. Pure functions of joint
/// positions, of generated and real motion alike. Thread-safe.
namespace choreo {

/// The distances that wrists and ankles travel, and need to travel: sums over these four joints and
/// all spans between keys, metres. Path over chord is 1 for straight travel from key to key.
struct LimbTravel {
  double path = 0;   ///< frame by frame, in the world
  double chord = 0;  ///< straight from key to key
};
/// The first span leads from the track's first frame to keys[0], the next to keys[1], and so on.
/// Keys are frames of the track, ascending. A limb's end is the child of its knee or elbow. Throws
/// Error(kInvalidArgument) for a skeleton without knees or elbows.
LimbTravel MeasureLimbTravel(const Skeleton& skeleton, const JointTrack& track,
                             const std::vector<int>& keys);

/// Pelvis bounce, metres: the RMS of joint 0's height above kBounceHz (band_filter.h).
inline constexpr double kBounceHz = 1;
double PelvisBounce(const JointTrack& track, double fps);

/// The median jerk over joints and frames, m/s^3 (Pace), after a low-pass filter at kJerkHz, which
/// removes most recording noise. RawJerk omits the filter.
inline constexpr double kJerkHz = 8;
double SmoothJerk(const JointTrack& track, double fps);
double RawJerk(const JointTrack& track, double fps);

/// Counts of limbs that snap to or from straight, like legs pulled to full length: steps (frame i
/// to i + 1) in which a hinge turns faster than 240 degrees per second (8 degrees a frame at 30
/// fps) from or to less than 5 degrees of flexion. Flexion is the angle between the bones above and
/// below the joint, 0 if aligned. Each limb counts separately.
struct Snaps {
  int knees = 0, elbows = 0;
};

/// Ignores limbs without a role in the skeleton.
Snaps CountSnaps(const Skeleton& skeleton, double fps, const JointTrack& track);

/// The physical foot contact score, PFC (EDGE, Tseng et al. 2023, Section 4.1), which is low if a
/// foot stands whenever the body accelerates. As in the authors' eval_pfc.py, it is the mean over
/// frames of |a| / max|a| * left * right, times 10,000, where a is the root's acceleration without
/// its downward part, and left and right are the horizontal distances that the slower of ankle and
/// toes travels, metres per frame. 0 for fewer than three frames. Throws Error(kInvalidArgument) if
/// the skeleton lacks a foot joint.
double PhysicalFootContact(const Skeleton& skeleton, const JointTrack& track);

}  // namespace choreo
