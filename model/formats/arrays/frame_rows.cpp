#include "model/formats/arrays/frame_rows.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "model/core/error.h"
#include "model/core/rounded.h"
#include "model/formats/arrays/amass_npz.h"
#include "model/formats/arrays/joint_arrays.h"
#include "model/formats/arrays/own_arrays.h"
#include "model/formats/arrays/rotation_rows.h"
#include "model/formats/reading/motion_check.h"
#include "model/formats/reading/people.h"
#include "model/motion/pose/pose_limits.h"

namespace choreo {
namespace {

enum class Place : uint8_t { kPelvis, kSmpl, kSmplX };  // the point of the body at a row's position

struct Kind {
  int64_t width;
  const char* of;
  double fps;
  int64_t place, turns;  ///< first columns
  int64_t joints, each;  ///< values of a rotation
  Place root;
  bool z_up = false;
  int64_t betas = 0;  ///< first of ten columns, or 0
};

constexpr Kind kKinds[] = {
    {135, "LODGE", 30, 0, 3, 22, 6, Place::kSmplX},
    {139, "LODGE", 30, 4, 7, 22, 6, Place::kSmplX},
    {151, "EDGE", 30, 4, 7, 24, 6, Place::kPelvis, true},
    {219, "AIST++", 60, 0, 3, 24, 9, Place::kSmpl},
    {225, "AIST++", 60, 6, 9, 24, 9, Place::kSmpl},
    {315, "FineDance", 30, 0, 3, 52, 6, Place::kSmplX},
    {319, "FineDance", 30, 4, 7, 52, 6, Place::kSmplX},
    {322, "Motion-X", 30, 309, 0, 22, 3, Place::kSmplX, false, 312},
};
constexpr int64_t kHumanMl = 263, kRowJoints = 22;
constexpr double kHumanMlRate = 20;

const Kind* FindKind(int64_t width) {
  const auto found = std::ranges::find(kKinds, width, &Kind::width);
  return found == std::end(kKinds) ? nullptr : found;
}

double Rate(int64_t width, const char* of, double fps, const MotionReading& reading) {
  const double rate = reading.fps > 0 ? reading.fps : fps;
  reading.Note(std::string("read as ") + of + "'s " + std::to_string(width) +
               " numbers a frame, at " + Rounded(rate) + " frames a second" +
               (reading.fps > 0 ? "" : "; --fps sets another"));
  return rate;
}

using Rows = Eigen::Map<const Eigen::MatrixXd>;  // [width, frames]

Motion ReadKind(const Kind& kind, const Rows& rows, const MotionReading& reading) {
  // Copies the rotations to an array of their own, so that rotation_rows.h can parse it.
  NpzArchive npz;
  const Eigen::MatrixXd stated = rows.middleRows(kind.turns, kind.joints * kind.each);
  const std::string key = "[:, " + std::to_string(kind.turns) + ":]";
  npz.SetArray(key, {{rows.cols(), kind.joints, kind.each},
                     std::vector<double>(stated.data(), stated.data() + stated.size())});
  RotationRows stated_turns = ReadRotationRows(npz, key, {kind.joints});
  ToRadians(key, reading, &stated_turns);
  const int joints = Skeleton::Smpl24().joints();
  const Eigen::Index known = 3 * std::min<int64_t>(kind.joints == 24 ? 24 : kRowJoints, joints);
  FileMotion file{
      .skeleton = Skeleton::Smpl24(),
      .motion = MotionOfRows(rows.middleRows<3>(kind.place), stated_turns.turns.topRows(known),
                             joints, Rate(kind.width, kind.of, kind.fps, reading), key)};
  CheckMotionLimits(file.motion);
  if (kind.z_up) file.up = Eigen::Vector3d::UnitZ();
  if (kind.root != Place::kPelvis)
    file.root_offset = kind.root == Place::kSmplX ? SmplXRestPelvis() : SmplRestPelvis();
  file.other_shape = kind.betas > 0 && !rows.middleRows<10>(kind.betas).isZero();
  return CorrectMotion(std::move(file), reading);
}

// Guo et al. 2022: half the root's turn about Y, its travel in its own frame, its height, then the
// other joints relative to it.
Motion ReadHumanMl(const Rows& rows, const MotionReading& reading) {
  NpyArray places{{rows.cols(), kRowJoints, 3}, {}};
  std::vector<double> values;
  double half = 0;
  Eigen::Vector3d root = Eigen::Vector3d::Zero();
  for (Eigen::Index frame = 0; frame < rows.cols(); ++frame) {
    if (frame > 0) half += rows(0, frame - 1);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(-2 * half, Eigen::Vector3d::UnitY()).toRotationMatrix();
    if (frame > 0) root += turn * Eigen::Vector3d(rows(1, frame - 1), 0, rows(2, frame - 1));
    root.y() = rows(3, frame);
    values.insert(values.end(), root.begin(), root.end());
    for (int64_t joint = 1; joint < kRowJoints; ++joint) {
      const Eigen::Vector3d seen = rows.col(frame).segment<3>(4 + 3 * (joint - 1));
      const Eigen::Vector3d place = Eigen::Vector3d(root.x(), 0, root.z()) + turn * seen;
      values.insert(values.end(), place.begin(), place.end());
    }
  }
  places.values = std::move(values);
  if (!AreJointPlaces(places)) {
    throw InvalidArgument("",
                          "has 263 numbers a frame as HumanML3D's, but its limbs would not keep "
                          "their lengths: are they normalised? Multiply by its Std.npy and add "
                          "its Mean.npy");
  }
  return ReadJointPlaces(places, Rate(kHumanMl, "HumanML3D", kHumanMlRate, reading), reading);
}

}  // namespace

std::optional<Motion> ReadFrameRows(const NpyArray& array, const MotionReading& reading) {
  const auto is_frame = [](int64_t width) {
    return width == kHumanMl || FindKind(width) != nullptr;
  };
  if (array.shape.size() < 2 || array.shape.size() > 3 || !is_frame(array.shape.back()))
    return std::nullopt;
  if (const int64_t people = PeopleIn(array, is_frame); people > 1) {
    MotionReading inner = reading;
    inner.body.clear();
    return ReadFrameRows(PersonOf(array, people, ChoosePerson(people, "rows", reading)), inner);
  }
  reading.RefuseBody();
  const int64_t width = array.shape.back();
  const std::vector<double> values = array.As<double>();
  const Rows rows(values.data(), width, static_cast<Eigen::Index>(values.size()) / width);
  RequireFinite(rows, "");
  return width == kHumanMl ? ReadHumanMl(rows, reading) : ReadKind(*FindKind(width), rows, reading);
}

std::string FrameRowWidths() {
  std::string text;
  for (const Kind& kind : kKinds) text += std::to_string(kind.width) + ", ";
  return text + std::to_string(kHumanMl);
}

}  // namespace choreo
