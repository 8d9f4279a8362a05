#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "model/core/files/npy.h"
#include "model/formats/reading/motion_reading.h"

/// Finds one person in arrays of several people. Private to this folder.
namespace choreo {

/// The number of people in an array [people, frames, ...] or [frames, people, ...] whose frames
/// satisfy `is_frame`: the smaller extent. 1 for an array of one person.
int64_t PeopleIn(const NpyArray& array, const std::function<bool(int64_t width)>& is_frame);

/// The person to read: --body's, or the first, with a note. Throws Error(kInvalidArgument), whose
/// field is --body.
int64_t ChoosePerson(int64_t people, const std::string& key, const MotionReading& reading);

/// Whether one of an array's first two extents is `people`.
bool HoldsPeople(const NpyArray& array, int64_t people);

/// The array of one of `people` people.
NpyArray PersonOf(const NpyArray& array, int64_t people, int64_t person);

}  // namespace choreo
