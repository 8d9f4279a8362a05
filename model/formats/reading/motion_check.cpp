#include "model/formats/reading/motion_check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "model/core/error.h"
#include "model/core/numbers/quantile.h"
#include "model/core/rounded.h"
#include "model/motion/floor/floor_clearance.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/pose/pose_faults.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

// A body stands if its trunk is within 45 degrees of the vertical (cosine).
constexpr double kStands = 0.7;
constexpr double kRuleShare = 0.9;  // share of frames that make a rule
// In fewer frames a body may be lying on purpose: a pose, a fall.
constexpr size_t kFewFrames = 10;
// A higher pelvis means another unit, metres.
constexpr double kTooHigh = 20;
constexpr double kOnFloor =
    0.25;  // metres: a joint this near is on the floor, as bodies are thick and differ
constexpr double kLying = 0.05;  // metres: height of a lying body's pelvis
constexpr double kLowPelvis = 0.3, kHighPelvis = 2;
// Metres. A body less far below the floor may be due to shoes or to the fit.
constexpr double kSunken = 0.05;
// No jump stays this high above the floor for so long: metres and seconds.
constexpr double kHangs = 0.15, kHangsFor = 2;
constexpr double kStill = 1e-4;      // metres and radians
constexpr double kFloorShare = 0.1;  // quantile of the lowest points that is the floor
constexpr double kSlack = 0.02;      // metres by which other bodies may differ

std::string Share(double share) {
  return std::to_string(static_cast<int>(std::lround(100 * share))) + " %";
}

std::string Metres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f m", metres);
  return text;
}

/// The vector from hips to shoulders in each frame, in the file's axes. Empty without these joints.
std::vector<Eigen::Vector3d> Trunks(const FileMotion& file) {
  const Skeleton& body = file.skeleton;
  std::vector<Eigen::Vector3d> trunks;
  for (const int joint : {body.left_hip, body.right_hip, body.left_shoulder, body.right_shoulder})
    if (joint < 0) return trunks;
  JointPlacement placement;
  for (const Pose& pose : file.motion.frames) {
    ForwardKinematics(body, pose, placement);
    const auto& places = placement.positions;
    const Eigen::Vector3d trunk = places.col(body.left_shoulder) + places.col(body.right_shoulder) -
                                  places.col(body.left_hip) - places.col(body.right_hip);
    trunks.push_back(trunk.normalized());
  }
  return trunks;
}

double ShareStanding(const std::vector<Eigen::Vector3d>& trunks, const Eigen::Vector3d& up) {
  const auto standing =
      std::ranges::count_if(trunks, [&](const auto& trunk) { return trunk.dot(up) > kStands; });
  return static_cast<double>(standing) / static_cast<double>(std::max<size_t>(1, trunks.size()));
}

/// The height along `up` of the lowest joint: the median over frames, or another quantile. 0 is the
/// file's floor.
double LowestAlong(const FileMotion& file, const Eigen::Vector3d& up, double share = 0.5) {
  std::vector<double> lowest;
  JointPlacement placement;
  for (const Pose& pose : file.motion.frames) {
    ForwardKinematics(file.skeleton, pose, placement);
    lowest.push_back((up.transpose() * placement.positions).minCoeff() + up.dot(file.root_offset));
  }
  return Quantile(std::move(lowest), share);
}

/// Whether, with this `up`, the body is on the file's floor and its pelvis above it.
bool IsOnFloor(const FileMotion& file, const Eigen::Vector3d& up) {
  std::vector<double> heights;
  for (const Pose& pose : file.motion.frames)
    heights.push_back(up.dot(pose.root_position + file.root_offset));
  return std::abs(LowestAlong(file, up)) < kOnFloor && Median(std::move(heights)) > kLying;
}

/// The axis other than `axis` on whose floor the body is. None if it is also on the floor of
/// `axis`.
std::optional<Eigen::Vector3d> FloorBeside(const FileMotion& file, const Eigen::Vector3d& axis) {
  if (IsOnFloor(file, file.up) || IsOnFloor(file, axis)) return std::nullopt;
  std::optional<Eigen::Vector3d> beside;
  for (const auto& other : {Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1),
                            Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(0, 0, -1)}) {
    if (other.dot(axis) != 0 || !IsOnFloor(file, other)) continue;
    if (!beside || std::abs(LowestAlong(file, other)) < std::abs(LowestAlong(file, *beside)))
      beside = other;
  }
  return beside;
}

