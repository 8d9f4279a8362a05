#include "model/formats/arrays/amass_npz.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "model/core/error.h"
#include "model/core/grid.h"
#include "model/core/joined.h"
#include "model/core/numbers/quantile.h"
#include "model/core/rounded.h"
#include "model/core/text/printable.h"
#include "model/formats/arrays/joint_arrays.h"
#include "model/formats/arrays/own_arrays.h"
#include "model/formats/arrays/rotation_rows.h"
#include "model/formats/reading/motion_check.h"
#include "model/formats/reading/people.h"
#include "model/motion/pose/pose_limits.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr int kBodyJoints = 22;   // common to SMPL, SMPL-H and SMPL-X, in the same order
constexpr int kSmplHJoints = 52;  // AMASS: the body and 15 joints a hand
constexpr int kSmplXJoints = 55;  // and jaw and eyes between body and hands
constexpr int kBetas = 16;
constexpr double kNoBeta = 1e-6;

const Eigen::Matrix3d kYUpFromZUp{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};

/// One layout of SMPL's arrays.
struct Layout {
  const char* root;  ///< axis-angle of the pelvis; null if `body` has it
  const char* body;  ///< all joints, or all but the pelvis
  const char* trans;
};

// All layouts, in order of preference.
constexpr Layout kLayouts[] = {
    {nullptr, "poses", "trans"},
    {nullptr, "smpl_poses", "smpl_trans"},
    {"root_orient", "pose_body", "trans"},
    {"global_orient", "body_pose", "transl"},
    {"poses_root", "poses_body", "trans"},
    {nullptr, "fullpose", "transl"},
    {nullptr, "full_pose", "trans"},
    {nullptr, "pose_world", "trans_world"},
    {nullptr, "pose", "trans"},
    {nullptr, "thetas", "trans"},
    {nullptr, "q", "pos"},
};
// All names of the root's position.
constexpr const char* kTransNames[] = {"trans", "transl", "smpl_trans", "translation"};
constexpr const char* kRateNames[] = {"mocap_frame_rate", "mocap_framerate", "fps", "frame_rate",
                                      "framerate"};

std::optional<Layout> FindLayout(const NpzArchive& npz) {
  for (const Layout& layout : kLayouts) {
    if (!npz.Has(layout.body) || (layout.root != nullptr && !npz.Has(layout.root))) continue;
    Layout found = layout;
    for (const char* trans : kTransNames) {
      if (!npz.Has(found.trans) && npz.Has(trans)) found.trans = trans;
    }
    return found;
  }
  return std::nullopt;
}

// Names all layouts for messages.
std::string LayoutNames() {
  std::string names;
  for (const Layout& layout : kLayouts) {
    if (layout.root != nullptr) names += layout.root + std::string(" and ");
    names += layout.body + std::string(", ");
  }
  return names + "joints";
}

double ReadRate(const NpzArchive& npz, double otherwise, bool known, const MotionReading& reading) {
  std::string stated;
  double first = 0;
  bool differ = false;
  for (const char* name : kRateNames) {
    if (!npz.Has(name)) continue;
    double rate = 0;
    try {
      rate = NpzNumber(npz, name);
    } catch (const Error& error) {
      if (reading.fps > 0) continue;
      throw InvalidArgument(error.field(), std::string(error.Of("").what()) + "; --fps says one");
    }
    if (rate > 0) {
      stated += (stated.empty() ? "" : ", ") + std::string(name) + ' ' + Rounded(rate);
      if (first == 0) first = CheckRate(name, rate);
      differ = differ || std::abs(rate - first) > 0.001 * first;
    } else if (!(reading.fps > 0)) {
      throw InvalidArgument(name,
                            Rounded(rate) + " frames a second are impossible; --fps sets another");
    }
  }
  if (first > 0 && !differ) return first;
  if (reading.fps > 0) return reading.fps;
  if (differ)
    reading.Note("states " + stated + ": " + Rounded(first) +
                 " frames a second is used, --fps sets another");
  if (first > 0) return first;
  if (!known) reading.NoteRate(otherwise);
  return otherwise;
}

// Whether the arrays, or a nested dict's at most `depth` deep, are a motion.
bool HoldsMotion(const NpzArchive& npz, int depth) {
  return FindLayout(npz) ||
         (depth > 0 && std::ranges::any_of(npz.NestedNames(), [&](const std::string& name) {
            return HoldsMotion(npz.Nested(name), depth - 1);
          }));
}

// The name of the nested dict that holds a motion, or "". If several do, takes the one that --body
// names, and clears --body.
std::string DictWithin(const NpzArchive& npz, MotionReading* reading) {
  std::vector<std::string> holding;
  for (const std::string& name : npz.NestedNames()) {
    if (HoldsMotion(npz.Nested(name), 1)) holding.push_back(name);
  }
  if (holding.empty()) return "";
  if (holding.size() == 1) return holding[0];
  if (!reading->body.empty()) return holding[ChooseBody(std::exchange(reading->body, ""), holding)];
  // Tracks of people, but not several views of one, have numbers.
  if (std::ranges::all_of(holding, [](const std::string& name) {
        return NumberBelow(name, SIZE_MAX).has_value();
      })) {
    reading->Note("holds " + std::to_string(holding.size()) + " motions, " + ListBodies(holding) +
                  "; 0 is read, --body chooses");
    return holding[0];
  }
  throw InvalidArgument("", "holds " + std::to_string(holding.size()) + " motions, " +
                                ListBodies(holding) + ": choreo convert --body reads one");
}

