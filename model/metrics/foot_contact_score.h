#pragma once

#include "model/metrics/joint_track.h"

namespace choreo {

/// Physical foot contact score, PFC (EDGE, Tseng et al. 2023, Section 4.1): accelerating the body
/// takes a foot that stands. Lower is better; no unit.
///
/// Mean over frames of |a| / max|a| * left * right, times 10 000, as in the authors' eval_pfc.py: a
/// is the root's acceleration (for the centre of mass) without its downward part, left and right
/// the way in metres over the floor that the slower of ankle and toes goes in a frame; up and down
/// do not count. 0 for fewer than three frames and where nothing accelerates. Throws
/// Error(kInvalidArgument) if the skeleton lacks a foot joint.
double PhysicalFootContact(const Skeleton& skeleton, const JointTrack& track);

}  // namespace choreo
