#include "model/fit/mediapipe_source.h"

#include <algorithm>

#include "model/fit/solver/fit_clip.h"
#include "model/fit/sources/mapping_builder.h"

namespace choreo {
namespace {

constexpr double kPhotoAccuracy = 0.03;  // metres: error of landmarks from photos
constexpr double kMinWeight = 0.001;

// How MediaPipe's landmarks locate our joints.
SourceMapping MediaPipeSource(std::span<const double> visibilities) {
  const auto seen = [&](const std::string& name) {
    const double visibility = visibilities[IndexOf(MediaPipeJointNames(), name)];
    return std::clamp(visibility * visibility, kMinWeight, 1.0);
  };
  using B = MappingBuilder;
  B builder("mediapipe", kPhotoAccuracy);
  builder.Add("hips", "", {{"left_hip", 0.5}, {"right_hip", 0.5}},
              B::Between("left_hip", "right_hip"));
  builder.Add("chest", "hips", {{"left_shoulder", 0.5}, {"right_shoulder", 0.5}},
              B::Between("left_shoulder", "right_shoulder"), 1, false);
  builder.Add("head", "chest", {{"left_ear", 0.5}, {"right_ear", 0.5}}, {B::At("head", 0, 0.06, 0)},
              0.5 * std::min(seen("left_ear"), seen("right_ear")), false);
  builder.Add("nose", "head", {{"nose", 1.0}}, {B::At("head", 0, 0.04, 0.12)}, 0.5 * seen("nose"));
  for (const std::string side : {"left_", "right_"}) {
    // A bone is as visible as its less visible end.
    double above = 1;
    const auto add = [&](const std::string& joint, const std::string& parent) {
      const double trust = seen(side + joint);
      builder.AddJoint(side + joint, parent, side + joint, std::min(trust, above));
      above = trust;
    };
    add("hip", "hips");
    add("knee", side + "hip");
    add("ankle", side + "knee");
    // The ball of the foot lies on the way to the tip of the toes.
    builder.AddJoint(side + "foot", side + "ankle", side + "foot_index",
                     0.5 * std::min(above, seen(side + "foot_index")));
    above = 1;
    add("shoulder", "chest");
    add("elbow", side + "shoulder");
    add("wrist", side + "elbow");
    builder.Add(side + "hand", side + "wrist", {{side + "index", 0.5}, {side + "pinky", 0.5}},
                {{.joint = side + "hand"}}, 0.5 * std::min(above, seen(side + "index")));
    builder.AddFoot(side + "foot_index");
  }
  return builder.Take();
}

}  // namespace

const std::vector<std::string>& MediaPipeJointNames() {
  static const std::vector<std::string> kNames = {
      "nose",        "left_eye_inner",  "left_eye",        "left_eye_outer", "right_eye_inner",
      "right_eye",   "right_eye_outer", "left_ear",        "right_ear",      "mouth_left",
      "mouth_right", "left_shoulder",   "right_shoulder",  "left_elbow",     "right_elbow",
      "left_wrist",  "right_wrist",     "left_pinky",      "right_pinky",    "left_index",
      "right_index", "left_thumb",      "right_thumb",     "left_hip",       "right_hip",
      "left_knee",   "right_knee",      "left_ankle",      "right_ankle",    "left_heel",
      "right_heel",  "left_foot_index", "right_foot_index"};
  return kNames;
}

Pose FitMediaPipe(const Eigen::Matrix3Xd& landmarks, std::span<const double> visibilities,
                  const Skeleton& skeleton) {
  PositionClip clip{.joint_names = MediaPipeJointNames(), .frames = {}};
  clip.frames.push_back(Eigen::Vector3d(1, -1, -1).asDiagonal() * landmarks);
  Pose pose = FitClip(clip, MediaPipeSource(visibilities), skeleton).motion.frames.front();
  pose.root_position.x() = pose.root_position.z() = 0;
  return pose;
}

}  // namespace choreo
