#include "model/formats/motion_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "model/core/files/atomic_file.h"
#include "model/formats/bvh/bvh.h"
#include "model/formats/containers/npz.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/motion/motion_fixtures.h"
#include "tests/support/expect_error.h"
#include "tests/support/full_disk.h"
#include "tests/support/mixamo_names.h"
#include "tests/support/native_tang2018.h"
#include "tests/support/temporary_folder.h"

namespace choreo::motion_file_test {

const Skeleton& kSmpl = Skeleton::Smpl24();

TEST(MotionFile, EveryFormatGivesTheMotionBack) {
  const TemporaryFolder folder;
  const Motion motion = fixtures::SmoothMotion(kSmpl, 21, 30, 30);
  for (const auto& [name, tolerance_deg] : {std::pair("a.npz", 1e-9), std::pair("a.bvh", 1e-5),
                                            std::pair("a.glb", 1e-4), std::pair("a.vrma", 1e-4)}) {
    SCOPED_TRACE(name);
    WriteMotion(folder / name, kSmpl, motion);
    const Motion back = ReadMotion(folder / name, kSmpl);
    EXPECT_EQ(back.fps, 30);
    ASSERT_EQ(back.frames.size(), motion.frames.size());
    for (size_t i = 0; i < motion.frames.size(); ++i) {
      const PoseError error = ComparePoses(kSmpl, motion.frames[i], back.frames[i]);
      EXPECT_LT(error.position_m, 1e-6);
      EXPECT_LT(error.angle_deg, tolerance_deg);
    }
  }
}

TEST(MotionFile, FailedWriteKeepsTheOldFile) {
  const TemporaryFolder folder;
  const Motion motion = fixtures::SmoothMotion(kSmpl, 21, 30, 30);
  for (const char* name : {"a.npz", "a.bvh", "a.glb"}) {
    SCOPED_TRACE(name);
    WriteFile(folder / name, "good");
    {
      const FullDisk full(5000);
      ExpectError(ErrorCode::kInternal, "cannot be written",
                  [&] { WriteMotion(folder / name, kSmpl, motion); });
    }
    EXPECT_EQ(std::filesystem::file_size(folder / name), 4U);
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 3);
}

TEST(MotionFile, RefusesAbsurdValuesAndNamesThem) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& name, const std::string& part) {
    ExpectError(ErrorCode::kInvalidArgument, name + part, [&] { ReadMotion(folder / name); });
  };
  const auto amass = [&](const std::string& name, double trans, double root) {
    std::vector<double> poses(2 * 72, 0.0);
    poses[72] = root;
    NpzArchive npz;
    npz.SetArray("trans", {{2, 3}, std::vector<double>{0, 0, 0, 0, trans, 0}});
    npz.SetArray("poses", {{2, 72}, std::move(poses)});
    npz.SetArray("mocap_framerate", {{}, std::vector<double>{30}});
    npz.Write(folder / name);
  };
  amass("far.npz", 1e300, 0);
  refused("far.npz", ": frames[1].root_position[1]: 1e+300 m is further than 10000 m");
  // The world's turn would hide it.
  amass("turned.npz", 0, 1e30);
  refused("turned.npz", ": frames[1].rotations[0]: 1e+30 rad exceeds 1000");
  amass("wound.npz", 0, 100);
  EXPECT_EQ(ReadMotion(folder / "wound.npz").motion.frames.size(), 2U);

  Motion motion = fixtures::SmoothMotion(kSmpl, 21, 3, 30);
  motion.frames[2].root_position.x() = 2e4;
  for (const char* name : {"a.npz", "a.bvh", "a.glb"}) WriteMotion(folder / name, kSmpl, motion);
  refused("a.npz", ": frames[2].root_position[0]: 20000 m is further than 10000 m");
  refused("a.bvh", ": frames[2].root_position[0]: 20000 m is further than 10000 m");
  refused("a.glb", ": nodes[0]: stands at 20000 m, further than 10000 m from the origin");

  const auto bvh = [&](const std::string& name, const std::string& values) {
    WriteFile(folder / name,
              "HIERARCHY\nROOT box\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition "
              "Zrotation Xrotation Yrotation\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n" +
                  values);
  };
  bvh("angle.bvh", "0 0 0 0 1e30 0");
  refused("angle.bvh", ":10: found '1e30', expected a number of degrees from -57295.8 to 57295.8");
  bvh("length.bvh", "0 0 -2e7 0 0 0");
  refused("length.bvh", ":10: found '-2e7', expected a number from -1e+07 to 1e+07");
}

