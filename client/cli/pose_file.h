#pragma once

#include <string>
#include <vector>

#include "client/choreo_client.h"

namespace choreo::cli {

/// A pose as the library has its own: a key file (key_file.h) with one key, which says more about
/// itself.
struct DescribedPose {
  client::KeyPose key;
  std::string description;
  std::vector<std::string> tags;
};

/// The file's text: metres and radians to a tenth of a thousandth, a line a joint.
std::string PoseFileText(const DescribedPose& pose, const Skeleton& skeleton);

/// Reads one. `name` is the file's; what is wrong is told as by ParseKeyFile, with the fields
/// NAME:description and NAME:tags.
DescribedPose ParsePoseFile(const std::string& text, const std::string& name,
                            const Skeleton& skeleton);

}  // namespace choreo::cli
