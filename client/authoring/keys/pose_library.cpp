#include "client/authoring/keys/pose_library.h"

#include <algorithm>

#include "client/authoring/keys/pose_file.h"
#include "client/authoring/keys/pose_sources.h"
#include "model/core/error.h"
#include "model/core/text/nearest.h"
#include "model/fit/retarget.h"

namespace choreo::authoring {
namespace {

constexpr const char* kEnding = "ending";

std::vector<LibraryPose> ParseLibrary() {
  std::vector<LibraryPose> poses;
  for (const PoseSource& source : kPoseSources) {
    DescribedPose read = ParsePoseFile(source.json, source.name, Skeleton::Smpl24());
    poses.push_back({.id = std::move(read.key.id),
                     .description = std::move(read.description),
                     .tags = std::move(read.tags),
                     .pose = std::move(read.key.pose)});
  }
  return poses;
}

}  // namespace

const std::vector<std::string>& PoseTags() {
  static const std::vector<std::string> kTags = {"standing", "travelling", "jump", "floor",
                                                 kEnding};
  return kTags;
}

const std::vector<LibraryPose>& PoseLibrary() {
  static const std::vector<LibraryPose> kPoses = ParseLibrary();
  return kPoses;
}

bool IsEnding(const LibraryPose& pose) {
  return std::ranges::find(pose.tags, kEnding) != pose.tags.end();
}

std::vector<LibraryPose> PosesFor(const Skeleton& skeleton) {
  std::vector<LibraryPose> poses = PoseLibrary();
  try {
    for (LibraryPose& pose : poses) pose.pose = Retarget(Skeleton::Smpl24(), pose.pose, skeleton);
  } catch (const Error& error) {
    throw InvalidArgument("keyframes",
                          "key poses are needed: those of the library do not fit the model (" +
                              std::string(error.what()) + ")");
  }
  return poses;
}

std::vector<LibraryPose> PosesToDance(const Skeleton& skeleton) {
  std::vector<LibraryPose> poses = PosesFor(skeleton);
  std::erase_if(poses, [](const LibraryPose& pose) {
    return pose.tags.front() == "jump" || pose.tags.front() == "floor";
  });
  return poses;
}

const LibraryPose& FindLibraryPose(const std::string& id) {
  const auto& poses = PoseLibrary();
  const auto found = std::find_if(poses.begin(), poses.end(),
                                  [&](const LibraryPose& pose) { return pose.id == id; });
  if (found != poses.end()) return *found;
  throw Error(ErrorCode::kNotFound, id,
              "is not a pose of the library; " + DidYouMean(id, poses, &LibraryPose::id));
}

}  // namespace choreo::authoring