/// The file's up axis, or the axis along which the body stands in nearly all frames.
Eigen::Vector3d FindUp(const FileMotion& file, const MotionReading& reading) {
  if (!reading.up.empty()) return ParseUp(reading.up);
  const std::vector<Eigen::Vector3d> trunks = Trunks(file);
  // A body may bend or lie for long, so its rest pose is better evidence of the up axis. The floor
  // is better than both.
  if (file.rest_up && *file.rest_up != file.up &&
      (ShareStanding(trunks, *file.rest_up) >= ShareStanding(trunks, file.up) ||
       (IsOnFloor(file, *file.rest_up) && !IsOnFloor(file, file.up)))) {
    reading.Note("read as " + UpName(*file.rest_up) + " up, not " + UpName(file.up) +
                 ", as its rest pose then stands; --up " + UpName(file.up) + " makes it lie");
    return *file.rest_up;
  }
  if (trunks.empty() || ShareStanding(trunks, file.up) > 1 - kRuleShare) return file.up;
  for (const auto& axis :
       {Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, -1),
        Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0)}) {
    const double share = ShareStanding(trunks, axis);
    if (share < kRuleShare) continue;
    const auto beside = axis == -file.up ? FloorBeside(file, axis) : std::nullopt;
    if (beside && trunks.size() >= kFewFrames) {
      reading.Note("read as " + UpName(*beside) + " up, not " + UpName(file.up) +
                   ", as its body lies on that floor; --up " + UpName(file.up) +
                   " stands it on its head");
      return *beside;
    }
    // A body that is on the file's floor if it lies, and in the air if it stands, is lying.
    const bool lies = std::abs(LowestAlong(file, file.up)) < kOnFloor &&
                      std::abs(LowestAlong(file, axis, 0)) > kOnFloor;
    if (lies || trunks.size() < kFewFrames || axis == -file.up) {
      reading.Note(std::string("its body ") + (axis == -file.up ? "stands on its head" : "lies") +
                   "; --up " + UpName(axis) + " stands it up, if it should stand");
      return file.up;
    }
    reading.Note("read as " + UpName(axis) + " up, not " + UpName(file.up) +
                 ", as its body then stands in " + Share(share) + " of the frames; --up " +
                 UpName(file.up) + " makes it lie");
    return axis;
  }
  return file.up;
}

void TurnUp(const Eigen::Vector3d& up, Motion* motion) {
  if (up == Eigen::Vector3d::UnitY()) return;
  const Eigen::Matrix3d turn = TurnToYUp(up);
  for (Pose& pose : motion->frames) {
    pose.root_position = turn * pose.root_position;
    pose.rotations.col(0) = LogMap(turn * ExpMap(pose.rotations.col(0)));
  }
}

double Unit(const Motion& motion, const MotionReading& reading) {
  if (reading.scale > 0) return reading.scale;
  std::vector<double> heights;
  for (const Pose& pose : motion.frames) heights.push_back(pose.root_position.y());
  const double height = Median(std::move(heights));
  if (!(std::abs(height) > kTooHigh)) return 1;
  for (const auto& [unit, name] : {std::pair(0.01, "centimetres"), std::pair(0.001, "millimetres"),
                                   std::pair(0.0254, "inches")}) {
    if (height * unit < kLowPelvis || height * unit > kHighPelvis) continue;
    reading.Note(std::string("its positions are read as ") + name + ", as the hips are " +
                 Rounded(height) + " high; --scale sets another unit");
    return unit;
  }
  reading.Note("the hips are " + Rounded(height) + " m high; --scale sets its unit");
  return 1;
}

