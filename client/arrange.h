#pragma once

#include <cstdint>

#include "client/edit.h"
#include "model/motion/canonical.h"

/// Edits whole dances: cuts a part, mirrors, joins. All but Join with a client are pure functions.
/// Contacts are kept if both dances have them.
namespace choreo::client {

/// Copies the frames [first, end) of a dance, bit for bit. Throws Error(kInvalidArgument, "dance")
/// for a part that is empty or not in the dance.
FinishedDance PartOf(const FinishedDance& dance, int64_t first, int64_t end);

/// The same dance with left and right swapped, in the plane x = 0 (motion/mirror.h). Throws
/// Error(kInvalidArgument) for a skeleton without paired joints.
FinishedDance Mirrored(const Skeleton& skeleton, const FinishedDance& dance);

/// A dance at another rate (motion/resample.h).
FinishedDance AtRate(FinishedDance dance, double fps);

/// Moves a motion: its place relative to `to` becomes that relative to `from`.
Motion Moved(Motion motion, const GroundFrame& from, const GroundFrame& to);

/// A dance moved and turned so that its first frame has the position and facing of `pose`.
FinishedDance BegunAt(const Pose& pose, FinishedDance dance);

/// Whether a dance begins in this pose and place, to the accuracy of keys.
bool BeginsIn(const Skeleton& skeleton, const FinishedDance& dance, const Pose& pose);

/// Joins two dances of the same rate, unchanged.
FinishedDance Join(FinishedDance first, const FinishedDance& second);

/// Joins them with `gap` frames of the model, at least kMinKeyDistance, between the last frame of
/// one and the first of the other, which are danced. Fails like DanceAnew.
EditedDance Join(const Client& client, FinishedDance first, const FinishedDance& second,
                 const EditOptions& options, int64_t gap);

}  // namespace choreo::client
