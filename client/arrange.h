#pragma once

#include <cstdint>

#include "client/edit.h"
#include "model/motion/canonical.h"

/// Edits of whole dances: a part of one, its mirror image, one behind another. All but Join with a
/// client are pure functions. Contacts stay where both dances have them.
namespace choreo::client {

/// The frames [first, end) of a dance, bit for bit. Throws Error(kInvalidArgument, "dance") for a
/// part that has no frame or is not in the dance.
FinishedDance PartOf(const FinishedDance& dance, int64_t first, int64_t end);

/// The same dance with left and right exchanged, in the plane x = 0 (motion/mirror.h). Throws
/// Error(kInvalidArgument) for a skeleton whose joints are no pairs.
FinishedDance Mirrored(const Skeleton& skeleton, const FinishedDance& dance);

/// A dance at another rate (motion/resample.h).
FinishedDance AtRate(FinishedDance dance, double fps);

/// The same motion elsewhere: what it does in one frame on the floor, it does in the other.
Motion Moved(Motion motion, const GroundFrame& from, const GroundFrame& to);

/// A dance moved and turned so that its first frame stands and faces as `pose` does.
FinishedDance BegunAt(const Pose& pose, FinishedDance dance);

/// Whether a dance begins in this pose and place, as exactly as keys are hit.
bool BeginsIn(const Skeleton& skeleton, const FinishedDance& dance, const Pose& pose);

/// One dance behind another, as they are; both have one rate.
FinishedDance Join(FinishedDance first, const FinishedDance& second);

/// The same with `gap` frames of the model, at least kMinKeyDistance, from the last frame of one to
/// the first of the other: what lies between is danced. Errors as DanceFreely.
EditedDance Join(const Client& client, FinishedDance first, const FinishedDance& second,
                 const EditOptions& options, int64_t gap);

}  // namespace choreo::client