// tinygltf calls itself once a level.
TEST(MotionFile, RefusesGltfThatIsNestedTooDeeply) {
  const TemporaryFolder folder;
  std::string json = R"({"asset": {"version": "2.0"}, "extras": )" + std::string(1'000'000, '[') +
                     std::string(1'000'000, ']') + "}";
  json.append((4 - json.size() % 4) % 4, ' ');
  std::string bytes("glTF\2\0\0\0", 8);
  for (const size_t number : {json.size() + 20, json.size()}) {
    for (int byte = 0; byte < 4; ++byte) bytes += static_cast<char>(number >> 8 * byte);
  }
  WriteFile(folder / "a.glb", bytes + "JSON" + json);
  ExpectError(ErrorCode::kInvalidArgument, "a.glb: is JSON of more than 64 levels",
              [&] { ReadMotion(folder / "a.glb"); });
}

// Our motion as a capture studio would hand it over: other names, inches, no hands, no collars'
// rotations lost, and 12 cm above the floor.
BvhFile StudioBvh(const Motion& motion) {
  BvhFile file = MotionToBvh(kSmpl, motion);
  for (BvhJoint& joint : file.joints) {
    joint.offset /= 2.54;
    if (!joint.end_site) joint.name = kMixamoNames.at(joint.name);
  }
  file.values.topRows(3) /= 2.54;
  file.values.row(1).array() += 12 / 2.54;
  return file;
}

TEST(MotionFile, FitsAForeignHierarchy) {
  const TemporaryFolder folder;
  const Motion motion = fixtures::SmoothMotion(kSmpl, 22, 60, 30);
  WriteBvh(folder / "studio.bvh", StudioBvh(motion));
  const Motion fitted = ReadMotion(folder / "studio.bvh", kSmpl);
  EXPECT_EQ(fitted.fps, 30);
  ASSERT_EQ(fitted.frames.size(), motion.frames.size());
  // The same dance: travel and joints around the root. Height is the fit's own business (it stands
  // the clip on the floor).
  double sum = 0, travel = 0;
  for (size_t i = 0; i < motion.frames.size(); ++i) {
    const Eigen::Matrix3Xd a = JointPositions(kSmpl, motion.frames[i]);
    const Eigen::Matrix3Xd b = JointPositions(kSmpl, fitted.frames[i]);
    sum +=
        ((a.colwise() - a.col(0).eval()) - (b.colwise() - b.col(0).eval())).colwise().norm().mean();
    const Eigen::Vector3d apart = a.col(0) - b.col(0);
    travel = std::max(travel, std::hypot(apart.x(), apart.z()));
  }
  EXPECT_LT(sum / static_cast<double>(motion.frames.size()), 0.03);
  EXPECT_LT(travel, 0.05);
}

// A dance on a skeleton of its own, 23 joints.
TEST(MotionFile, AnotherSkeletonGoesThereAndBackInEveryFormat) {
  const TemporaryFolder folder;
  const Skeleton& native = testing_support::Native().skeleton;
  const Motion motion = fixtures::SmoothMotion(native, 21, 30, 30);
  for (const auto& [name, tolerance_deg] :
       {std::pair("a.npz", 1e-9), std::pair("a.bvh", 1e-5), std::pair("a.glb", 1e-3)}) {
    SCOPED_TRACE(name);
    WriteMotion(folder / name, native, motion);
    const auto [skeleton, own] = ReadMotion(folder / name);
    EXPECT_EQ(skeleton.joints(), 23);
    EXPECT_EQ(skeleton.parents.size(), own.frames.front().rotations.cols());
    const Motion back = ReadMotion(folder / name, native);
    ASSERT_EQ(back.frames.size(), motion.frames.size());
    for (size_t i = 0; i < motion.frames.size(); ++i) {
      const PoseError error = ComparePoses(native, motion.frames[i], back.frames[i]);
      EXPECT_LT(error.position_m, 1e-5);
      EXPECT_LT(error.angle_deg, tolerance_deg);
      // Joints are matched by name, in any order.
      const Eigen::Matrix3Xd there = JointPositions(native, motion.frames[i]);
      const Eigen::Matrix3Xd here = JointPositions(skeleton, own.frames[i]);
      for (int joint = 0; joint < 23; ++joint) {
        const int found = skeleton.Find(native.joint_names[static_cast<size_t>(joint)]);
        ASSERT_GE(found, 0);
        EXPECT_LT((there.col(joint) - here.col(found)).norm(), 1e-5);
      }
    }
  }
}

TEST(MotionFile, AnotherSkeletonIsReadInMetresToo) {
  const TemporaryFolder folder;
  const Skeleton& native = testing_support::Native().skeleton;
  const Motion motion = fixtures::SmoothMotion(native, 21, 10, 30);
  WriteBvh(folder / "a.bvh", MotionToBvh(native, motion, {.units_per_metre = kMetres}));
  const Skeleton own = ReadMotion(folder / "a.bvh").skeleton;
  EXPECT_NEAR(own.pelvis_height, native.pelvis_height, 1e-4);
  const Motion back = ReadMotion(folder / "a.bvh", native);
  for (size_t i = 0; i < motion.frames.size(); ++i)
    EXPECT_LT(ComparePoses(native, motion.frames[i], back.frames[i]).position_m, 1e-5);
}

