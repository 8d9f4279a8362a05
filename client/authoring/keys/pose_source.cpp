#include "client/authoring/keys/pose_source.h"

#include <algorithm>
#include <iterator>

#include "client/authoring/keys/key_file.h"
#include "client/authoring/keys/pose_library.h"
#include "model/core/error.h"
#include "model/fit/retarget.h"

namespace choreo::authoring {

NamedPose ReadPose(const std::string& source, const Skeleton& skeleton, const Counts& counts) {
  const bool is_file = source.find_first_of(".@/") != std::string::npos;
  if (is_file) {
    std::vector<std::string> places;
    const std::vector<client::KeyPose> keys = ReadKeys(source, skeleton, &places, counts);
    const auto held = std::ranges::count_if(places, IsHeld);
    const auto poses = std::ssize(places) - held;
    if (poses == 1) return {keys.front(), true, {keys.begin() + 1, keys.end()}};
    throw InvalidArgument(source, "names " + std::to_string(poses) +
                                      " poses, must be 1: KEYS.json@ID or MOTION@SECOND");
  }
  client::KeyPose key;
  key.id = source;
  key.pose = Retarget(Skeleton::Smpl24(), FindLibraryPose(source).pose, skeleton);
  return {key, false};
}

}  // namespace choreo::authoring
