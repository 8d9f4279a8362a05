#include "client/authoring/keys/photo_pose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "client/authoring/keys/pose_library.h"
#include "client/authoring/keys/pose_source.h"
#include "model/fit/mediapipe_source.h"
#include "model/formats/containers/npz.h"
#include "model/motion/floor/floor_clearance.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/client/run_choreo.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace choreo::authoring::photo_pose_test {

using nlohmann::json;

const Skeleton& Body() { return Skeleton::Smpl24(); }

/// What a camera in front sees of a pose: a larger body than ours, with toes and a face.
Eigen::Matrix3Xd Landmarks(const Pose& pose, double noise_m, uint32_t seed) {
  const JointPlacement at = ForwardKinematics(Body(), pose);
  const auto point = [&](const std::string& joint, double x, double y, double z) {
    const int index = Body().Find(joint);
    return Eigen::Vector3d(at.positions.col(index) +
                           at.rotations[static_cast<size_t>(index)] * Eigen::Vector3d(x, y, z));
  };
  const std::vector<std::string>& names = MediaPipeJointNames();
  Eigen::Matrix3Xd out(3, std::ssize(names));
  for (Eigen::Index i = 0; i < out.cols(); ++i) {
    const std::string& name = names[static_cast<size_t>(i)];
    const bool left = name.find("left") != std::string::npos;
    const double side = left ? 1 : -1;
    const std::string prefix = left ? "left_" : "right_";
    if (name.ends_with("foot_index")) {
      out.col(i) = point(prefix + "foot", 0, -0.01, 0.08);
    } else if (name.ends_with("heel")) {
      out.col(i) = point(prefix + "ankle", 0, -0.06, -0.05);
    } else if (name.ends_with("index") || name.ends_with("pinky") || name.ends_with("thumb")) {
      out.col(i) = point(prefix + "hand", 0, 0, name.ends_with("pinky") ? -0.04 : 0.04);
    } else if (name.ends_with("ear")) {
      out.col(i) = point("head", side * 0.075, 0.06, 0);
    } else if (Body().Find(name) >= 0) {
      out.col(i) = point(name, 0, 0, 0);
    } else {
      out.col(i) = point("head", side * 0.02, 0.05, 0.11);  // eyes, mouth, nose
    }
  }
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, noise_m);
  const Eigen::Vector3d hips = (out.col(23) + out.col(24)) / 2;
  out = 1.12 * (out.colwise() - hips);
  for (double& value : out.reshaped()) value += noise_m > 0 ? noise(random) : 0;
  return Eigen::Vector3d(1, -1, -1).asDiagonal() * out;
}

/// Degrees between the limbs of two poses: thighs, shins, upper arms, forearms.
std::vector<double> LimbErrors(const Pose& a, const Pose& b) {
  static constexpr const char* kLimbs[][2] = {
      {"hip", "knee"}, {"knee", "ankle"}, {"shoulder", "elbow"}, {"elbow", "wrist"}};
  const Eigen::Matrix3Xd there = JointPositions(Body(), a), here = JointPositions(Body(), b);
  std::vector<double> out;
  for (const std::string side : {"left_", "right_"}) {
    for (const auto& [from, to] : kLimbs) {
      const int i = Body().Find(side + from), j = Body().Find(side + to);
      const Eigen::Vector3d x = there.col(j) - there.col(i), y = here.col(j) - here.col(i);
      out.push_back(std::atan2(x.cross(y).norm(), x.dot(y)) * 180 / M_PI);
    }
  }
  return out;
}

double Quantile(std::vector<double> values, double q) {
  std::ranges::sort(values);
  return values[static_cast<size_t>(q * static_cast<double>(values.size() - 1))];
}

