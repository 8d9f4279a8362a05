#include "client/authoring/keys/key_file.h"
#include "client/authoring/keys/pose_file.h"
#include "tests/fuzz/fuzz.h"

FUZZ_TARGET(key_file) {
  using namespace choreo;
  const std::string text(fuzz::Text(data, size));
  const Skeleton& skeleton = Skeleton::Smpl24();
  fuzz::MayRefuse([&] { authoring::ParseKeyFile(text, "keys.json", skeleton); });
  fuzz::MayRefuse([&] { authoring::ParsePoseFile(text, "pose.json", skeleton); });
  return 0;
}
