#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "model/fit/bones/transfer.h"
#include "model/formats/gltf/character_file.h"
#include "model/formats/gltf/gltf_scene.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/motion/motion_fixtures.h"
#include "tests/support/character_rigs.h"
#include "tests/support/glb_parts.h"
#include "tests/support/temporary_folder.h"

namespace choreo {

/// Characters that dance, in a folder of their own.
class CharacterTest : public testing::Test {
 protected:
  // What the character `glb` of this folder dances, written as out.glb.
  CharacterBody Dance(const std::string& glb, RootMotion root = RootMotion::kPelvis) {
    const CharacterFile file(folder_ / glb);
    CharacterBody body = MakeCharacterBody(file.FindBones(), file.places());
    file.WriteDance(folder_ / "out.glb", body, TransferToCharacter(smpl_, body.skeleton), {}, root);
    return body;
  }

  // The same after `change`.
  CharacterBody DanceChanged(const std::function<void(testing_support::Glb&)>& change,
                             const testing_support::CharacterRig& rig = {}) {
    testing_support::WriteCharacter(folder_ / "hero.glb", rig);
    testing_support::Glb glb(folder_ / "hero.glb");
    change(glb);
    glb.Write(folder_ / "changed.glb");
    return Dance("changed.glb");
  }

  // The largest angle, degrees, between a limb's bone in out.glb and in the dance; of the trunk,
  // between the ways across the hips and the shoulders.
  double WorstDirection() const {
    const GltfScene scene = ReadGltfScene(folder_ / "out.glb");
    const HumanBones bones = FindHumanBones(scene.nodes.names);
    EXPECT_EQ(scene.frames, std::ssize(smpl_.frames));
    EXPECT_EQ(scene.fps, smpl_.fps);
    double worst = 0;
    for (int64_t frame = 0; frame < scene.frames; ++frame) {
      const std::vector<Eigen::Affine3d> now = scene.Frame(frame);
      const Eigen::Matrix3Xd ours =
          JointPositions(Skeleton::Smpl24(), smpl_.frames[static_cast<size_t>(frame)]);
      for (const auto& [from, to] : kBones) {
        const auto at = [&](const char* bone) -> Eigen::Vector3d {
          return now[static_cast<size_t>(bones.Find(bone))].translation();
        };
        const Eigen::Vector3d a = at(to) - at(from);
        const Eigen::Vector3d b =
            ours.col(Skeleton::Smpl24().Find(to)) - ours.col(Skeleton::Smpl24().Find(from));
        worst = std::max(worst, std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi);
      }
    }
    return worst;
  }

  static constexpr std::pair<const char*, const char*> kBones[] = {
      {"left_hip", "left_knee"},         {"left_knee", "left_ankle"},
      {"right_hip", "right_knee"},       {"right_knee", "right_ankle"},
      {"left_shoulder", "left_elbow"},   {"left_elbow", "left_wrist"},
      {"right_shoulder", "right_elbow"}, {"right_elbow", "right_wrist"},
      {"right_hip", "left_hip"},         {"right_shoulder", "left_shoulder"}};

  TemporaryFolder folder_;
  // Arms keep away from the body: hands that touch are drawn elsewhere.
  const Motion smpl_ = [] {
    Motion motion = fixtures::SmoothMotion(Skeleton::Smpl24(), 12, 30, 30);
    for (Pose& pose : motion.frames) {
      for (const int shoulder :
           {Skeleton::Smpl24().left_shoulder, Skeleton::Smpl24().right_shoulder})
        pose.rotations.col(shoulder) *= 0.3;
    }
    return motion;
  }();
};

}  // namespace choreo
