#pragma once

#include <cstdint>

#include "client/edit.h"
#include "model/motion/kinematics/canonical.h"

/// Edits whole dances: cuts a part, mirrors, joins. All but Join with a client are pure functions.
/// Contacts are kept if both dances have them.
namespace choreo::client {

/// Copies the frames [first, end) of a dance, bit for bit. Throws Error(kInvalidArgument, "dance")
/// for a part that is empty or not in the dance.
FinishedDance PartOf(const FinishedDance& dance, int64_t first, int64_t end);

/// Swaps left and right: mirrors a dance in the plane x = 0 (motion/kinematics/mirror.h). Throws
/// Error(kInvalidArgument) for a skeleton without paired joints.
FinishedDance Mirrored(const Skeleton& skeleton, const FinishedDance& dance);

/// Resamples a dance to another frame rate (motion/resample.h).
FinishedDance AtRate(FinishedDance dance, double fps);

/// Moves and turns a motion rigidly: it is then to `to` as it was to `from`.
Motion Moved(Motion motion, const GroundFrame& from, const GroundFrame& to);

/// Moves and turns a dance so that its first frame has the position and facing of `pose`.
FinishedDance BegunAt(const Pose& pose, FinishedDance dance);

/// Whether a dance begins in this pose and place, within the tolerance of keys (kMaxKeyError_m and
/// kMaxKeyError_deg).
bool BeginsIn(const Skeleton& skeleton, const FinishedDance& dance, const Pose& pose);

/// Appends `second`, unchanged, to `first`. Both must have the same rate.
FinishedDance Join(FinishedDance first, const FinishedDance& second);

/// Appends `second` to `first` with a generated transition. `gap`: the distance from the last frame
/// of `first` to the first frame of `second`, in frames of the model, at least kMinKeyDistance.
/// Throws as DanceAnew does.
EditedDance Join(const Client& client, FinishedDance first, const FinishedDance& second,
                 const EditOptions& options, int64_t gap);

}  // namespace choreo::client
