#include "client/authoring/keys/photo_pose.h"

#include <Eigen/LU>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "client/authoring/fields/json_fields.h"
#include "model/core/error.h"
#include "model/core/files/small_extension.h"
#include "model/fit/mediapipe_source.h"
#include "model/fit/retarget.h"
#include "model/formats/containers/npz.h"
#include "model/motion/floor/floor_clearance.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/pose/pose_limits.h"
#include "model/motion/rotation.h"

namespace choreo::authoring {
namespace {

using nlohmann::json;

constexpr double kMaxDistance = 10;       // metres from the hips to a landmark
constexpr double kNearlyRotation = 0.05;  // of a matrix's rows

double Within(const json& value, const std::string& field, double from, double to) {
  const double number = JsonNumber(value, field);
  if (number >= from && number <= to) return number;
  std::ostringstream message;
  message << Shown(value) << " is not from " << from << " to " << to;
  throw InvalidArgument(field, message.str());
}

const json& LandmarkList(const json& file, const std::string& name) {
  if (file.is_array()) return file;
  for (const char* member :
       {"landmarks", "worldLandmarks", "poseWorldLandmarks", "pose_world_landmarks"}) {
    if (file.is_object() && file.contains(member)) return ListIn(file, name, member);
  }
  throw InvalidArgument(name + ":landmarks", "is missing, and the file is not a list");
}

/// The arrays of an SMPL file, by name.
class Numbers {
 public:
  Numbers(const std::filesystem::path& path) : name_(path.string()) {
    if (SmallExtension(path) == ".npz") {
      npz_ = NpzArchive::Read(path);
    } else {
      json_ = ParseJson(ReadText(path, "pose of SMPL"), name_);
    }
  }

  bool Has(const char* member) const {
    return npz_ ? npz_->Has(member) : json_.is_object() && json_.contains(member);
  }
  std::vector<double> Of(const char* member) const {
    if (npz_) return npz_->Array(member).As<double>();
    std::vector<double> out;
    Flatten(json_[member], name_ + ":" + member, &out);
    return out;
  }
  const std::string& name() const { return name_; }

 private:
  static void Flatten(const json& value, const std::string& field, std::vector<double>* out) {
    if (!value.is_array()) return out->push_back(JsonNumber(value, field));
    for (size_t i = 0; i < value.size(); ++i)
      Flatten(value[i], field + "[" + std::to_string(i) + "]", out);
  }

  std::string name_;
  std::optional<NpzArchive> npz_;
  json json_;
};

/// Reads axis-angle vectors or matrices of `least` to `most` joints.
std::vector<Eigen::Matrix3d> Rotations(const std::vector<double>& numbers, int least, int most,
                                       const std::string& field) {
  const auto count = static_cast<int>(numbers.size());
  const auto fits = [&](int width) {
    return count % width == 0 && count / width >= least && count / width <= most;
  };
  // 216 numbers are 24 matrices, not 72 vectors: no SMPL body has that many joints.
  const bool matrices = fits(9);
  if (!matrices && !fits(3)) {
    throw InvalidArgument(field, std::to_string(count) + " numbers, must be " +
                                     std::to_string(3 * most) + " (axis-angle) or " +
                                     std::to_string(9 * most) + " (matrices), of one person");
  }
  std::vector<Eigen::Matrix3d> out;
  for (int joint = 0; joint < count / (matrices ? 9 : 3); ++joint) {
    const std::string where = field + ", joint " + std::to_string(joint);
    if (matrices) {
      const Eigen::Matrix3d m =
          Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&numbers[9 * joint]);
      const double off = (m * m.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
      if (!(off < kNearlyRotation && m.determinant() > 0))
        throw InvalidArgument(where, "is not a rotation matrix");
      out.push_back(m);
    } else {
      const Eigen::Vector3d vector(&numbers[3 * joint]);
      if (!(vector.norm() <= kMaxRotation)) {
        std::ostringstream message;
        message << vector.norm() << " rad exceeds 2π; angles are in radians";
        throw InvalidArgument(where, message.str());
      }
      out.push_back(ExpMap(vector));
    }
  }
  return out;
}

std::vector<Eigen::Matrix3d> SmplRotations(const Numbers& file) {
  for (const char* member : {"pose", "poses", "smpl_poses", "thetas"}) {
    if (file.Has(member)) return Rotations(file.Of(member), 24, 24, file.name() + ":" + member);
  }
  if (!file.Has("global_orient") || !file.Has("body_pose")) {
    throw InvalidArgument(file.name() + ":pose",
                          "is missing, and so are poses, smpl_poses, thetas, and global_orient "
                          "with body_pose");
  }
  auto out = Rotations(file.Of("global_orient"), 1, 1, file.name() + ":global_orient");
  const auto body = Rotations(file.Of("body_pose"), 21, 23, file.name() + ":body_pose");
  out.insert(out.end(), body.begin(), body.end());
  out.resize(24, Eigen::Matrix3d::Identity());
  return out;
}

}  // namespace

Pose ParseLandmarkPose(std::string_view text, const std::string& name, const Skeleton& skeleton) {
  const json file = ParseJson(text, name);
  const json& list = LandmarkList(file, name);
  const size_t count = MediaPipeJointNames().size();
  if (list.size() != count) {
    throw InvalidArgument(name + ":landmarks", std::to_string(list.size()) +
                                                   " landmarks, must be " + std::to_string(count));
  }
  Eigen::Matrix3Xd places(3, static_cast<Eigen::Index>(count));
  std::vector<double> visibilities(count, 1.0);
  for (size_t i = 0; i < count; ++i) {
    const std::string field = name + ":landmarks[" + std::to_string(i) + "]";
    if (!list[i].is_object()) throw InvalidArgument(field, Shown(list[i]) + " is not a landmark");
    for (int axis = 0; axis < 3; ++axis) {
      const std::string member(1, "xyz"[axis]);
      if (!list[i].contains(member)) throw InvalidArgument(field + "." + member, "is missing");
      places(axis, static_cast<Eigen::Index>(i)) =
          Within(list[i][member], field + "." + member, -kMaxDistance, kMaxDistance);
    }
    if (list[i].contains("visibility"))
      visibilities[i] = Within(list[i]["visibility"], field + ".visibility", 0, 1);
  }
  if ((places.colwise() - places.col(0)).norm() < 0.1)
    throw InvalidArgument(name + ":landmarks", "are all in one place");
  return FitMediaPipe(places, visibilities, skeleton);
}

Pose ReadLandmarkPose(const std::filesystem::path& path, const Skeleton& skeleton) {
  return ParseLandmarkPose(ReadText(path, "landmark file"), path.string(), skeleton);
}

Pose ReadSmplPose(const std::filesystem::path& path, const Skeleton& skeleton) {
  const Skeleton& smpl = Skeleton::Smpl24();
  const std::vector<Eigen::Matrix3d> rotations = SmplRotations(Numbers(path));
  Pose pose = RestPose(smpl);
  for (int joint = 0; joint < smpl.joints(); ++joint)
    pose.rotations.col(joint) = LogMap(rotations[static_cast<size_t>(joint)]);
  // The camera's y axis points down and its z axis away from the camera.
  pose.rotations.col(0) = LogMap(Eigen::Vector3d(1, -1, -1).asDiagonal() * rotations.front());
  pose.root_position.y() -= HeightAboveFloor(smpl, pose);
  return Retarget(smpl, pose, skeleton);
}

}  // namespace choreo::authoring
