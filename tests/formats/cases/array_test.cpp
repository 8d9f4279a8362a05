#include <functional>
#include <map>
#include <string>
#include <vector>

#include "model/formats/amass_npz.h"
#include "model/motion/floor_clearance.h"
#include "tests/formats/cases/cases.h"
#include "tests/support/expect_error.h"
#include "tests/support/pickles.h"

namespace choreo::cases_test {

/// A body that steps, in SMPL's terms, by 20 frames; Z up as AMASS has it.
struct SmplArrays {
  Motion motion;  ///< ours
  std::vector<double> root, body, trans;

  explicit SmplArrays(int frames = 20) {
    motion.fps = 30;
    for (int frame = 0; frame < frames; ++frame) {
      Pose pose = RestPose(kSmpl);
      pose.root_position.x() = 0.05 * frame;
      pose.rotations.col(kSmpl.left_hip) << -0.02 * frame, 0, 0;
      pose.rotations.col(kSmpl.left_knee) << 0.03 * frame, 0, 0.1;
      pose.rotations.col(kSmpl.Find("head")) << 0, 0.5, 0.2;
      motion.frames.push_back(pose);
      const Pose amass = ToAmass(pose);
      root.insert(root.end(), amass.rotations.data(), amass.rotations.data() + 3);
      body.insert(body.end(), amass.rotations.data() + 3, amass.rotations.data() + 66);
      trans.insert(trans.end(), amass.root_position.begin(), amass.root_position.end());
    }
  }
  int64_t frames() const { return std::ssize(motion.frames); }
  NpyArray Root() const { return {{frames(), 3}, root}; }
  NpyArray Body() const { return {{frames(), 63}, body}; }
  NpyArray Trans() const { return {{frames(), 3}, trans}; }
  // All 22 joints, `width` values each, as `state` has a rotation vector.
  std::vector<double> All(const std::function<std::vector<double>(Eigen::Vector3d)>& state,
                          int joints) const {
    std::vector<double> all;
    for (int64_t frame = 0; frame < frames(); ++frame) {
      for (int joint = 0; joint < joints; ++joint) {
        Eigen::Vector3d turn = Eigen::Vector3d::Zero();
        if (joint == 0)
          turn = Eigen::Map<const Eigen::Vector3d>(&root[3 * static_cast<size_t>(frame)]);
        if (joint > 0 && joint < 22) {
          turn = Eigen::Map<const Eigen::Vector3d>(
              &body[static_cast<size_t>(63 * frame + 3 * (joint - 1))]);
        }
        const std::vector<double> values = state(turn);
        all.insert(all.end(), values.begin(), values.end());
      }
    }
    return all;
  }
};

std::vector<double> AsMatrix(const Eigen::Vector3d& turn) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> m = ExpMap(turn);
  return {m.data(), m.data() + 9};
}
std::vector<double> AsRows(const Eigen::Vector3d& turn) {
  std::vector<double> m = AsMatrix(turn);
  m.resize(6);
  return m;
}
std::vector<double> AsColumns(const Eigen::Vector3d& turn) {
  const auto six = SixDFromMatrix(ExpMap(turn));
  return {six.begin(), six.end()};
}
std::vector<double> AsVector(const Eigen::Vector3d& turn) { return {turn.begin(), turn.end()}; }

