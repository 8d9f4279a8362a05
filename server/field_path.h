#pragma once

#include <string>

namespace choreo {

/// The path of a field in the sent message, from its name in errors for people. Those number the
/// messages of one kind in a stream, and omit the message around a pose:
/// "keyframes[3].rotations[16]" is "keyframe.pose.rotations[16]". Vectors in an array are counted,
/// not their numbers. Keeps what already is such a path.
std::string PathInMessage(const std::string& field);

}  // namespace choreo
