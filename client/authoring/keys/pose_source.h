#pragma once

#include <string>
#include <vector>

#include "client/authoring/fields/counts.h"
#include "client/choreo_client.h"

namespace choreo::authoring {

/// A pose named on a command line.
struct NamedPose {
  client::KeyPose key = {};
  bool has_place = true;  ///< false for library poses, which are around the origin, facing +Z
  /// The keys of a key file that hold the pose, if any, with times relative to the key's.
  std::vector<client::KeyPose> held = {};
};

/// How long the pose is held, seconds; 0 if it is not.
inline double HeldSeconds(const NamedPose& pose) {
  return pose.held.empty() ? 0 : pose.held.back().time_s - pose.key.time_s;
}

/// Reads a pose by its name in the library, or from a source for ReadKeys (key_file.h): a key file
/// with one pose, KEYS.json@ID, or MOTION@SECOND. `counts`: the music's, for times in counts.
/// Throws as FindLibraryPose and ReadKeys do, and Error(kInvalidArgument) for a source with several
/// poses.
NamedPose ReadPose(const std::string& source, const Skeleton& skeleton, const Counts& counts = {});

}  // namespace choreo::authoring
