#include "model/formats/amass_npz.h"

#include <algorithm>

#include "model/core/error.h"
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

// Turns Z up into Y up.
Eigen::Matrix3d YUpFromZUp() {
  return (Eigen::Matrix3d() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished();
}

// [F, columns], with the shape [F, a, b] accepted where a x b is one of `columns`.
Eigen::MatrixXd Rows(const NpzArchive& npz, const std::string& key,
                     std::initializer_list<int64_t> columns) {
  const NpyArray array = npz.Array(key);
  int64_t width = array.shape.size() >= 2 ? 1 : 0;
  for (size_t i = 1; i < array.shape.size(); ++i) width *= array.shape[i];
  if (std::find(columns.begin(), columns.end(), width) == columns.end() || array.shape.size() > 3) {
    std::string shape, wanted;
    for (const int64_t size : array.shape)
      shape += (shape.empty() ? "" : ", ") + std::to_string(size);
    for (const int64_t size : columns)
      wanted += (wanted.empty() ? "" : " or ") + std::to_string(size);
    throw InvalidArgument(key, "has the shape [" + shape + "], expected [frames, " + wanted + "]");
  }
  const std::vector<double> values = array.As<double>();
  Eigen::MatrixXd rows = Eigen::Map<const Eigen::MatrixXd>(values.data(), width, array.shape[0]);
  if (!rows.allFinite()) throw InvalidArgument(key, "holds values that are not finite");
  return rows;
}

double Number(const NpzArchive& npz, const std::string& key) {
  const NpyArray array = npz.Array(key);
  if (array.size() != 1) throw InvalidArgument(key, "is not one number");
  return array.As<double>()[0];
}

double CheckRate(const std::string& key, double fps) {
  if (!(fps >= 1 && fps <= 1000)) {
    throw InvalidArgument(key, std::to_string(fps) + ", must be 1 to 1000 frames a second");
  }
  return fps;
}

// Poses as they stand in the file: `rotations` with the 22 joints of the body or SMPL's 24.
Motion Assemble(const Eigen::MatrixXd& positions, const Eigen::MatrixXd& rotations, double fps,
                const std::string& key) {
  if (positions.cols() != rotations.cols()) {
    throw InvalidArgument(key, std::to_string(rotations.cols()) + " frames, but there are " +
                                   std::to_string(positions.cols()) + " root positions");
  }
  const int joints = Skeleton::Smpl24().joints();
  const bool all = rotations.rows() == 3 * joints;
  Motion motion;
  motion.fps = fps;
  for (Eigen::Index frame = 0; frame < positions.cols(); ++frame) {
    Pose pose;
    pose.root_position = positions.col(frame);
    pose.rotations = Eigen::Matrix3Xd::Zero(3, joints);
    const int known = all ? joints : kBodyJoints;
    pose.rotations.leftCols(known) =
        Eigen::Map<const Eigen::Matrix3Xd>(rotations.col(frame).data(), 3, known);
    motion.frames.push_back(std::move(pose));
  }
  CheckMotionLimits(motion);  // before turns of the world hide an absurd angle
  return motion;
}

NpyArray MakeArray(std::vector<int64_t> shape, std::vector<double> values) {
  return NpyArray{std::move(shape), std::move(values)};
}

}  // namespace

Eigen::Vector3d SmplRestPelvis() { return {-0.00179506, -0.22333382, 0.02821918}; }

Pose ToAmass(const Pose& pose) {
  const Eigen::Matrix3d z_up = YUpFromZUp().transpose();
  Pose amass = pose;
  amass.root_position = z_up * pose.root_position - SmplRestPelvis();
  amass.rotations.col(0) = LogMap(z_up * ExpMap(pose.rotations.col(0)));
  return amass;
}

Pose FromAmass(const Pose& amass) {
  const Eigen::Matrix3d y_up = YUpFromZUp();
  Pose pose = amass;
  pose.root_position = y_up * (amass.root_position + SmplRestPelvis());
  pose.rotations.col(0) = LogMap(y_up * ExpMap(amass.rotations.col(0)));
  return pose;
}

bool HasSmplMotion(const NpzArchive& npz) {
  return (npz.Has("rotations") && npz.Has("root_positions")) ||
         (npz.Has("poses") && npz.Has("trans")) || (npz.Has("smpl_poses") && npz.Has("smpl_trans"));
}

