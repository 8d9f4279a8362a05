#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "model/core/files/atomic_file.h"
#include "model/formats/containers/npz.h"
#include "model/formats/motion_file.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/support/rig_files.h"
#include "tests/support/temporary_folder.h"

/// Files as people bring them. Each row has a file made here, the options to read it, and the right
/// result.
namespace choreo::cases_test {

using namespace testing_support;

inline const Skeleton& kSmpl = Skeleton::Smpl24();

struct Read {
  Motion motion;
  std::vector<std::string> notes;
  bool Says(const std::string& part) const {
    return std::ranges::any_of(notes, [&](const std::string& note) {
      return note.find(part) != std::string::npos && note.find('\n') == std::string::npos;
    });
  }
};

inline std::string Said(const Read& read) {
  std::string all;
  for (const std::string& note : read.notes) all += "\n  " + note;
  return all;
}

class CasesTest : public testing::Test {
 protected:
  Read ReadFile(const std::string& name, MotionReading reading = {}) const {
    Read read;
    reading.notes = &read.notes;
    read.motion = ReadMotion(folder_ / name, kSmpl, OtherSkeleton::kRetarget, reading);
    return read;
  }
  Read ReadBytes(const std::string& name, const std::string& bytes,
                 const MotionReading& reading = {}) const {
    WriteFile(folder_ / name, bytes);
    return ReadFile(name, reading);
  }
  Read ReadNpz(const NpzArchive& npz, const MotionReading& reading = {}) const {
    npz.Write(folder_ / "a.npz");
    return ReadFile("a.npz", reading);
  }

  TemporaryFolder folder_;
};

inline double WorstJoint(const Motion& a, const Motion& b) {
  EXPECT_EQ(a.frames.size(), b.frames.size());
  double worst = 0;
  for (size_t i = 0; i < std::min(a.frames.size(), b.frames.size()); ++i) {
    worst =
        std::max(worst, (JointPositions(kSmpl, a.frames[i]) - JointPositions(kSmpl, b.frames[i]))
                            .colwise()
                            .norm()
                            .maxCoeff());
  }
  return worst;
}

inline double Degrees(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return LogMap(a.transpose() * b).norm() * kDegrees;
}

inline double Degrees(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * kDegrees;
}

/// How far a motion is from what the rig did, degrees: limbs' directions, and how head, chest,
/// pelvis, hands and feet are turned in the world since rest.
struct Wrong {
  double limbs = 0, turns = 0;
  std::string where;
};
inline Wrong Compare(const Motion& motion, const RigTurn& turn, int step = 1) {
  Wrong wrong;
  for (size_t frame = 0; frame < motion.frames.size(); ++frame) {
    const JointPlacement ours = ForwardKinematics(kSmpl, motion.frames[frame]);
    const RigState theirs = MoveRig(turn, static_cast<int>(frame) * step);
    for (const std::string side : {"left_", "right_"}) {
      for (const auto& [from, to] : {std::pair("hip", "knee"), std::pair("knee", "ankle"),
                                     std::pair("shoulder", "elbow"), std::pair("elbow", "wrist")}) {
        const double angle = Degrees(Eigen::Vector3d(ours.positions.col(kSmpl.Find(side + to)) -
                                                     ours.positions.col(kSmpl.Find(side + from))),
                                     Eigen::Vector3d(theirs.places.col(RigIndex(side + to)) -
                                                     theirs.places.col(RigIndex(side + from))));
        wrong.limbs = std::max(wrong.limbs, angle);
      }
    }
    for (const auto& [joint, bone] :
         {std::pair("head", "head"), std::pair("spine3", "spine3"), std::pair("pelvis", "pelvis"),
          std::pair("left_wrist", "left_wrist"), std::pair("right_wrist", "right_wrist"),
          std::pair("left_ankle", "left_ankle"), std::pair("right_ankle", "right_ankle")}) {
      const double angle = Degrees(ours.rotations[static_cast<size_t>(kSmpl.Find(joint))],
                                   theirs.turns[static_cast<size_t>(RigIndex(bone))]);
      if (angle > wrong.turns) wrong.turns = angle, wrong.where = joint;
    }
  }
  return wrong;
}

/// The MotionReading of these options of `choreo convert`.
inline MotionReading Options(const std::string& words) {
  MotionReading reading;
  std::istringstream stream(words);
  for (std::string option, value; stream >> option >> value;) {
    if (option == "--up") reading.up = value;
    if (option == "--fps") reading.fps = std::stod(value);
    if (option == "--animation") reading.animation = value;
    if (option == "--angles") reading.angles = value;
  }
  return reading;
}

// What rest poses leave open: SMPL's forearms do not point straight out to the sides.
inline constexpr double kOpen = 5;

// A head that looks aside, a hand that is rolled, a forearm that is twisted, a chest that leans, a
// foot that is turned: rotations that positions do not determine.
inline Eigen::Matrix3d Expressive(const std::string& bone, int frame) {
  if (bone == "head") return About(0, 1, 0, 60);
  if (bone == "left_wrist") return About(1, 0, 0, 90);
  if (bone == "right_elbow") return About(0, 1, 0, 30) * About(1, 0, 0, -70);
  if (bone == "spine3") return About(1, 0, 0, 20);
  if (bone == "left_ankle") return About(0, 1, 0, 25);
  return Walk(bone, frame);
}

}  // namespace choreo::cases_test
