#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "model/core/npy.h"
#include "model/formats/motion_reading.h"

/// Arrays of several people, [people, frames, ...], as those write that see several. Private to
/// this folder.
namespace choreo {

/// How many people an array holds, of whose frames each is `is_frame` numbers wide; 1 where it is
/// of one.
int64_t PeopleIn(const NpyArray& array, const std::function<bool(int64_t width)>& is_frame);

/// Which of them is read. Throws Error(kInvalidArgument): where --body does not say, its field is
/// `key`.
int64_t ChoosePerson(int64_t people, const std::string& key, const MotionReading& reading);

/// The array of one of them.
NpyArray PersonOf(const NpyArray& people, int64_t person);

}  // namespace choreo
