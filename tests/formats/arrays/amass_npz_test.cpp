#include "model/formats/arrays/amass_npz.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/formats/numpy.h"
#include "tests/motion/motion_fixtures.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace choreo::amass_npz_test {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
const Skeleton& kSmpl = Skeleton::Smpl24();

NpyArray Array(std::vector<int64_t> shape, std::vector<double> values) {
  return {std::move(shape), std::move(values)};
}

// SMPL's own posing, as its authors define it: every joint rotates about its place in the rest
// body, whose pelvis is J0; the translation moves the result. Z up where the data are.
Eigen::Matrix3Xd SmplJoints(const Vector3d& trans, const Eigen::Matrix3Xd& axis_angles) {
  Eigen::Matrix3Xd rest(3, 24), posed(3, 24);
  std::vector<Matrix3d> global(24);
  for (int joint = 0; joint < 24; ++joint) {
    const int parent = kSmpl.parents[joint];
    const Matrix3d local = ExpMap(axis_angles.col(joint));
    if (parent < 0) {
      rest.col(joint) << -0.00179506, -0.22333382, 0.02821918;
      posed.col(joint) = rest.col(joint);
      global[joint] = local;
    } else {
      rest.col(joint) = rest.col(parent) + kSmpl.offsets.col(joint);
      posed.col(joint) = posed.col(parent) + global[parent] * (rest.col(joint) - rest.col(parent));
      global[joint] = global[parent] * local;
    }
  }
  return posed.colwise() + trans;
}

TEST(AmassPose, IsTheSamePoseSeenByForwardKinematics) {
  Matrix3d y_up;  // minus a quarter turn about X
  y_up << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  std::mt19937 generator(1);
  for (int i = 0; i < 50; ++i) {
    const Pose pose = fixtures::RandomPose(kSmpl, generator, 2.0);
    const Pose theirs = ToAmass(pose);
    EXPECT_LT(
        (y_up * SmplJoints(theirs.root_position, theirs.rotations) - JointPositions(kSmpl, pose))
            .cwiseAbs()
            .maxCoeff(),
        1e-12);
  }
}

