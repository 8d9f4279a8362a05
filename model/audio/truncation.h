#pragma once

#include <string>

#include "model/audio/byte_source.h"

namespace choreo {

/// Throws Error(kInvalidArgument), with `name` as field, for a WAV file whose samples end before
/// its header says so, and for an Ogg file that does not end with a whole page marked as the last.
/// libsndfile plays both without a word. Passes whatever else the bytes are.
void CheckNotTruncated(const ByteSource& source, const std::string& name);

}  // namespace choreo
