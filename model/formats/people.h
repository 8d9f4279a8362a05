#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "model/core/npy.h"
#include "model/formats/motion_reading.h"

/// Arrays of several people, [people, frames, ...]. Private to this folder.
namespace choreo {

/// The number of people in an array whose frames satisfy `is_frame`; 1 for an array of one person.
int64_t PeopleIn(const NpyArray& array, const std::function<bool(int64_t width)>& is_frame);

/// The person to read. Throws Error(kInvalidArgument), whose field is `key` if --body is not given.
int64_t ChoosePerson(int64_t people, const std::string& key, const MotionReading& reading);

/// The array of one person.
NpyArray PersonOf(const NpyArray& people, int64_t person);

}  // namespace choreo
