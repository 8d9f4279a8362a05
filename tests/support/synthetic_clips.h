#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "model/motion/floor/contacts.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/skeleton.h"
#include "model/training/clips/prepared_clip.h"

namespace choreo::testing_support {

/// A synthetic clip: a dancer walks in a circle and swings the limbs, each joint at its own rate.
inline PreparedClip SyntheticClip(const std::string& name, int frames, double phase, bool music,
                                  const Skeleton& skeleton = Skeleton::Smpl24()) {
  PreparedClip clip;
  clip.name = name;
  clip.skeleton = skeleton;
  clip.source = "synthetic";
  clip.motion.fps = 30;
  for (int f = 0; f < frames; ++f) {
    const double t = f / 30.0;
    Pose pose = RestPose(skeleton);
    pose.root_position += Eigen::Vector3d(std::sin(0.5 * t + phase), 0.02 * std::sin(3 * t),
                                          std::cos(0.5 * t + phase));
    for (int j = 0; j < skeleton.joints(); ++j) {
      for (int axis = 0; axis < 3; ++axis) {
        pose.rotations(axis, j) = 0.25 * std::sin((1 + 0.1 * j) * t + phase + axis);
      }
    }
    clip.motion.frames.push_back(pose);
  }
  const std::vector<Contacts> contacts = DetectContacts(skeleton, clip.motion);
  clip.contacts.resize(4, frames);
  for (int f = 0; f < frames; ++f) {
    for (int foot = 0; foot < 4; ++foot) {
      clip.contacts(foot, f) = contacts[static_cast<size_t>(f)][static_cast<size_t>(foot)];
    }
  }
  if (music) {
    clip.audio.resize(40, frames);
    for (int f = 0; f < frames; ++f) {
      for (int i = 0; i < 40; ++i) {
        const double beat = f % 15 < 2 ? 4 : 0;  // two audible beats a second
        clip.audio(i, f) = static_cast<float>(0.1 * std::sin(0.3 * f + i) + beat);
      }
    }
  }
  return clip;
}

/// Writes seven synthetic clips, five for training (two with music), one for validation and one for
/// testing, and their splits.json.
inline void WriteSyntheticData(const std::filesystem::path& folder,
                               const Skeleton& skeleton = Skeleton::Smpl24()) {
  std::filesystem::create_directories(folder);
  const auto write = [&](const std::string& name, double phase, bool music) {
    WritePreparedClip(folder, SyntheticClip(name, 120, phase, music, skeleton));
  };
  for (int i = 0; i < 5; ++i) write("train_" + std::to_string(i), i, i < 2);
  write("held_out", 0.5, true);
  write("last", 0.7, false);
  std::ofstream(folder / "splits.json")
      << R"({"synthetic": {"train": ["train_0", "train_1"], "validation": ["held_out"], "test": ["last"]}})";
}

}  // namespace choreo::testing_support
