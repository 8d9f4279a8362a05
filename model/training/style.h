#pragma once

#include <string>

namespace choreo {

/// What a clip's name says of how it is danced, as in Sophie_Afraid_v2 (afraid) or DANCE_W_12
/// (waltz): the mood or genre as requests name it; "" where it says nothing.
std::string StyleOf(const std::string& clip_name);

}  // namespace choreo