TEST(MotionFile, AMotionOfSmplIsRetargetedToAnotherSkeletonAndBack) {
  const TemporaryFolder folder;
  const Skeleton& native = testing_support::Native().skeleton;
  Motion motion{.fps = 30, .frames = std::vector<Pose>(3, RestPose(kSmpl))};
  for (Pose& pose : motion.frames) pose.rotations(2, kSmpl.left_shoulder) = 1.0;
  for (const char* name : {"a.npz", "a.bvh", "a.glb"}) {
    WriteMotion(folder / name, kSmpl, motion);
    const Motion there = ReadMotion(folder / name, native);
    ASSERT_EQ(there.frames.size(), 3U);
    EXPECT_NEAR(there.frames[0].rotations(2, native.left_shoulder), 1.0, 0.15);
    WriteMotion(folder / name, native, there);
    EXPECT_NEAR(ReadMotion(folder / name, kSmpl).frames[0].rotations(2, kSmpl.left_shoulder), 1.0,
                0.15);
  }
}

TEST(MotionFile, RefusesOtherBonesWhereNoneMayChange) {
  const TemporaryFolder folder;
  const Skeleton& native = testing_support::Native().skeleton;
  WriteMotion(folder / "a.npz", native, fixtures::SmoothMotion(native, 2, 4));
  ExpectError(ErrorCode::kInvalidArgument,
              "a.npz: its skeleton is 'tang2018' of 23 joints, not 'smpl24' of 24 joints",
              [&] { ReadMotion(folder / "a.npz", kSmpl, OtherSkeleton::kRefuse); });
}

TEST(MotionFile, ATornNpzOfAnotherSkeletonIsRefusedByName) {
  const TemporaryFolder folder;
  const Skeleton& native = testing_support::Native().skeleton;
  WriteMotion(folder / "a.npz", native, fixtures::SmoothMotion(native, 2, 4));
  NpzArchive npz = NpzArchive::Read(folder / "a.npz");
  npz.SetArray("rotations", {{4, 24, 3}, std::vector<double>(4 * 24 * 3)});
  npz.Write(folder / "a.npz");
  ExpectError(ErrorCode::kInvalidArgument,
              "a.npz: rotations: has the shape [4, 24, 3], expected [frames, 69]",
              [&] { ReadMotion(folder / "a.npz"); });
}

TEST(MotionFile, KeepsContactsInAnNpz) {
  const TemporaryFolder folder;
  const Motion motion = fixtures::SmoothMotion(kSmpl, 23, 3);
  const std::vector<Contacts> contacts(3, Contacts{1, 1, 0, 0});
  WriteMotion(folder / "a.npz", kSmpl, motion, &contacts);
  EXPECT_EQ(NpzArchive::Read(folder / "a.npz").Array("contacts").shape,
            (std::vector<int64_t>{3, 4}));
}

TEST(MotionFile, RefusesWithThePathInFront) {
  const TemporaryFolder folder;
  const Motion motion = fixtures::SmoothMotion(kSmpl, 24, 2);
  ExpectError(
      ErrorCode::kInvalidArgument,
      "a.fbx: has the extension '.fbx', must be .npz, .bvh, .glb, .gltf, .vrma, .pkl or .npy; "
      "Blender imports it",
      [&] { ReadMotion(folder / "a.fbx", kSmpl); });
  ExpectError(ErrorCode::kInvalidArgument, "must be .npz, .bvh, .glb or .vrma",
              [&] { WriteMotion(folder / "a", kSmpl, motion); });
  for (const char* name : {"a.npz", "a.bvh", "a.glb"}) {
    ExpectError(ErrorCode::kNotFound, (folder / name).string(),
                [&] { ReadMotion(folder / name, kSmpl); });
  }
  NpzArchive npz;
  npz.SetArray("weights", {{1}, std::vector<double>{1}});
  npz.Write(folder / "other.npz");
  ExpectError(ErrorCode::kInvalidArgument, (folder / "other.npz").string(),
              [&] { ReadMotion(folder / "other.npz", kSmpl); });
  std::ofstream(folder / "box.bvh") << "HIERARCHY\nROOT box\n{\nOFFSET 0 0 0\n"
                                       "CHANNELS 3 Xposition Yposition Zposition\n}\n"
                                       "MOTION\nFrames: 1\nFrame Time: 0.1\n0 0 0\n";
  ExpectError(ErrorCode::kInvalidArgument, (folder / "box.bvh").string(),
              [&] { ReadMotion(folder / "box.bvh", kSmpl); });
}

}  // namespace choreo::motion_file_test
