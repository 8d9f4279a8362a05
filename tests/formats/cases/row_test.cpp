#include <string>
#include <vector>

#include "tests/formats/cases/smpl_arrays.h"
#include "tests/support/expect_error.h"

namespace choreo::cases_test {

// Rows as networks and data sets of dance write them: what a turn is stated as, how many are there,
// what stands before the place and after the turns.
TEST_F(CasesTest, ReadsCommonRowLayouts) {
  const SmplArrays smpl;
  struct Row {
    const char* says;
    int before, joints;
    std::vector<double> (*state)(const Eigen::Vector3d&);
    Eigen::Vector3d rest = SmplXRestPelvis();
    bool y_up = true;
  };
  for (const Row& row : std::vector<Row>{
           {"LODGE's 135 numbers a frame, at 30", 0, 22, AsRows},
           {"LODGE's 139 numbers", 4, 22, AsRows},
           {"LODGE's 139 numbers", 4, 22, AsColumns},
           {"EDGE's 151 numbers a frame, at 30", 4, 24, AsRows, {0, 0, 0}, false},
           {"FineDance's 315 numbers", 0, 52, AsRows},
           {"FineDance's 319 numbers", 4, 52, AsRows},
           {"AIST++'s 219 numbers a frame, at 60", 0, 24, AsMatrix, SmplRestPelvis()},
           {"AIST++'s 225 numbers", 6, 24, AsMatrix, SmplRestPelvis()},
       }) {
    SCOPED_TRACE(row.says);
    std::vector<double> rows;
    for (const Pose& pose : smpl.motion.frames) {
      Pose stated = row.y_up ? pose : ToAmass(pose);
      if (!row.y_up) stated.root_position += SmplRestPelvis();
      rows.insert(rows.end(), static_cast<size_t>(row.before), 0.25);
      for (const double value : Eigen::Vector3d(stated.root_position - row.rest))
        rows.push_back(value);
      for (int joint = 0; joint < row.joints; ++joint) {
        Eigen::Vector3d turn = Eigen::Vector3d::Zero();
        if (joint < 22) turn = stated.rotations.col(joint);
        const std::vector<double> values = row.state(turn);
        rows.insert(rows.end(), values.begin(), values.end());
      }
    }
    const int64_t width = std::ssize(rows) / smpl.frames();
    const Read read = ReadBytes("a.npy", SerializeNpy({{smpl.frames(), width}, rows}));
    EXPECT_LT(WorstJoint(smpl.motion, read.motion), 1e-6);
    EXPECT_EQ(read.notes.size(), 1U) << Said(read);
    EXPECT_TRUE(read.Says(std::string("read as ") + row.says)) << Said(read);
    const Read batch =
        ReadBytes("a.npy", SerializeNpy({{1, smpl.frames(), width}, rows}), {.fps = 25});
    EXPECT_EQ(batch.motion.fps, 25);
    EXPECT_LT(WorstJoint(smpl.motion, batch.motion), 1e-6);
    // As networks normalise them: no rotations, and not read as rotations.
    for (size_t i = 0; i < rows.size(); ++i) rows[i] = (rows[i] - 0.1) * 3;
    ExpectError(ErrorCode::kInvalidArgument, "a.npy: [:, ", [&] {
      ReadBytes("a.npy", SerializeNpy({{smpl.frames(), width}, rows}));
    });
  }
}

TEST_F(CasesTest, MotionXsRows) {
  const SmplArrays smpl;
  std::vector<double> rows;
  for (const Pose& pose : smpl.motion.frames) {
    rows.insert(rows.end(), pose.rotations.data(), pose.rotations.data() + 66);
    rows.insert(rows.end(), 309 - 66, 0.2);
    for (const double value : Eigen::Vector3d(pose.root_position - SmplXRestPelvis()))
      rows.push_back(value);
    rows.insert(rows.end(), 10, 0.0);
  }
  const Read read = ReadBytes("a.npy", SerializeNpy({{smpl.frames(), 322}, rows}));
  EXPECT_LT(WorstJoint(smpl.motion, read.motion), 1e-6);
  EXPECT_TRUE(read.Says("read as Motion-X's 322 numbers a frame, at 30")) << Said(read);
  for (size_t i = 312; i < rows.size(); i += 322) rows[i] = 2, rows[i - 2] -= 0.1;
  EXPECT_TRUE(ReadBytes("a.npy", SerializeNpy({{smpl.frames(), 322}, rows}))
                  .Says("its betas are another body's"));
}

TEST_F(CasesTest, HumanMl3dsRows) {
  const SmplArrays smpl;
  const auto yaw = [](int64_t frame) -> Eigen::Matrix3d { return About(0, 1, 0, 7.0 * frame); };
  const auto root = [&](int64_t frame) -> Eigen::Vector3d {
    return smpl.motion.frames[static_cast<size_t>(frame)].root_position;
  };
  std::vector<double> rows;
  for (int64_t frame = 0; frame + 1 < smpl.frames(); ++frame) {
    const Eigen::Vector3d way = yaw(frame + 1) * (root(frame + 1) - root(frame));
    const Eigen::Matrix3Xd joints =
        JointPositions(kSmpl, smpl.motion.frames[static_cast<size_t>(frame)]);
    rows.insert(rows.end(), {3.5 / kDegrees, way.x(), way.z(), root(frame).y()});
    for (Eigen::Index joint = 1; joint < 22; ++joint) {
      const Eigen::Vector3d seen =
          yaw(frame) * (joints.col(joint) - Eigen::Vector3d(root(frame).x(), 0, root(frame).z()));
      rows.insert(rows.end(), seen.begin(), seen.end());
    }
    rows.insert(rows.end(), 263 - 4 - 63, 0.1);
  }
  const NpyArray array{{smpl.frames() - 1, 263}, rows};
  const Read read = ReadBytes("a.npy", SerializeNpy(array));
  EXPECT_EQ(read.motion.fps, 20);
  EXPECT_TRUE(read.Says("read as HumanML3D's 263 numbers a frame, at 20")) << Said(read);
  EXPECT_TRUE(read.Says("joints alone do not determine"));
  for (const size_t frame : {0U, 9U, 18U}) {
    const Eigen::Matrix3Xd off = JointPositions(kSmpl, read.motion.frames[frame]) -
                                 JointPositions(kSmpl, smpl.motion.frames[frame]);
    EXPECT_LT(off.leftCols(22).colwise().norm().maxCoeff(), 0.03) << frame;
  }
  for (double& value : rows) value *= 3;
  for (size_t i = 0; i < rows.size(); ++i) rows[i] += static_cast<double>(i * i % 7);
  ExpectError(ErrorCode::kInvalidArgument, "are they normalised?", [&] {
    ReadBytes("a.npy", SerializeNpy({array.shape, rows}));
  });
}

}  // namespace choreo::cases_test