TEST(AmassPose, StandingUprightIsAQuarterTurn) {
  Pose pose;
  pose.root_position = {1, 0.93, -2};
  pose.rotations.setZero(3, 24);
  const Pose amass = ToAmass(pose);
  EXPECT_LT((amass.root_position - (Vector3d(1, 2, 0.93) - SmplRestPelvis())).norm(), 1e-12);
  EXPECT_LT((amass.rotations.col(0) - Vector3d(kPi / 2, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(amass.rotations.rightCols(23).norm(), 0);
}

// An edit of a dance leaves the numbers of all other frames as they are, and a dancer who turns on
// the spot causes no jump of numbers.
TEST(AmassNpz, FramesAreWrittenByThemselvesAndWithoutJumps) {
  constexpr int kFrames = 120;
  Motion spin{.fps = 30, .frames = {}};
  Pose pose;
  pose.rotations.setZero(3, 24);
  for (int i = 0; i < kFrames; ++i) {
    pose.rotations.col(0) = Vector3d(0.1, 6 * kPi * i / kFrames, 0.1);
    spin.frames.push_back(pose);
  }
  const auto poses = [](const Motion& motion) {
    NpzArchive npz;
    AddSmplMotion(motion, nullptr, npz);
    const NpyArray array = npz.Array("poses");
    return std::pair(array.As<double>(), static_cast<size_t>(array.shape[1]));
  };
  const auto [whole, width] = poses(spin);
  for (size_t i = 1; i < kFrames; ++i)
    for (size_t j = 0; j < 3; ++j)
      EXPECT_LT(std::abs(whole[i * width + j] - whole[(i - 1) * width + j]), 0.4) << i;
  const auto [last, same_width] = poses({.fps = 30, .frames = {spin.frames.back()}});
  for (size_t j = 0; j < same_width; ++j) EXPECT_EQ(last[j], whole[(kFrames - 1) * width + j]);
}

// Largest distance of a joint or difference of a local rotation (radians) between two motions.
double Difference(const Motion& a, const Motion& b) {
  EXPECT_EQ(a.frames.size(), b.frames.size());
  double worst = 0;
  for (size_t i = 0; i < std::min(a.frames.size(), b.frames.size()); ++i) {
    const PoseError error = ComparePoses(kSmpl, a.frames[i], b.frames[i]);
    worst = std::max({worst, error.position_m, error.angle_deg * kPi / 180});
  }
  return worst;
}

TEST(AmassNpz, BothLayoutsOfOneFileAreTheSameMotion) {
  const Motion motion = fixtures::SmoothMotion(kSmpl, 3, 40, 60);
  NpzArchive npz;
  AddSmplMotion(motion, nullptr, npz);
  const Motion ours = ReadSmplMotion(npz);
  EXPECT_EQ(ours.fps, 60);
  EXPECT_LT(Difference(ours, motion), 1e-12);

  NpzArchive amass;
  for (const char* key : {"poses", "trans", "mocap_framerate"}) amass.SetArray(key, npz.Array(key));
  EXPECT_EQ(amass.Array("poses").shape, (std::vector<int64_t>{40, 156}));
  Motion expected = motion;
  // SMPL-H has fingers where SMPL has its two hand joints.
  for (Pose& pose : expected.frames) pose.rotations.rightCols(2).setZero();
  const Motion theirs = ReadSmplMotion(amass);
  EXPECT_EQ(theirs.fps, 60);
  EXPECT_LT(Difference(theirs, expected), 1e-9);
  for (size_t i = 1; i < theirs.frames.size(); ++i) {
    EXPECT_LT((theirs.frames[i].rotations - theirs.frames[i - 1].rotations).norm(), 1.0);
  }
}

TEST(AmassNpz, ReadsWhatNumpyWrote) {
  const NpzArchive npz =
      NpzArchive::Read(std::filesystem::path(CHOREO_TEST_DATA) / "amass_by_numpy.npz");
  const Motion motion = ReadSmplMotion(npz);
  EXPECT_EQ(motion.fps, 120);
  ASSERT_EQ(motion.frames.size(), 3u);
  for (int frame = 0; frame < 3; ++frame) {
    const Pose& pose = motion.frames[frame];
    const Vector3d pelvis = Vector3d(0.1 * frame, -0.2 * frame, 0.9 + 0.01 * frame) +
                            Vector3d(-0.00179506, -0.22333382, 0.02821918);
    EXPECT_LT((pose.root_position - Vector3d(pelvis.x(), pelvis.z(), -pelvis.y())).norm(), 1e-12);
    for (int joint = 1; joint < 22; ++joint) {
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(pose.rotations(axis, joint),
                    0.01 * (frame + 1) * std::sin(3 * joint + axis + 1), 1e-15);
      }
    }
    EXPECT_EQ(pose.rotations.rightCols(2).norm(), 0);
  }
}

TEST(AmassNpz, ReadsOtherLayouts) {
  std::vector<double> upright(72, 0.0);
  upright[0] = kPi / 2;
  std::vector<double> wide = upright;
  wide.resize(165);
  struct Case {
    const char* name;
    NpzArchive npz;
    double fps;
    Vector3d root;
    bool turned;
  };
  std::vector<Case> cases;
  {
    NpzArchive npz;  // EDGE: Z up, the translation is the pelvis
    npz.SetArray("smpl_poses", Array({1, 72}, upright));
    npz.SetArray("smpl_trans", Array({1, 3}, {1, 2, 0.93}));
    cases.push_back({"EDGE", npz, 30, {1, 0.93, -2}, false});
  }
  {
    NpzArchive npz;  // AIST++: Y up, centimetres by smpl_scaling
    npz.SetArray("smpl_poses", Array({1, 24, 3}, upright));
    npz.SetArray("smpl_trans", Array({1, 3}, {100, 200, 300}));
    npz.SetArray("smpl_scaling", Array({1}, {100}));
    cases.push_back({"AIST++", npz, 60, Vector3d(1, 2, 3) + SmplRestPelvis(), true});
  }
  {
    NpzArchive npz;  // SMPL-X: another rest pelvis
    npz.SetArray("poses", Array({1, 165}, wide));
    npz.SetArray("trans", Array({1, 3}, {1, 2, 1.3}));
    npz.SetArray("mocap_frame_rate", Array({}, {100}));
    cases.push_back(
        {"SMPL-X", npz, 100, {1 + 0.00312326, 1.3 + 0.01203655, -2 + 0.35140747}, false});
  }
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name);
    const Motion motion = ReadSmplMotion(one.npz);
    ASSERT_EQ(motion.frames.size(), 1u);
    EXPECT_EQ(motion.fps, one.fps);
    EXPECT_LT((motion.frames[0].root_position - one.root).norm(), 1e-9);
    EXPECT_NEAR(motion.frames[0].rotations.col(0).norm(), one.turned ? kPi / 2 : 0, 1e-12);
  }
}

