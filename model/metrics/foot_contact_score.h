#pragma once

#include "model/metrics/joint_track.h"

namespace choreo {

/// Physical foot contact score, PFC (EDGE, Tseng et al. 2023, Section 4.1): accelerating the body
/// takes a foot that stands. Mean over frames of |a| / max|a| * left * right, times 10 000, as in
/// the authors' eval_pfc.py: a is the root's acceleration without its downward part, left and right
/// the way over the floor of the slower of ankle and toes, metres a frame. 0 for fewer than three
/// frames. Throws Error(kInvalidArgument) if the skeleton lacks a foot joint.
double PhysicalFootContact(const Skeleton& skeleton, const JointTrack& track);

}  // namespace choreo
