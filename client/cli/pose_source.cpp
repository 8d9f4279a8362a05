#include "client/cli/pose_source.h"

#include "client/cli/key_file.h"
#include "client/cli/pose_library.h"
#include "model/fit/retarget.h"

namespace choreo::cli {

NamedPose ReadPose(const std::string& source, const Skeleton& skeleton) {
  const bool is_file = source.find_first_of(".@/") != std::string::npos;
  if (is_file) return {ReadKeys(source, skeleton).front()};
  client::KeyPose key;
  key.id = source;
  key.pose = Retarget(Skeleton::Smpl24(), FindLibraryPose(source).pose, skeleton);
  return {key, false};
}

}  // namespace choreo::cli
