#pragma once

#include <string>
#include <vector>

#include "client/choreo_client.h"

namespace choreo::cli {

/// One pose that was named on a command line.
struct NamedPose {
  client::KeyPose key;
  bool has_place = true;  ///< false for one of the library: it stands around the origin, facing +Z
  /// Those that keep it, where a key file says that it is held; of a time from its own on.
  std::vector<client::KeyPose> held = {};
};

/// A pose by its name in the library, or what ReadKeys takes (key_file.h): a key file with one
/// pose, KEYS.json@ID, or MOTION@SECOND. Errors as theirs; Error(kInvalidArgument) for a source of
/// several poses.
NamedPose ReadPose(const std::string& source, const Skeleton& skeleton);

}  // namespace choreo::cli