TEST(AmassNpz, KeepsContacts) {
  const Motion motion = fixtures::SmoothMotion(kSmpl, 5, 2);
  const std::vector<Contacts> contacts = {{1, 0, 1, 0}, {0, 1, 0.5f, 1}};
  NpzArchive npz;
  AddSmplMotion(motion, &contacts, npz);
  EXPECT_EQ(npz.Array("contacts").shape, (std::vector<int64_t>{2, 4}));
  EXPECT_EQ(npz.Array("contacts").As<float>(), (std::vector<float>{1, 0, 1, 0, 0, 1, 0.5f, 1}));
}

TEST(AmassNpz, NumpyFindsThePelvisAtOurPosition) {
  if (!HaveNumpy()) GTEST_SKIP() << "no python3 with numpy here";
  const TemporaryFolder folder;
  NpzArchive npz;
  AddSmplMotion(fixtures::SmoothMotion(kSmpl, 7, 25), nullptr, npz);
  npz.Write(folder / "dance.npz");
  EXPECT_EQ(RunNumpy(folder / "dance.npz",
                     "d = np.load(path)\n"
                     "j0 = np.array([-0.00179506, -0.22333382, 0.02821918])\n"
                     "pelvis = d['trans'] + j0\n"
                     "y_up = np.stack([pelvis[:, 0], pelvis[:, 2], -pelvis[:, 1]], 1)\n"
                     "print(d['poses'].shape, d['rotations'].shape, d['betas'].shape)\n"
                     "print(abs(y_up - d['root_positions']).max() < 1e-12)\n"
                     "print(abs(d['poses'].reshape(25, 52, 3)[:, 1:22] - "
                     "d['rotations'][:, 1:22]).max() < 1e-9)\n"
                     "print(str(d['gender']), float(d['mocap_framerate']))\n"),
            "(25, 156) (25, 24, 3) (16,)\nTrue\nTrue\nneutral 30.0\n");
}

TEST(AmassNpz, RefusesWhatItCannotUse) {
  const auto make = [](std::vector<int64_t> poses, std::vector<int64_t> trans, double fps) {
    NpzArchive npz;
    const auto zeros = [](const std::vector<int64_t>& shape) {
      int64_t size = 1;
      for (const int64_t extent : shape) size *= extent;
      return Array(shape, std::vector<double>(size, 0.0));
    };
    npz.SetArray("poses", zeros(poses));
    npz.SetArray("trans", zeros(trans));
    npz.SetArray("mocap_framerate", Array({}, {fps}));
    return npz;
  };
  const auto expect = [&](const std::string& part, const NpzArchive& npz) {
    ExpectError(ErrorCode::kInvalidArgument, part, [&] { ReadSmplMotion(npz); });
  };
  expect("poses: has the shape [4, 70], expected [frames, 72 or 156 or 165 or 66], or matrices, 6D",
         make({4, 70}, {4, 3}, 30));
  expect("trans: has the shape [4]", make({4, 72}, {4}, 30));
  expect("4 frames, but there are 5", make({4, 72}, {5, 3}, 30));
  expect("mocap_framerate", make({4, 72}, {4, 3}, 0));
  NpzArchive infinite = make({1, 72}, {1, 3}, 30);
  infinite.SetArray("trans", Array({1, 3}, {0, std::nan(""), 0}));
  expect("not finite", infinite);
  NpzArchive empty;
  expect("has no array", empty);

  NpzArchive out;
  const auto refuse = [&](const std::string& part, const Motion& motion,
                          const std::vector<Contacts>* contacts) {
    ExpectError(ErrorCode::kInvalidArgument, part, [&] { AddSmplMotion(motion, contacts, out); });
  };
  const Motion motion = fixtures::SmoothMotion(kSmpl, 5, 2);
  const std::vector<Contacts> one(1);
  refuse("contacts: 1 frames", motion, &one);
  refuse("0 frames", Motion{}, nullptr);
}

}  // namespace choreo::amass_npz_test
