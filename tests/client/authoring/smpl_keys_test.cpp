#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "client/authoring/keys/key_file.h"
#include "model/formats/containers/npz.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

/// Keys whose poses are SMPL's, as AMASS and EDGE write them.
namespace choreo::authoring::smpl_keys_test {

const Skeleton& Body() { return Skeleton::Smpl24(); }

std::vector<client::KeyPose> Parse(const std::string& members) {
  return ParseKeyFile(R"({"keyframes": [{"time": 1, )" + members + "}]}", "keys.json", Body());
}

// Turning Z up into Y up would make a small angle of any.
TEST(KeyFileTest, RefusesAbsurdAnglesAsTheyAreWritten) {
  const auto refused = [](double root, const std::string& part) {
    std::vector<double> poses(72, 0.1);
    poses[0] = root;
    ExpectError(ErrorCode::kInvalidArgument, part,
                [&] { Parse(R"("smpl_poses": )" + nlohmann::json(poses).dump()); });
  };
  refused(1e30, "keyframes[0].smpl_poses[0]: 1e+30 rad exceeds 2π");
  refused(7, "keyframes[0].smpl_poses[0]: 7.00143 rad exceeds 2π");
}

// Where SMPL's joints are, as its authors and EDGE define it, written down without our code: Z up,
// joints rotate about their places in a rest body whose pelvis is at `rest_pelvis`, and the
// translation moves it all. Then turned to Y up.
Eigen::Matrix3Xd SmplJoints(const std::vector<double>& poses, const Eigen::Vector3d& trans,
                            const Eigen::Vector3d& rest_pelvis) {
  Eigen::Matrix3Xd joints(3, 24);
  std::vector<Eigen::Matrix3d> global(24);
  for (int joint = 0; joint < 24; ++joint) {
    const Eigen::Vector3d w(poses[3 * joint], poses[3 * joint + 1], poses[3 * joint + 2]);
    const Eigen::Matrix3d local =
        w.isZero() ? Eigen::Matrix3d::Identity().eval()
                   : Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix();
    const int parent = Body().parents[joint];
    if (parent < 0) {
      joints.col(joint) = rest_pelvis + trans;
      global[joint] = local;
    } else {
      joints.col(joint) = joints.col(parent) + global[parent] * Body().offsets.col(joint);
      global[joint] = global[parent] * local;
    }
  }
  Eigen::Matrix3Xd y_up(3, 24);
  y_up << joints.row(0), joints.row(2), -joints.row(1);
  return y_up;
}

const Eigen::Vector3d kJ0(-0.00179506, -0.22333382, 0.02821918);

// A standing dancer in a Z-up world, every joint bent somehow.
std::vector<double> ZUpPose() {
  std::vector<double> poses(72);
  for (size_t i = 0; i < poses.size(); ++i) poses[i] = 0.4 * std::sin(1.7 * double(i) + 0.3);
  poses[0] += M_PI / 2;
  return poses;
}

TEST(KeyFileTest, TakesPosesOfEdgeAndAmass) {
  const std::vector<double> poses = ZUpPose();
  const Eigen::Vector3d trans(0.4, -1.2, 0.95);
  const std::string numbers = nlohmann::json(poses).dump();
  const std::string place = "[0.4, -1.2, 0.95]";
  struct Case {
    std::string members;
    Eigen::Vector3d rest_pelvis;
    int joints;  // that it gives
  };
  std::vector<double> smpl_h = poses;
  smpl_h.resize(156);
  for (size_t i = 66; i < 156; ++i) smpl_h[i] = 0.2;  // fingers
  std::vector<std::vector<double>> rows;
  for (size_t i = 0; i < 72; i += 3) rows.push_back({poses[i], poses[i + 1], poses[i + 2]});
  for (const Case& one :
       {Case{R"("smpl_poses": )" + numbers + R"(, "smpl_trans": )" + place, Eigen::Vector3d::Zero(),
             24},
        Case{R"("smpl_poses": )" + nlohmann::json(rows).dump() + R"(, "smpl_trans": )" + place,
             Eigen::Vector3d::Zero(), 24},
        Case{R"("poses": )" + numbers + R"(, "trans": )" + place, kJ0, 24},
        Case{R"("poses": )" + nlohmann::json(smpl_h).dump() + R"(, "trans": )" + place, kJ0, 22}}) {
    const auto keys = Parse(one.members);
    ASSERT_EQ(keys.size(), 1U);
    EXPECT_TRUE(keys[0].mask.root_position);
    const Eigen::Matrix3Xd expected = SmplJoints(poses, trans, one.rest_pelvis);
    const Eigen::Matrix3Xd ours = JointPositions(Body(), keys[0].pose);
    EXPECT_LT((ours - expected).leftCols(one.joints).cwiseAbs().maxCoeff(), 1e-12);
    // The head is above the hips: Z has become Y.
    EXPECT_GT(ours(1, Body().Find("head")), ours(1, 0) + 0.3);
  }
  const auto nowhere = Parse(R"("smpl_poses": )" + numbers);
  EXPECT_FALSE(nowhere[0].mask.root_position);

  const auto refused = [](const std::string& members, const std::string& part) {
    ExpectError(ErrorCode::kInvalidArgument, part, [&] { Parse(members); });
  };
  refused(R"("smpl_poses": [1, 2, 3])",
          "keyframes[0]: smpl_poses: has the shape [1, 3], expected [frames, 72]");
  refused(R"("poses": [[0, 0, 0]])", "expected [frames, 72 or 156 or 165 or 66]");
  refused(R"("smpl_poses": )" + numbers + R"(, "smpl_trans": [0, 1])", "smpl_trans: has the shape");
  refused(R"("smpl_trans": [0, 1, 2])", "keyframes[0].smpl_poses: is missing beside smpl_trans");
  refused(R"("smpl_poses": )" + numbers + R"(, "rotations": [])",
          "keyframes[0].smpl_poses: cannot be combined with rotations");
  refused(R"("smpl_poses": )" + numbers + R"(, "root_position": [0, 1, 0])",
          "keyframes[0].rotations: is missing beside root_position");
  refused(R"("smpl_poses": [0, 0, "x"])", "keyframes[0].smpl_poses[2]: \"x\" is not a number");
  std::vector<double> absurd = poses;
  absurd[9] = 9;
  refused(R"("smpl_poses": )" + nlohmann::json(absurd).dump(), "smpl_poses[3]: 9.0");
}

// The same in files: `--keyframes FILE.npz@SECOND`.
TEST(KeyFileTest, TakesPosesOutOfFilesOfEdgeAndAmass) {
  const TemporaryFolder folder;
  std::vector<double> poses(72), trans = {0, 0, 0};
  const std::vector<double> bent = ZUpPose();
  poses.insert(poses.end(), bent.begin(), bent.end());
  trans.insert(trans.end(), {0.4, -1.2, 0.95});
  NpzArchive edge, amass;
  edge.SetArray("smpl_poses", {{2, 72}, poses});
  edge.SetArray("smpl_trans", {{2, 3}, trans});
  edge.Write(folder / "edge.npz");
  amass.SetArray("poses", {{2, 72}, poses});
  amass.SetArray("trans", {{2, 3}, trans});
  amass.SetArray("mocap_framerate", {{}, std::vector<double>{120}});
  amass.Write(folder / "amass.npz");
  const auto expect = [&](const std::string& source, const Eigen::Vector3d& rest_pelvis) {
    const auto keys = ReadKeys((folder / source).string(), Body());
    ASSERT_EQ(keys.size(), 1U);
    EXPECT_EQ(keys[0].time_s, 4);
    EXPECT_LT(
        (JointPositions(Body(), keys[0].pose) - SmplJoints(bent, {0.4, -1.2, 0.95}, rest_pelvis))
            .cwiseAbs()
            .maxCoeff(),
        1e-9);
  };
  expect("edge.npz@0.0333333333333=4", Eigen::Vector3d::Zero());
  expect("amass.npz@0.0083333333333=4", kJ0);
}

}  // namespace choreo::authoring::smpl_keys_test
