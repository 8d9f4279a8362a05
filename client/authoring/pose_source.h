#pragma once

#include <string>
#include <vector>

#include "client/authoring/counts.h"
#include "client/choreo_client.h"

namespace choreo::authoring {

/// A pose named on a command line.
struct NamedPose {
  client::KeyPose key;
  bool has_place = true;  ///< false for library poses, which are around the origin, facing +Z
  /// Keys that hold it, if given by a key file, with times relative to its own.
  std::vector<client::KeyPose> held = {};
};

/// A pose by its name in the library, or a source for ReadKeys (key_file.h): a key file with one
/// pose, KEYS.json@ID, or MOTION@SECOND. Errors as theirs; Error(kInvalidArgument) for a source
/// with several poses. `counts`: those of the music, for times in counts.
NamedPose ReadPose(const std::string& source, const Skeleton& skeleton, const Counts& counts = {});

}  // namespace choreo::authoring