void NoteStillness(const Motion& motion, const MotionReading& reading) {
  if (motion.frames.size() < 2) return;
  const Pose& first = motion.frames.front();
  for (const Pose& pose : motion.frames) {
    if ((pose.root_position - first.root_position).norm() > kStill ||
        (pose.rotations - first.rotations).cwiseAbs().maxCoeff() > kStill)
      return;
  }
  reading.Note("nothing moves in its " + std::to_string(motion.frames.size()) +
               " frames: is the movement in another animation or on other bones?");
}

void NoteBends(const FileMotion& file, const Motion& motion, const MotionReading& reading) {
  std::string example;
  const double share = ShareOfFaults(file.skeleton, motion, &example);
  if (share > 1 - kRuleShare) {
    reading.Note("in " + Share(share) + " of its frames a joint is bent as no body can, as in: " +
                 example + "; are its bones assigned correctly?" +
                 (file.has_angles ? " --angles sets the unit of its angles" : ""));
  }
}

// Moves a rig down or up as a whole, so that its lowest poses are on the floor; a dancer who is on
// a stage, or lifted, stays up. If the body reaches the file's floor, only poses near that floor
// count.
void PutOnFloor(const Skeleton& skeleton, const MotionReading& reading, Motion* motion) {
  std::vector<double> heights, hips;
  for (const Pose& pose : motion->frames) {
    heights.push_back(HeightAboveFloor(skeleton, pose));
    hips.push_back(pose.root_position.y());
  }
  if (std::abs(*std::ranges::min_element(heights)) < kHangs)
    std::erase_if(heights, [](double height) { return height > kHangs; });
  const double floor = Quantile(heights, kFloorShare), hip = Median(std::move(hips));
  for (Pose& pose : motion->frames) pose.root_position.y() -= floor;
  if (std::abs(floor) > kHangs && std::abs(hip) > kStill)
    reading.Note("moved by " + Metres(-floor) + " in height onto the floor");
}

// Moves the whole clip so that its floor is y = 0.
void FindFloor(const FileMotion& file, const MotionReading& reading, Motion* motion) {
  std::vector<double> heights;
  for (const Pose& pose : motion->frames) heights.push_back(HeightAboveFloor(file.skeleton, pose));
  const double floor = Quantile(heights, kFloorShare), highest_low = Quantile(heights, kRuleShare);
  const double lowest = *std::ranges::min_element(heights);
  const double seconds = static_cast<double>(heights.size()) / motion->fps;
  std::string why;
  if (file.other_shape && std::abs(floor) > kSlack && seconds >= kHangsFor / 4) {
    why = "its betas are another body's than ours";
  } else if (highest_low < -kSunken && heights.size() >= kFewFrames) {
    why = "its feet were under the floor";
  } else if (lowest > kHangs && seconds >= kHangsFor) {
    why = "it never touched the floor";
  } else {
    return;
  }
  for (Pose& pose : motion->frames) pose.root_position.y() -= floor;
  reading.Note("moved by " + Metres(-floor) + " in height onto the floor, as " + why);
}

}  // namespace

double ShareOfFaults(const Skeleton& skeleton, const Motion& motion, std::string* example) {
  size_t bent = 0;
  for (const Pose& pose : motion.frames) {
    const std::vector<std::string> faults = BendFaults(skeleton, pose);
    if (!faults.empty() && bent++ == 0 && example != nullptr) *example = faults.front();
  }
  return static_cast<double>(bent) / static_cast<double>(std::max<size_t>(1, motion.frames.size()));
}

Motion CorrectMotion(FileMotion file, const MotionReading& reading) {
  if (file.motion.frames.empty()) return std::move(file.motion);
  const Eigen::Vector3d up = FindUp(file, reading);
  Motion motion = file.motion;
  TurnUp(up, &motion);
  if (file.has_floor) {
    const double unit = Unit(motion, reading);
    const Eigen::Vector3d offset = TurnToYUp(up) * file.root_offset;
    for (Pose& pose : motion.frames) pose.root_position = unit * pose.root_position + offset;
    FindFloor(file, reading, &motion);
  } else {
    PutOnFloor(file.skeleton, reading, &motion);
  }
  MakeContinuous(motion);
  NoteStillness(motion, reading);
  NoteBends(file, motion, reading);
  return motion;
}

}  // namespace choreo