TEST_F(CasesTest, ArraysOfEveryKind) {
  const SmplArrays smpl;
  struct Row {
    const char* name;
    std::map<std::string, NpyArray> arrays;
    std::string says = "";
  };
  const NpyArray rate{{}, std::vector<double>{30}};
  const int64_t f = smpl.frames();
  const std::vector<Row> rows = {
      {"split",
       {{"root_orient", smpl.Root()},
        {"pose_body", smpl.Body()},
        {"trans", smpl.Trans()},
        {"mocap_frame_rate", rate}}},
      {"smplx",
       {{"global_orient", smpl.Root()}, {"body_pose", smpl.Body()}, {"transl", smpl.Trans()}},
       "states no rate"},
      {"fps",
       {{"poses", {{f, 156}, smpl.All(AsVector, 52)}},
        {"trans", smpl.Trans()},
        {"fps", {{}, std::vector<int64_t>{30}}}}},
      {"22 joints",
       {{"poses", {{f, 22, 3}, smpl.All(AsVector, 22)}}, {"trans", smpl.Trans()}, {"fps", rate}}},
      {"no rate",
       {{"poses", {{f, 72}, smpl.All(AsVector, 24)}}, {"trans", smpl.Trans()}},
       "states no rate"},
      {"matrices",
       {{"poses", {{f, 24, 3, 3}, smpl.All(AsMatrix, 24)}},
        {"trans", smpl.Trans()},
        {"fps", rate}}},
      {"flat matrices",
       {{"poses", {{f, 216}, smpl.All(AsMatrix, 24)}}, {"trans", smpl.Trans()}, {"fps", rate}}},
      {"6D",
       {{"poses", {{f, 24, 6}, smpl.All(AsRows, 24)}}, {"trans", smpl.Trans()}, {"fps", rate}}},
      {"6D by columns",
       {{"poses", {{f, 144}, smpl.All(AsColumns, 24)}}, {"trans", smpl.Trans()}, {"fps", rate}}},
      {"a batch of one",
       {{"poses", {{1, f, 72}, smpl.All(AsVector, 24)}},
        {"trans", {{1, f, 3}, smpl.trans}},
        {"fps", rate}}},
  };
  for (const Row& row : rows) {
    for (const bool pickled : {false, true}) {
      SCOPED_TRACE(row.name + std::string(pickled ? " pkl" : " npz"));
      NpzArchive npz;
      for (const auto& [key, array] : row.arrays) npz.SetArray(key, array);
      if (pickled) WritePickle(folder_ / "a.pkl", row.arrays);
      const Read read = pickled ? ReadFile("a.pkl") : ReadNpz(npz);
      EXPECT_EQ(read.motion.fps, 30);
      EXPECT_LT(WorstJoint(smpl.motion, read.motion), 1e-6);
      EXPECT_EQ(read.notes.empty(), row.says.empty()) << Said(read);
      EXPECT_TRUE(row.says.empty() || read.Says(row.says)) << Said(read);
    }
  }
  NpzArchive npz;
  npz.SetArray("poses", {{f, 72}, smpl.All(AsVector, 24)});
  npz.SetArray("trans", smpl.Trans());
  EXPECT_EQ(ReadNpz(npz, {.fps = 50}).motion.fps, 50);
  npz.SetArray("poses", {{f, 24, 3, 3}, std::vector<double>(static_cast<size_t>(f) * 216, 0.5)});
  ExpectError(ErrorCode::kInvalidArgument, "a.npz: poses[0][0]: is no rotation matrix",
              [&] { ReadNpz(npz); });
}

TEST_F(CasesTest, ArraysWhoseAxesOrUnitAreOthers) {
  const SmplArrays smpl;
  const auto file = [&](bool y_up, double unit) {
    std::vector<double> poses, trans;
    for (const Pose& pose : smpl.motion.frames) {
      const Pose stated = y_up ? pose : ToAmass(pose);
      poses.insert(poses.end(), stated.rotations.data(), stated.rotations.data() + 72);
      const Eigen::Vector3d place =
          (y_up ? Eigen::Vector3d(pose.root_position - SmplRestPelvis()) : stated.root_position);
      for (const double value : place) trans.push_back(value / unit);
    }
    NpzArchive npz;
    npz.SetArray("poses", {{smpl.frames(), 72}, poses});
    npz.SetArray("trans", {{smpl.frames(), 3}, trans});
    npz.SetArray("fps", {{}, std::vector<double>{30}});
    return npz;
  };
  const Read y_up = ReadNpz(file(true, 1));
  EXPECT_TRUE(y_up.Says("taken as y up, not z")) << Said(y_up);
  EXPECT_LT(WorstJoint(smpl.motion, y_up.motion), 1e-6);
  EXPECT_TRUE(ReadNpz(file(true, 1), {.up = "y"}).notes.empty());
  const Read centimetres = ReadNpz(file(false, 0.01));
  EXPECT_TRUE(centimetres.Says("taken as centimetres")) << Said(centimetres);
  EXPECT_LT(WorstJoint(smpl.motion, centimetres.motion), 1e-6);
  EXPECT_LT(WorstJoint(smpl.motion, ReadNpz(file(false, 0.5), {.scale = 0.5}).motion), 1e-6);
}

TEST_F(CasesTest, AnotherBodysFeetStandOnTheFloor) {
  SmplArrays smpl;
  for (size_t i = 2; i < smpl.trans.size(); i += 3) smpl.trans[i] -= 0.09;
  NpzArchive npz;
  npz.SetArray("poses", {{smpl.frames(), 72}, smpl.All(AsVector, 24)});
  npz.SetArray("trans", smpl.Trans());
  npz.SetArray("fps", {{}, std::vector<double>{30}});
  npz.SetArray("betas", {{10}, std::vector<double>(10, 1.5)});
  const Read read = ReadNpz(npz);
  EXPECT_TRUE(read.Says("betas are another body's")) << Said(read);
  EXPECT_NEAR(HeightAboveFloor(kSmpl, read.motion.frames[0]), 0, 0.01);
  npz.SetArray("betas", {{10}, std::vector<double>(10, 0.0)});
  EXPECT_TRUE(ReadNpz(npz).Says("its feet were under the floor"));
}

}  // namespace choreo::cases_test
