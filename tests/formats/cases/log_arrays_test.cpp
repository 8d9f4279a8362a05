// The log of arrays that were once read wrong, or refused without need.
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "model/formats/arrays/amass_npz.h"
#include "tests/formats/cases/cases.h"
#include "tests/support/expect_error.h"
#include "tests/support/pickles.h"

namespace choreo::log_arrays_test {

using namespace cases_test;

/// A body that steps, as SMPL's arrays have it.
struct Arrays {
  Motion motion;
  std::vector<double> poses, trans;  ///< of 24 joints, Z up

  Arrays() {
    motion.fps = 30;
    for (int frame = 0; frame < 20; ++frame) {
      Pose pose = RestPose(kSmpl);
      pose.root_position.x() = 0.05 * frame;
      pose.rotations.col(kSmpl.left_hip) << -0.02 * frame, 0, 0;
      pose.rotations.col(kSmpl.left_knee) << 0.03 * frame, 0, 0.1;
      pose.rotations.col(kSmpl.left_shoulder) << 0, 0.02 * frame, -1.2;
      pose.rotations.col(kSmpl.right_shoulder) << 0, 0, 1.2;
      motion.frames.push_back(pose);
      const Pose amass = ToAmass(pose);
      poses.insert(poses.end(), amass.rotations.data(), amass.rotations.data() + 72);
      trans.insert(trans.end(), amass.root_position.begin(), amass.root_position.end());
    }
  }
  NpyArray Poses(std::vector<int64_t> rest,
                 const std::function<std::vector<double>(const Eigen::Vector3d&)>& state) const {
    std::vector<double> all;
    for (size_t i = 0; i < poses.size(); i += 3) {
      const std::vector<double> values = state({poses[i], poses[i + 1], poses[i + 2]});
      all.insert(all.end(), values.begin(), values.end());
    }
    rest.insert(rest.begin(), 20);
    return {rest, all};
  }
  NpyArray Trans() const { return {{20, 3}, trans}; }
};

TEST_F(CasesTest, TheLogOfArrays) {
  const Arrays smpl;
  const NpyArray rate{{}, std::vector<double>{30}};
  const auto vector = [](const Eigen::Vector3d& turn) {
    return std::vector<double>{turn.begin(), turn.end()};
  };
  const auto quaternion = [](bool real_first) {
    return [real_first](const Eigen::Vector3d& turn) {
      const Eigen::Quaterniond q(ExpMap(turn));
      return real_first ? std::vector<double>{q.w(), q.x(), q.y(), q.z()}
                        : std::vector<double>{-q.x(), -q.y(), -q.z(), -q.w()};
    };
  };
  struct ArrayRow {
    const char* name;
    NpyArray poses;
    const char* says = "";
    const char* options = "";
  };
  const auto scaled = [](double body, double root) {
    // The root, as AMASS has it, is turned by a quarter.
    return [=](const Eigen::Vector3d& turn) {
      const Eigen::Vector3d all = turn * (turn.norm() > 1.5 ? root : body);
      return std::vector<double>{all.begin(), all.end()};
    };
  };
  for (const ArrayRow& row : std::vector<ArrayRow>{
           {"quaternions, x first", smpl.Poses({24, 4}, quaternion(false))},
           {"quaternions, w first", smpl.Poses({24, 4}, quaternion(true))},
           {"flat quaternions", smpl.Poses({96}, quaternion(true))},
           {"6D, two columns beside each other", smpl.Poses({24, 3, 2},
                                                            [](const Eigen::Vector3d& turn) {
                                                              const Eigen::Matrix3d m =
                                                                  ExpMap(turn);
                                                              return std::vector<double>{
                                                                  m(0, 0), m(0, 1), m(1, 0),
                                                                  m(1, 1), m(2, 0), m(2, 1)};
                                                            })},
           {"degrees", smpl.Poses({72}, scaled(kDegrees, kDegrees)),
            "its poses are read as degrees, not radians; --angles radians"},
           {"degrees, told", smpl.Poses({72}, scaled(kDegrees, kDegrees)), "", "--angles degrees"},
           {"radians of a root that spins on",
            smpl.Poses({72}, scaled(1, 1 + 8 * M_PI / (M_PI / 2))),
            "its root alone turns by more than two whole turns: its poses are read as radians"},
           {"the same, told", smpl.Poses({72}, scaled(1, 1 + 8 * M_PI / (M_PI / 2))), "",
            "--angles radians"},
       }) {
    SCOPED_TRACE(row.name);
    NpzArchive npz;
    npz.SetArray("poses", row.poses);
    npz.SetArray("trans", smpl.Trans());
    npz.SetArray("fps", rate);
    const Read read = ReadNpz(npz, Options(row.options));
    EXPECT_LT(WorstJoint(smpl.motion, read.motion), 1e-6);
    EXPECT_EQ(read.notes.empty(), std::string(row.says).empty()) << Said(read);
    EXPECT_TRUE(read.notes.empty() || read.Says(row.says)) << Said(read);
  }
  NpzArchive npz;
  npz.SetArray("poses", smpl.Poses({72}, vector));
  npz.SetArray("trans", smpl.Trans());
  npz.SetText("fps", "30");
  EXPECT_EQ(ReadNpz(npz).motion.fps, 30);
  npz.SetText("fps", "many");
  ExpectError(ErrorCode::kInvalidArgument, "fps: \"many\" is not a number; --fps says one",
              [&] { ReadNpz(npz); });
  EXPECT_EQ(ReadNpz(npz, {.fps = 25}).motion.fps, 25);
  // A note names two rates that differ, and --fps decides.
  npz.SetArray("fps", rate);
  npz.SetArray("mocap_frame_rate", {{}, std::vector<double>{120}});
  const Read two = ReadNpz(npz);
  EXPECT_EQ(two.motion.fps, 120);
  EXPECT_TRUE(two.Says("states mocap_frame_rate 120, fps 30: 120 frames a second is used, --fps"))
      << Said(two);
  EXPECT_EQ(ReadNpz(npz, {.fps = 30}).motion.fps, 30);
  EXPECT_TRUE(ReadNpz(npz, {.fps = 30}).notes.empty());
  // Degrees so small that they may be radians bend knees as none can.
  npz.SetArray("poses", smpl.Poses({72}, scaled(20, 1)));
  EXPECT_TRUE(ReadNpz(npz, {.fps = 30, .angles = "radians"}).Says("--angles sets the unit"));
  npz.SetArray("poses", smpl.Poses({24, 4}, [](const Eigen::Vector3d&) {
    return std::vector<double>{1, 1, 0, 0};
  }));
  ExpectError(ErrorCode::kInvalidArgument, "poses[0][0]: is not a quaternion of length 1",
              [&] { ReadNpz(npz); });
  NpyArray lost = smpl.Poses({72}, vector);
  std::get<std::vector<double>>(lost.values)[72 * 7] = NAN;
  npz.SetArray("poses", lost);
  ExpectError(ErrorCode::kInvalidArgument,
              "poses: holds values that are not finite, first in frame 7 of 20",
              [&] { ReadNpz(npz); });
  npz.SetArray("poses", smpl.Poses({24, 4}, quaternion(true)));
  ExpectError(ErrorCode::kInvalidArgument, "--angles: is for rotation vectors, which its poses are",
              [&] { ReadNpz(npz, {.angles = "degrees"}); });
  ExpectError(ErrorCode::kInvalidArgument, "--angles: \"turns\" is none of degrees, radians",
              [&] { ReadNpz(npz, {.angles = "turns"}); });
  WriteFile(folder_ / "a.npz", "PK\5\6" + std::string(18, '\0'));  // a zip of nothing
  ExpectError(ErrorCode::kInvalidArgument,
              "(it has: nothing): write rotations and places by numpy.savez",
              [&] { ReadFile("a.npz"); });
}

TEST_F(CasesTest, ADictThatNumpySaved) {
  const Arrays smpl;
  const NpyArray poses{{20, 72}, smpl.poses}, rate{{}, std::vector<double>{30}};
  WritePickle(folder_ / "a.pkl", {{"poses", poses}, {"trans", smpl.Trans()}, {"fps", rate}});
  const std::string pickle = choreo::ReadFile(folder_ / "a.pkl");
  const std::string npy = JoinNpy({.descr = "|O", .shape = {}, .values = pickle});
  EXPECT_LT(WorstJoint(smpl.motion, ReadBytes("a.npy", npy).motion), 1e-6);
  ExpectError(ErrorCode::kInvalidArgument,
              "a.npy: holds one array and does not say of what, as rows of 135, ",
              [&] { ReadBytes("a.npy", SerializeNpy(poses)); });
}

TEST_F(CasesTest, ReadsJointPositionsAlone) {
  const Arrays smpl;
  std::vector<double> places;
  for (const Pose& pose : smpl.motion.frames) {
    const Eigen::Matrix3Xd at = JointPositions(kSmpl, pose);
    places.insert(places.end(), at.data(), at.data() + 66);
  }
  const NpyArray joints{{20, 22, 3}, places};
  NpzArchive npz;
  npz.SetArray("joints", joints);
  npz.SetArray("fps", {{}, std::vector<double>{20}});
  npz.Write(folder_ / "a.npz");
  const Read named = ReadFile("a.npz"),
             bare = ReadBytes("a.npy", SerializeNpy(joints), {.fps = 20});
  for (const Read& read : {named, bare}) {
    EXPECT_EQ(read.motion.fps, 20);
    EXPECT_TRUE(read.Says("joints alone do not determine")) << Said(read);
    ASSERT_EQ(read.motion.frames.size(), 20U);
    const Eigen::Matrix3Xd ours = JointPositions(kSmpl, read.motion.frames[10]),
                           theirs = JointPositions(kSmpl, smpl.motion.frames[10]);
    EXPECT_LT((ours - theirs).colwise().norm().head(22).maxCoeff(), 0.03);
  }
  EXPECT_TRUE(ReadBytes("a.npy", SerializeNpy(joints)).Says("states no rate; read as 30"));
}

}  // namespace choreo::log_arrays_test
