#pragma once

#include <string>
#include <vector>

#include "client/choreo_client.h"

namespace choreo::authoring {

/// A pose in the library's format: a key file (key_file.h) with one key, which describes itself.
struct DescribedPose {
  client::KeyPose key;
  std::string description;
  std::vector<std::string> tags;
};

/// The file's text: metres and radians to a tenth of a thousandth, one line per joint.
std::string PoseFileText(const DescribedPose& pose, const Skeleton& skeleton);

/// Reads one. `name` is the file's; fails like ParseKeyFile, also with the fields NAME:description
/// and NAME:tags.
DescribedPose ParsePoseFile(const std::string& text, const std::string& name,
                            const Skeleton& skeleton);

}  // namespace choreo::authoring
