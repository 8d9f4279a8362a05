#pragma once

#include <string>
#include <vector>

#include "client/choreo_client.h"

namespace choreo::authoring {

/// A pose in the library's format: a key file (key_file.h) with one key, a description and tags.
struct DescribedPose {
  client::KeyPose key;
  std::string description;
  std::vector<std::string> tags;
  double hold_s = 0;  ///< how long to hold the pose, seconds; 0: not at all
};

/// The text of a pose file: metres and radians to 4 decimals, one line per joint.
std::string PoseFileText(const DescribedPose& pose, const Skeleton& skeleton);

/// Parses a pose file called `name`. Throws as ParseKeyFile does, also with the fields
/// NAME:description and NAME:tags.
DescribedPose ParsePoseFile(const std::string& text, const std::string& name,
                            const Skeleton& skeleton);

}  // namespace choreo::authoring
