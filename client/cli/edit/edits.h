#pragma once

#include <string>

#include "client/cli/edit/working_dance.h"

/// What `choreo edit` dances anew. Errors name the option.
namespace choreo::cli {

// Single keys.

/// Refuses keys to set that are too near to each other.
void CheckKeys(const EditOptions& options, const DanceTimes& times);
/// Removes a key of the report: its two intervals become one.
void RemoveKey(const std::string& id, WorkingDance* dance);
/// Moves a key of the report, with the keys that hold it, to another second, in the pose and
/// place in which it was danced. --hold changes how long it is held.
void MoveKey(const EditOptions& options, const std::string& id, double to_s, WorkingDance* dance);
/// Sets a key, and generates the two intervals around it again. `source` as in --key.
void SetKey(const EditOptions& options, const std::string& source, double at_s,
            WorkingDance* dance);
/// Makes the dance end in a pose, as `choreo dance --end` does. Removes later keys.
void EndInPose(const EditOptions& options, const std::string& source, WorkingDance* dance);

// Phrases: all keys of the report within [from_s, until_s).

/// Multiplies the keys' distance in time from from_s by `times`. They keep their places on the
/// floor and replace the keys at their new times. Leaves out keys that would be after the dance's
/// end.
void StretchPhrase(double from_s, double until_s, double times, WorkingDance* dance);
/// Repeats the keys `later`, moved and turned to the dancer's place and facing at that time, and
/// replaces the keys there.
void RepeatPhrase(double from_s, double until_s, const std::string& later, WorkingDance* dance);
/// Mirrors the keys, relative to the dancer's place and facing at the first of them.
void MirrorPhrase(double from_s, double until_s, WorkingDance* dance);

// All frames of a part, through the keys there.

/// Generates the frames between two seconds again, through the keys there.
void Retake(double from_s, double until_s, WorkingDance* dance);
/// Generates the whole dance again, through its keys, with the options' settings. If only the
/// path changes, starts at the path's beginning. If only counts change, generates nothing.
void DanceOtherwise(const EditOptions& options, WorkingDance* dance);
/// Leads the last frames back to the first one. If a held pose ends the dance, adds new frames
/// for that.
void CloseLoop(WorkingDance* dance);

}  // namespace choreo::cli