class PhotoPoseTest : public testing::Test {
 protected:
  std::string At(const std::string& name) const { return (folder_ / name).string(); }
  std::string Write(const std::string& name, const json& content) const {
    std::ofstream(folder_ / name) << content.dump();
    return At(name);
  }
  json AsJson(const Eigen::Matrix3Xd& landmarks) const {
    json list = json::array();
    for (const auto& place : landmarks.colwise())
      list.push_back({{"x", place.x()}, {"y", place.y()}, {"z", place.z()}, {"visibility", 0.9}});
    return list;
  }
  TemporaryFolder folder_;
};

TEST_F(PhotoPoseTest, PosesOfTheLibraryComeBackFromTheirLandmarks) {
  for (const double noise_m : {0.0, 0.02}) {
    std::vector<double> errors;
    uint32_t seed = 0;
    for (const LibraryPose& pose : PoseLibrary()) {
      const Eigen::Matrix3Xd seen = Landmarks(pose.pose, noise_m, ++seed);
      const Pose made = ReadLandmarkPose(Write("l.json", AsJson(seen)), Body());
      EXPECT_NEAR(HeightAboveFloor(Body(), made), 0, 1e-6) << pose.id;
      for (const double error : LimbErrors(pose.pose, made)) errors.push_back(error);
    }
    const double median = Quantile(errors, 0.5), p95 = Quantile(errors, 0.95);
    std::printf("%.0f mm of noise: limbs are %.1f degrees off (median), %.1f (95 %%)\n",
                1000 * noise_m, median, p95);
    EXPECT_LT(median, noise_m > 0 ? 8 : 4);
    EXPECT_LT(p95, noise_m > 0 ? 20 : 12);
  }
}

TEST_F(PhotoPoseTest, LowVisibilityHasLittleWeight) {
  const Pose& pose = FindLibraryPose("kick").pose;
  const Eigen::Matrix3Xd seen = Landmarks(pose, 0, 1);
  const auto with_wrist = [&](double y, double visibility) {
    json list = AsJson(seen);
    list[15] = {{"x", 0.5}, {"y", y}, {"z", 0.5}, {"visibility", visibility}};
    return ReadLandmarkPose(Write("l.json", list), Body());
  };
  // Limb 3 is the left forearm.
  EXPECT_GT(LimbErrors(with_wrist(2, 1), with_wrist(-2, 1))[3], 60);
  const Pose up = with_wrist(-2, 0), down = with_wrist(2, 0);
  EXPECT_LT(LimbErrors(up, down)[3], 20);
  for (const Pose& hidden : {up, down}) {
    std::vector<double> errors = LimbErrors(pose, hidden);
    errors.erase(errors.begin() + 2, errors.begin() + 4);
    EXPECT_LT(*std::ranges::max_element(errors), 5);
  }
}

TEST_F(PhotoPoseTest, CommandWritesAKey) {
  const Pose& pose = FindLibraryPose("kick").pose;
  Write("seen.json", {{"poseWorldLandmarks", AsJson(Landmarks(pose, 0, 1))}});
  const Outcome outcome = Choreo("pose --from-landmarks '" + At("seen.json") +
                                 "' --set head=0,20,0 --at 2 --out '" + At("key.json") + "'");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_LT(Quantile(LimbErrors(pose, ReadPose(At("key.json"), Body()).key.pose), 0.5), 4);
}