// Poses in the file's axes, with the body's 22 joints or SMPL's 24.
Motion Assemble(const Eigen::MatrixXd& positions, const Eigen::MatrixXd& rotations, double fps,
                const std::string& key) {
  const int joints = Skeleton::Smpl24().joints();
  const int known = rotations.rows() == 3 * joints ? joints : kBodyJoints;
  Motion motion = MotionOfRows(positions, rotations.topRows(3 * known), joints, fps, key);
  CheckMotionLimits(motion);  // before the change of axes hides an absurd angle
  return motion;
}

bool IsSmplX(const NpzArchive& npz, Eigen::Index joints) {
  if (joints == kSmplXJoints || npz.Has("jaw_pose") || npz.Has("pose_jaw")) return true;
  try {
    return npz.Has("surface_model_type") && npz.Text("surface_model_type").starts_with("smplx");
  } catch (const Error&) {
    return false;  // not text: no information
  }
}

bool HasBetas(const NpzArchive& npz) {
  if (!npz.Has("betas")) return false;
  try {
    for (const double beta : npz.Array("betas").As<double>()) {
      if (std::abs(beta) > kNoBeta) return true;
    }
  } catch (const Error&) {
    // Unreadable kinds count as missing.
  }
  return false;
}

std::vector<int64_t> JointsOf(const Layout& layout) {
  if (layout.root != nullptr) return {21, 23};
  if (std::string_view(layout.body) == "smpl_poses") return {24};
  return {24, kSmplHJoints, kSmplXJoints, kBodyJoints};
}

// One person's arrays from arrays of several people.
NpzArchive PersonOf(const NpzArchive& npz, const Layout& layout, int64_t people, int64_t person) {
  NpzArchive one = npz;
  for (const char* key : {layout.root, layout.body, layout.trans}) {
    if (key == nullptr || !npz.Has(key)) continue;
    const NpyArray all = npz.Array(key);
    if (HoldsPeople(all, people)) one.SetArray(key, PersonOf(all, people, person));
  }
  return one;
}

// The rotations of a layout, radians [3 joints, frames].
Eigen::MatrixXd ReadTurns(const NpzArchive& npz, const Layout& layout,
                          const MotionReading& reading) {
  RotationRows all = ReadRotationRows(npz, layout.body, JointsOf(layout));
  if (layout.root != nullptr) {
    const Eigen::MatrixXd body = std::move(all.turns);
    const RotationRows root = ReadRotationRows(npz, layout.root, {1});
    if (root.turns.cols() != body.cols()) {
      throw InvalidArgument(layout.body, std::to_string(body.cols()) + " frames, but there are " +
                                             std::to_string(root.turns.cols()) + " of " +
                                             layout.root);
    }
    all.are_vectors = all.are_vectors && root.are_vectors;
    all.turns.resize(3 + body.rows(), body.cols());
    all.turns << root.turns, body;
  }
  ToRadians(layout.body, reading, &all);
  return std::move(all.turns);
}

// A dict of the archive, with the rate beside it.
NpzArchive NestedWithRate(const NpzArchive& npz, const std::string& within) {
  NpzArchive nested = npz.Nested(within);
  for (const char* rate : kRateNames) {
    if (npz.Has(rate) && !nested.Has(rate)) nested.SetArray(rate, npz.Array(rate));
  }
  return nested;
}

// The motion of one body.
Motion ReadLayout(const NpzArchive& npz, const Layout& layout, const MotionReading& reading) {
  reading.RefuseBody();
  if (std::string_view(layout.body) == "pose_world")
    reading.Note("its pose_world and trans_world are read, not what its camera saw");
  const bool aist = npz.Has("smpl_scaling"), slices = std::string_view(layout.body) == "q";
  const bool edge = std::string_view(layout.body) == "smpl_poses" && !aist;
  const Eigen::MatrixXd turns = ReadTurns(npz, layout, reading);
  Eigen::MatrixXd trans = Eigen::MatrixXd::Zero(3, turns.cols());
  if (npz.Has(layout.trans)) {
    trans = NpzRows(npz, layout.trans, {3});
  } else {
    reading.Note(std::string("has no ") + layout.trans + ": the body stays in its place");
  }
  const char* scale = slices ? "scale" : "smpl_scaling";
  if (npz.Has(scale)) {
    const double scaling = NpzNumber(npz, scale);
    if (!(scaling > 0)) throw InvalidArgument(scale, "must be above 0");
    trans /= scaling;
  }
  const double fps = ReadRate(npz, aist ? 60 : kModelFps, aist || edge, reading);
  FileMotion file{.skeleton = Skeleton::Smpl24(),
                  .motion = Assemble(trans, turns, fps, layout.body),
                  .other_shape = HasBetas(npz),
                  .has_angles = true};
  if (!aist && !slices) file.up = Eigen::Vector3d::UnitZ();
  if (!edge)
    file.root_offset = IsSmplX(npz, turns.rows() / 3) ? SmplXRestPelvis() : SmplRestPelvis();
  return CorrectMotion(std::move(file), reading);
}

}  // namespace

