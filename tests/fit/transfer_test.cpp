#include "model/fit/bones/transfer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "model/motion/floor/contacts.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/limb.h"
#include "model/motion/rotation.h"
#include "tests/fit/fit_fixtures.h"
#include "tests/support/proportions.h"

namespace choreo::transfer_test {

using fixtures::Rigged;
using testing_support::ChildBody;
using testing_support::LongLegs;

const Skeleton& Smpl() { return Skeleton::Smpl24(); }

// A dancer sways and bends the knees on standing feet, and claps in front of the chest.
Motion Clapping() {
  Motion motion{.fps = 30, .frames = {}};
  const std::array<Leg, 2> legs = Leg::Of(Smpl());
  const Eigen::Matrix3Xd rest = JointPositions(Smpl(), RestPose(Smpl()));
  for (int frame = 0; frame < 120; ++frame) {
    const double t = frame / 30.0;
    Pose pose = RestPose(Smpl());
    pose.root_position +=
        Eigen::Vector3d(0.5 + 0.12 * std::sin(3 * t), -0.12, 0.05 * std::cos(2 * t));
    pose.root_position.y() += 0.06 * std::cos(5 * t);
    pose.rotations.col(0) << 0.1, 0.4 * std::sin(2 * t), 0.05;
    pose.rotations.col(Smpl().Find("spine2")) << 0.2 * std::sin(t), 0.3 * std::sin(3 * t), 0;
    for (size_t side = 0; side < 2; ++side) {
      const Eigen::Vector3d toes = rest.col(legs[side].toes) + Eigen::Vector3d(0.5, 0, 0);
      PlaceToes(legs[side], Smpl(), ForwardKinematics(Smpl(), pose), toes, &pose);
    }
    // Hands come together and part.
    const double apart = 0.3 * (1 - std::cos(6 * t));
    for (const double out : {1.0, -1.0}) {
      const bool left = out > 0;
      const int shoulder = left ? Smpl().left_shoulder : Smpl().right_shoulder;
      const int elbow = left ? Smpl().left_elbow : Smpl().right_elbow;
      pose.rotations.col(shoulder) << 0, 0, -out;
      pose.rotations.col(elbow) << 0, -out, 0;
      const JointPlacement now = ForwardKinematics(Smpl(), pose);
      const int wrist = Smpl().Find(left ? "left_wrist" : "right_wrist");
      const Eigen::Vector3d goal = now.positions.col(Smpl().Find("spine3")) +
                                   now.rotations[static_cast<size_t>(Smpl().Find("spine3"))] *
                                       Eigen::Vector3d(out * (0.04 + apart / 2), 0.1, 0.3) -
                                   now.positions.col(shoulder);
      PlaceEnd({shoulder, elbow, wrist}, now.rotations[static_cast<size_t>(shoulder)].col(1) * -out,
               Smpl(), now, goal, &pose);
    }
    motion.frames.push_back(pose);
  }
  return motion;
}

// How far toes move while SMPL's stand, metres a second at the character's size; and the error in
// the distance of hands that are near each other, metres at that size.
struct Misses {
  double slide = 0, hands = 0;
};
Misses Measure(const Motion& smpl, const Skeleton& body, const Motion& danced) {
  const double size = CharacterSize(body);
  const std::vector<Contacts> contacts = DetectContacts(Smpl(), smpl);
  Misses misses;
  int standing = 0, near = 0;
  for (size_t frame = 1; frame < smpl.frames.size(); ++frame) {
    const Eigen::Matrix3Xd ours = JointPositions(Smpl(), smpl.frames[frame]);
    const Eigen::Matrix3Xd now = JointPositions(body, danced.frames[frame]);
    const Eigen::Matrix3Xd before = JointPositions(body, danced.frames[frame - 1]);
    for (const size_t side : {0, 1}) {
      if (contacts[frame][2 * side + 1] < 0.5F) continue;
      const int toes = body.feet[2 * side + 1];
      misses.slide += (now.col(toes) - before.col(toes)).norm() * smpl.fps / size;
      ++standing;
    }
    const auto apart = [](const Skeleton& skeleton, const Eigen::Matrix3Xd& places) {
      return (places.col(skeleton.Find("left_wrist")) - places.col(skeleton.Find("right_wrist")))
          .norm();
    };
    if (apart(Smpl(), ours) > 0.12) continue;
    misses.hands += std::abs(apart(body, now) / size - apart(Smpl(), ours));
    ++near;
  }
  EXPECT_GT(standing, 100);
  EXPECT_GT(near, 15);
  return {misses.slide / standing, misses.hands / near};
}

TEST(Transfer, FeetStandAndHandsMeetOnOtherProportions) {
  const Motion smpl = Clapping();
  const Misses danced = Measure(smpl, Smpl(), smpl);
  for (const auto& [name, body] : {std::pair("child", ChildBody()), std::pair("adult", Smpl()),
                                   std::pair("long legs", LongLegs())}) {
    const Skeleton character = Rigged(body, RestPose(body)).skeleton;
    const Motion copied = CopyTurns(smpl, character);
    const Misses before = Measure(smpl, character, copied);
    const Misses after = Measure(smpl, character, PlaceLimbs(smpl, character, copied));
    std::cout << name << ": SMPL's toes slide " << 100 * danced.slide << " cm/s, its "
              << 100 * before.slide << " cm/s, with limbs placed " << 100 * after.slide
              << "; hands " << 1000 * before.hands << " mm off, then " << 1000 * after.hands
              << "\n";
    EXPECT_LT(after.slide, danced.slide + 1e-4) << name;
    EXPECT_LT(after.hands, 0.012) << name;
    EXPECT_LE(after.slide, before.slide) << name;
  }
}

TEST(Transfer, AHandThatSwingsPastTheHipsDoesNotJerk) {
  Motion smpl{.fps = 30, .frames = {}};
  for (int frame = 0; frame < 60; ++frame) {
    Pose pose = RestPose(Smpl());
    const double swing = 1.2 * std::sin(0.35 * frame);
    for (const double out : {1.0, -1.0}) {
      const int shoulder = out > 0 ? Smpl().left_shoulder : Smpl().right_shoulder;
      const Eigen::Matrix3d hang = ExpMap({0, 0, -1.4 * out});
      pose.rotations.col(shoulder) = LogMap(ExpMap({-swing, 0, 0}) * hang);
      pose.rotations.col(out > 0 ? Smpl().left_elbow : Smpl().right_elbow) << 0, -0.5 * out, 0;
    }
    smpl.frames.push_back(pose);
  }
  const Skeleton character = Rigged(LongLegs(), RestPose(LongLegs())).skeleton;
  const Motion danced = TransferToCharacter(smpl, character);
  double moved = 0;
  for (size_t frame = 1; frame < danced.frames.size(); ++frame) {
    for (const int elbow : {character.left_elbow, character.right_elbow}) {
      const Eigen::Vector3d now = danced.frames[frame].rotations.col(elbow);
      EXPECT_LT(RotationDifference(danced.frames[frame - 1].rotations.col(elbow), now).norm(), 0.2)
          << frame;
      moved = std::max(moved, std::abs(now.norm() - 0.5));
    }
  }
  EXPECT_GT(moved, 0.02);  // they are drawn
}

TEST(Transfer, OnSmplsOwnBodyNothingChanges) {
  const Motion smpl = fixtures::SmoothMotion(Smpl(), 4, 40);
  const Skeleton character = Rigged(Smpl(), RestPose(Smpl())).skeleton;
  EXPECT_NEAR(CharacterSize(character), 1, 1e-9);
  const Motion danced = TransferToCharacter(smpl, character);
  for (size_t frame = 0; frame < smpl.frames.size(); ++frame) {
    const Eigen::Matrix3Xd ours = JointPositions(Smpl(), smpl.frames[frame]);
    const Eigen::Matrix3Xd theirs = JointPositions(character, danced.frames[frame]);
    for (int joint = 0; joint < character.joints(); ++joint) {
      const int same = Smpl().Find(character.joint_names[static_cast<size_t>(joint)]);
      EXPECT_LT((theirs.col(joint) - ours.col(same)).norm(), 0.01)
          << character.joint_names[static_cast<size_t>(joint)] << " in frame " << frame;
    }
  }
}

TEST(Transfer, OneSpineBoneBendsAsMuchAsThree) {
  Skeleton body;
  body.name = "short spine";
  for (int joint = 0; joint < Smpl().joints(); ++joint) {
    const std::string& name = Smpl().joint_names[static_cast<size_t>(joint)];
    if (name == "spine2" || name == "spine3" || name == "neck" || name.ends_with("collar"))
      continue;
    int parent = Smpl().parents[static_cast<size_t>(joint)];
    Eigen::Vector3d offset = Smpl().offsets.col(joint);
    while (parent >= 0 && body.Find(Smpl().joint_names[static_cast<size_t>(parent)]) < 0) {
      offset += Smpl().offsets.col(parent);
      parent = Smpl().parents[static_cast<size_t>(parent)];
    }
    body.AddJoint(
        name, parent < 0 ? -1 : body.Find(Smpl().joint_names[static_cast<size_t>(parent)]), offset);
  }
  body.AssignRoles();
  body.StandOnFloor();
  const Skeleton character = Rigged(body, RestPose(body)).skeleton;
  EXPECT_EQ(character.Find("spine2"), -1);
  const Motion smpl = fixtures::SmoothMotion(Smpl(), 9, 30);
  const Motion danced = CopyTurns(smpl, character);
  for (size_t frame = 0; frame < smpl.frames.size(); ++frame) {
    const JointPlacement ours = ForwardKinematics(Smpl(), smpl.frames[frame]);
    const JointPlacement theirs = ForwardKinematics(character, danced.frames[frame]);
    const auto turned = [&](const char* ours_name, const char* name) {
      return LogMap(ours.rotations[static_cast<size_t>(Smpl().Find(ours_name))].transpose() *
                    theirs.rotations[static_cast<size_t>(character.Find(name))])
          .norm();
    };
    EXPECT_LT(turned("spine3", "spine1"), 1e-9);
    EXPECT_LT(turned("head", "head"), 1e-9);
    EXPECT_LT(turned("left_elbow", "left_elbow"), 1e-9);
  }
}

}  // namespace choreo::transfer_test