TEST_F(PhotoPoseTest, PosesOfEstimatorsAreReadInEveryShape) {
  const Pose& pose = FindLibraryPose("kick").pose;
  const Eigen::Matrix3d camera = Eigen::Vector3d(1, -1, -1).asDiagonal();
  json vectors = json::array(), matrices = json::array();
  for (int joint = 0; joint < 24; ++joint) {
    Eigen::Matrix3d turn = ExpMap(pose.rotations.col(joint));
    if (joint == 0) turn = camera * turn;
    const Eigen::Vector3d vector = LogMap(turn);
    vectors.push_back({vector.x(), vector.y(), vector.z()});
    json matrix = json::array();
    for (int row = 0; row < 3; ++row) matrix.push_back({turn(row, 0), turn(row, 1), turn(row, 2)});
    matrices.push_back(matrix);
  }
  const json root = json::array({matrices[0]});
  json body = matrices;
  body.erase(0);
  std::vector<double> flat;
  for (const json& vector : vectors) {
    for (const json& value : vector) flat.push_back(value.get<double>());
  }
  NpzArchive npz;
  npz.SetArray("smpl_poses", {{1, 72}, flat});
  npz.Write(At("d.npz"));
  for (const std::string& path :
       {Write("a.json", {{"pose", vectors}}), Write("b.json", {{"pose", matrices}}),
        Write("c.json", {{"global_orient", root}, {"body_pose", body}}), At("d.npz")}) {
    SCOPED_TRACE(path);
    const Pose made = ReadSmplPose(path, Body());
    EXPECT_NEAR(HeightAboveFloor(Body(), made), 0, 1e-6);
    Pose there = pose;
    there.root_position = made.root_position;
    EXPECT_LT(ComparePoses(Body(), there, made).angle_deg, 1e-3);
  }
}

TEST_F(PhotoPoseTest, NamesInvalidLandmarks) {
  const json good = AsJson(Landmarks(FindLibraryPose("kick").pose, 0, 1));
  const auto refused = [&](const json& list, const std::string& message) {
    const std::string path = Write("l.json", list);
    ExpectError(ErrorCode::kInvalidArgument, message, [&] { ReadLandmarkPose(path, Body()); });
  };
  json bad = good;
  bad.erase(32);
  refused(bad, "l.json:landmarks: 32 landmarks, must be 33");
  bad = good;
  bad[3].erase("z");
  refused(bad, "landmarks[3].z: is missing");
  bad[3]["z"] = 300;
  refused(bad, "landmarks[3].z: 300 is not from -10 to 10");
  bad = good;
  bad[4]["visibility"] = "high";
  refused(bad, "landmarks[4].visibility: \"high\" is not a number");
  refused(json::array({}), "landmarks");
  refused({{"people", 1}}, "l.json:landmarks: is missing");
  refused(json(33, {{"x", 0}, {"y", 0}, {"z", 0}}), "are all in one place");

  const auto no_pose = [&](const json& file, const std::string& message) {
    const std::string path = Write("s.json", file);
    ExpectError(ErrorCode::kInvalidArgument, message, [&] { ReadSmplPose(path, Body()); });
  };
  no_pose({{"pose", std::vector<double>(71, 0)}}, "s.json:pose: 71 numbers, must be 72");
  no_pose({{"pose", std::vector<double>(144, 0)}}, "144 numbers, must be 72");
  no_pose({{"pose", std::vector<double>(72, 9)}}, "joint 0: 15.5885 rad exceeds");
  no_pose({{"pose", std::vector<double>(216, 1)}}, "joint 0: is not a rotation matrix");
  no_pose({{"pose", {"a"}}}, "s.json:pose[0]: \"a\" is not a number");
  no_pose({{"betas", 0}}, "s.json:pose: is missing");
  ExpectError(ErrorCode::kInvalidArgument, "/dev/zero: is larger than 64 MiB",
              [] { ReadLandmarkPose("/dev/zero", Body()); });
  ExpectError(ErrorCode::kNotFound, "none.json", [&] { ReadSmplPose(At("none.json"), Body()); });
  std::ofstream(folder_ / "p.pkl") << "\x80\x04K\x01.";
  ExpectError(ErrorCode::kInvalidArgument, "p.pkl", [&] { ReadSmplPose(At("p.pkl"), Body()); });
}

TEST_F(PhotoPoseTest, APhotoItselfIsForTheStudio) {
  const Outcome outcome = Choreo("pose --from-photo me.jpg");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said,
              testing::HasSubstr("--from-photo: photos are read in the browser: open `choreo "
                                 "studio` and drop me.jpg on its page"));
}

}  // namespace choreo::authoring::photo_pose_test
