#include "model/formats/amass_npz.h"

#include <utility>

#include "model/core/error.h"
#include "model/formats/own_arrays.h"
#include "model/motion/pose_limits.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr int kBodyJoints = 22;   // what SMPL, SMPL-H and SMPL-X share, in the same order
constexpr int kSmplHJoints = 52;  // AMASS: the body and 15 joints a hand
constexpr int kSmplXJoints = 55;  // and jaw and eyes between body and hands
constexpr int kBetas = 16;

// SMPL-X's neutral body has its pelvis elsewhere.
const Eigen::Vector3d kSmplXRestPelvis(0.00312326, -0.35140747, 0.01203655);

const Eigen::Matrix3d kYUpFromZUp{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};

// Poses as they stand in the file: `rotations` with the 22 joints of the body or SMPL's 24.
Motion Assemble(const Eigen::MatrixXd& positions, const Eigen::MatrixXd& rotations, double fps,
                const std::string& key) {
  const int joints = Skeleton::Smpl24().joints();
  const int known = rotations.rows() == 3 * joints ? joints : kBodyJoints;
  Motion motion = MotionOfRows(positions, rotations.topRows(3 * known), joints, fps, key);
  CheckMotionLimits(motion);  // before turns of the world hide an absurd angle
  return motion;
}

}  // namespace

Eigen::Vector3d SmplRestPelvis() { return {-0.00179506, -0.22333382, 0.02821918}; }

Pose ToAmass(const Pose& pose) {
  const Eigen::Matrix3d z_up = kYUpFromZUp.transpose();
  Pose amass = pose;
  amass.root_position = z_up * pose.root_position - SmplRestPelvis();
  amass.rotations.col(0) = LogMap(z_up * ExpMap(pose.rotations.col(0)));
  return amass;
}

Pose FromAmass(const Pose& amass) {
  Pose pose = amass;
  pose.root_position = kYUpFromZUp * (amass.root_position + SmplRestPelvis());
  pose.rotations.col(0) = LogMap(kYUpFromZUp * ExpMap(amass.rotations.col(0)));
  return pose;
}

Motion ReadSmplMotion(const NpzArchive& npz) {
  Motion motion;
  if (npz.Has("rotations") && npz.Has("root_positions")) {
    motion = ReadOwnArrays(Skeleton::Smpl24(), npz);
    CheckMotionLimits(motion);
    return motion;
  }
  if (npz.Has("smpl_poses") && !npz.Has("poses")) {
    const bool aist = npz.Has("smpl_scaling");
    const double fps = npz.Has("fps") ? NpzNumber(npz, "fps") : aist ? 60 : 30;
    Eigen::MatrixXd trans = NpzRows(npz, "smpl_trans", {3});
    if (aist) trans /= NpzNumber(npz, "smpl_scaling");
    motion = Assemble(trans, NpzRows(npz, "smpl_poses", {72}), CheckRate("fps", fps), "smpl_poses");
    for (Pose& pose : motion.frames) {
      if (aist) {
        pose.root_position += SmplRestPelvis();
      } else {
        pose.root_position -= SmplRestPelvis();  // as AMASS would have it
        pose = FromAmass(pose);
      }
    }
  } else {
    const char* rate = npz.Has("mocap_frame_rate") ? "mocap_frame_rate" : "mocap_framerate";
    const Eigen::MatrixXd poses = NpzRows(npz, "poses", {72, 3 * kSmplHJoints, 3 * kSmplXJoints});
    motion =
        Assemble(NpzRows(npz, "trans", {3}), poses, CheckRate(rate, NpzNumber(npz, rate)), "poses");
    const bool smpl_x = poses.rows() == 3 * kSmplXJoints;
    for (Pose& pose : motion.frames) {
      if (smpl_x) pose.root_position += kSmplXRestPelvis - SmplRestPelvis();
      pose = FromAmass(pose);
    }
  }
  MakeContinuous(motion);
  return motion;
}

void AddSmplMotion(const Motion& motion, const std::vector<Contacts>* contacts, NpzArchive& npz) {
  AddOwnArrays(Skeleton::Smpl24(), motion, contacts, npz);
  const auto frames = static_cast<int64_t>(motion.frames.size());
  std::vector<double> trans, poses;
  Motion amass = motion;
  for (Pose& pose : amass.frames) pose = ToAmass(pose);
  MakeContinuous(amass);
  for (const Pose& pose : amass.frames) {
    trans.insert(trans.end(), pose.root_position.begin(), pose.root_position.end());
    poses.insert(poses.end(), pose.rotations.data(), pose.rotations.data() + 3 * kBodyJoints);
    poses.resize(trans.size() * kSmplHJoints, 0.0);  // the hands at rest
  }
  npz.SetArray("trans", {{frames, 3}, std::move(trans)});
  npz.SetArray("poses", {{frames, 3 * kSmplHJoints}, std::move(poses)});
  npz.SetArray("mocap_framerate", {{}, std::vector<double>{motion.fps}});
  npz.SetArray("betas", {{kBetas}, std::vector<double>(kBetas, 0.0)});
  npz.SetText("gender", "neutral");
}

}  // namespace choreo