Motion ReadSmplMotion(const NpzArchive& npz) {
  Motion motion;
  if (npz.Has("rotations") && npz.Has("root_positions")) {
    return Assemble(Rows(npz, "root_positions", {3}), Rows(npz, "rotations", {72}),
                    CheckRate("fps", Number(npz, "fps")), "rotations");
  }
  if (npz.Has("smpl_poses") && !npz.Has("poses")) {
    const bool aist = npz.Has("smpl_scaling");
    const double fps = npz.Has("fps") ? Number(npz, "fps") : aist ? 60 : 30;
    Eigen::MatrixXd trans = Rows(npz, "smpl_trans", {3});
    if (aist) trans /= Number(npz, "smpl_scaling");
    motion = Assemble(trans, Rows(npz, "smpl_poses", {72}), CheckRate("fps", fps), "smpl_poses");
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
    const Eigen::MatrixXd poses = Rows(npz, "poses", {72, 3 * kSmplHJoints, 3 * kSmplXJoints});
    motion = Assemble(Rows(npz, "trans", {3}), poses, CheckRate(rate, Number(npz, rate)), "poses");
    const bool smpl_x = poses.rows() == 3 * kSmplXJoints;
    for (Pose& pose : motion.frames) {
      if (smpl_x) pose.root_position += kSmplXRestPelvis - SmplRestPelvis();
      pose = FromAmass(pose);
    }
  }
  MakeContinuous(motion);
  return motion;
}

void AddSmplMotion(const Skeleton& skeleton, const Motion& motion,
                   const std::vector<Contacts>* contacts, NpzArchive& npz) {
  const Skeleton& smpl = Skeleton::Smpl24();
  if (skeleton.joint_names != smpl.joint_names || skeleton.parents != smpl.parents) {
    throw InvalidArgument("skeleton", "'" + skeleton.name + "' cannot be written as SMPL motion");
  }
  const auto frames = static_cast<int64_t>(motion.frames.size());
  if (frames == 0) throw InvalidArgument("motion.frames", "0 frames, at least 1 is needed");
  if (contacts && contacts->size() != motion.frames.size()) {
    throw InvalidArgument("contacts", std::to_string(contacts->size()) +
                                          " frames, the motion has " + std::to_string(frames));
  }
  std::vector<double> trans, poses, roots, rotations;
  Motion amass = motion;
  for (Pose& pose : amass.frames) pose = ToAmass(pose);
  MakeContinuous(amass);
  for (int64_t frame = 0; frame < frames; ++frame) {
    const Pose& ours = motion.frames[frame];
    const Pose& theirs = amass.frames[frame];
    if (ours.rotations.cols() != smpl.joints()) {
      throw InvalidArgument("motion.frames[" + std::to_string(frame) + "].rotations",
                            std::to_string(ours.rotations.cols()) + " joints, expected " +
                                std::to_string(smpl.joints()));
    }
    const auto append = [](std::vector<double>& to, const auto& values) {
      to.insert(to.end(), values.data(), values.data() + values.size());
    };
    append(roots, ours.root_position);
    append(rotations, ours.rotations);
    append(trans, theirs.root_position);
    append(poses, theirs.rotations.leftCols(kBodyJoints).eval());
    poses.resize((frame + 1) * 3 * kSmplHJoints, 0.0);
  }
  npz.SetArray("root_positions", MakeArray({frames, 3}, std::move(roots)));
  npz.SetArray("rotations", MakeArray({frames, smpl.joints(), 3}, std::move(rotations)));
  npz.SetArray("fps", MakeArray({}, {motion.fps}));
  npz.SetArray("trans", MakeArray({frames, 3}, std::move(trans)));
  npz.SetArray("poses", MakeArray({frames, 3 * kSmplHJoints}, std::move(poses)));
  npz.SetArray("mocap_framerate", MakeArray({}, {motion.fps}));
  npz.SetArray("betas", MakeArray({kBetas}, std::vector<double>(kBetas, 0.0)));
  npz.SetText("gender", "neutral");
  if (contacts) {
    std::vector<float> values;
    for (const Contacts& row : *contacts) values.insert(values.end(), row.begin(), row.end());
    npz.SetArray("contacts", NpyArray{{frames, 4}, std::move(values)});
  }
}

}  // namespace choreo