Eigen::Vector3d SmplRestPelvis() { return {-0.00179506, -0.22333382, 0.02821918}; }
Eigen::Vector3d SmplXRestPelvis() { return {0.00312326, -0.35140747, 0.01203655}; }

namespace {

/// The rotation vector that QuaternionFromExp converts to q itself, not -q. Its angle is in [0, 2
/// pi]. It follows q continuously, except through -1.
Eigen::Vector3d ExpWithSign(const Eigen::Quaterniond& q) {
  const double sine = q.vec().norm();
  if (sine < 1e-150) return Eigen::Vector3d::Zero();
  return (2.0 * std::atan2(sine, q.w()) / sine) * q.vec();
}

}  // namespace

Pose ToAmass(const Pose& pose) {
  const Eigen::Matrix3d z_up = kYUpFromZUp.transpose();
  Pose amass = pose;
  amass.root_position = z_up * pose.root_position - SmplRestPelvis();
  // Turning dancers stay away from that discontinuity, so importers see no jump, and no frame
  // depends on others.
  amass.rotations.col(0) =
      ExpWithSign(Eigen::Quaterniond(z_up) * QuaternionFromExp(pose.rotations.col(0)));
  return amass;
}

Motion ReadSmplMotion(const NpzArchive& npz, const MotionReading& reading) {
  // A file may hold AMASS's arrays beside ours, in other axes.
  const bool as_amass = (!reading.up.empty() || reading.scale > 0) && npz.Has("poses");
  if (npz.Has("rotations") && npz.Has("root_positions") && !as_amass) {
    reading.RefuseBody();
    Motion motion = ReadOwnArrays(Skeleton::Smpl24(), npz);
    CheckMotionLimits(motion);
    return motion;
  }
  if (const std::optional<Layout> layout = FindLayout(npz)) {
    const int64_t people = PeopleIn(npz.Array(layout->body), [&](int64_t width) {
      return AreRotations(width, JointsOf(*layout));
    });
    if (people <= 1) return ReadLayout(npz, *layout, reading);
    MotionReading inner = reading;
    const int64_t person = ChoosePerson(people, layout->body, reading);
    inner.body.clear();
    return ReadSmplMotion(PersonOf(npz, *layout, people, person), inner);
  }
  if (const auto joints = FindJointArray(npz))
    return ReadJointPlaces(*joints, ReadRate(npz, kModelFps, false, reading), reading);
  MotionReading inner = reading;
  if (const std::string within = DictWithin(npz, &inner); !within.empty()) {
    const NpzArchive nested = NestedWithRate(npz, within);
    reading.Note("the arrays of its \"" + Printable(within) + "\" are read");
    Motion motion = ReadSmplMotion(nested, inner);
    if (const size_t dicts = npz.NestedNames().size();
        dicts > 1 && motion.frames.size() == 1 && reading.body.empty()) {
      throw InvalidArgument(
          "", "holds " + std::to_string(dicts) +
                  " dicts of one frame each, in any order: --body reads one, or " + kWriteArrays);
    }
    return motion;
  }
  const std::string names = Joined(npz.Names());
  throw InvalidArgument("", "has no array of rotations by a name that is known, " + LayoutNames() +
                                " (it has: " + (names.empty() ? "nothing" : Printable(names)) +
                                "): " + kWriteArrays);
}

void AddSmplMotion(const Motion& motion, const std::vector<Contacts>* contacts, NpzArchive& npz) {
  AddOwnArrays(Skeleton::Smpl24(), motion, contacts, npz);
  const auto frames = static_cast<int64_t>(motion.frames.size());
  std::vector<double> trans, poses;
  for (const Pose& own : motion.frames) {
    const Pose pose = ToAmass(own);
    trans.insert(trans.end(), pose.root_position.begin(), pose.root_position.end());
    poses.insert(poses.end(), pose.rotations.data(), pose.rotations.data() + 3 * kBodyJoints);
    poses.resize(trans.size() * kSmplHJoints, 0.0);  // the hands at rest
  }
  npz.SetArray("trans", {{frames, 3}, std::move(trans)});
  npz.SetArray("poses", {{frames, 3 * kSmplHJoints}, std::move(poses)});
  // SMPL-H's files have the first name, SMPL-X's the second.
  for (const char* rate : {"mocap_framerate", "mocap_frame_rate"})
    npz.SetArray(rate, {{}, std::vector<double>{motion.fps}});
  npz.SetArray("betas", {{kBetas}, std::vector<double>(kBetas, 0.0)});
  npz.SetText("gender", "neutral");
}

}  // namespace choreo
