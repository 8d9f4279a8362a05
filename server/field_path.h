#pragma once

#include <string>

namespace choreo {

/// The path, in the message that was sent, of a field as errors name it for people. Those number
/// the messages of one kind in a stream, and leave out what holds a pose:
/// "keyframes[3].rotations[16]" is "keyframe.pose.rotations[16]". Vectors in an array are counted,
/// not their numbers. Whatever is such a path already stays as it is.
std::string PathInMessage(const std::string& field);

}  // namespace choreo
