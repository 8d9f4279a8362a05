#pragma once

#include <Eigen/Core>
#include <cmath>
#include <random>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Made-up motion for the tests of this folder.
namespace choreo::fixtures {

inline Eigen::Vector3d RandomVector(std::mt19937& generator, double scale) {
  std::uniform_real_distribution<double> uniform(-scale, scale);
  // One statement a draw: the order of evaluation inside a call is not fixed.
  const double x = uniform(generator);
  const double y = uniform(generator);
  const double z = uniform(generator);
  return {x, y, z};
}

inline Pose RandomPose(const Skeleton& skeleton, std::mt19937& generator, double scale = 1.0) {
  Pose pose;
  pose.root_position = RandomVector(generator, 2.0);
  pose.rotations.resize(3, skeleton.joints());
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    pose.rotations.col(joint) = RandomVector(generator, scale);
  }
  return pose;
}

/// A smooth, possible motion: each joint swings by three slow sines of random phase; knees and
/// elbows bend only about their hinge, the right way; the dancer turns and wanders.
inline Motion SmoothMotion(const Skeleton& skeleton, uint32_t seed, int frames, double fps = 30) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  struct Wave {
    Eigen::Vector3d amplitude, frequency, phase;
  };
  std::vector<Wave> waves;
  for (int joint = 0; joint <= skeleton.joints(); ++joint) {
    Wave wave;
    for (int axis = 0; axis < 3; ++axis) {
      wave.amplitude[axis] = 0.15 + 0.35 * uniform(generator);
      wave.frequency[axis] = 0.2 + 0.5 * uniform(generator);
      wave.phase[axis] = 2 * M_PI * uniform(generator);
    }
    waves.push_back(wave);
  }
  Motion motion;
  motion.fps = fps;
  for (int frame = 0; frame < frames; ++frame) {
    const double time = frame / fps;
    const auto swing = [&](int wave) -> Eigen::Vector3d {
      const Wave& w = waves[wave];
      return (w.amplitude.array() * (2 * M_PI * time * w.frequency + w.phase).array().sin())
          .matrix();
    };
    Pose pose;
    pose.rotations.resize(3, skeleton.joints());
    for (int joint = 0; joint < skeleton.joints(); ++joint)
      pose.rotations.col(joint) = swing(joint);
    pose.rotations.col(0) =
        Eigen::Vector3d(0, 0.8 * time + 0.5 * std::sin(time), 0) + 0.2 * swing(0);
    const auto bend = [&](int joint, const Eigen::Vector3d& axis) {
      if (joint >= 0) pose.rotations.col(joint) = axis * (0.8 + 1.2 * swing(joint).x());
    };
    bend(skeleton.left_knee, Eigen::Vector3d::UnitX());
    bend(skeleton.right_knee, Eigen::Vector3d::UnitX());
    bend(skeleton.left_elbow, -Eigen::Vector3d::UnitY());
    bend(skeleton.right_elbow, Eigen::Vector3d::UnitY());
    pose.root_position = Eigen::Vector3d(0.5 * time, skeleton.pelvis_height - 0.1, 0) +
                         swing(skeleton.joints()).cwiseProduct(Eigen::Vector3d(1, 0.1, 1));
    motion.frames.push_back(pose);
  }
  return motion;
}

/// SMPL's skeleton with the right side made the mirror image of the left one.
inline Skeleton SymmetricSmpl() {
  Skeleton skeleton = Skeleton::Smpl24();
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    const std::string& name = skeleton.joint_names[joint];
    if (name.starts_with("left_")) {
      Eigen::Vector3d offset = skeleton.offsets.col(joint);
      offset.x() = -offset.x();
      skeleton.offsets.col(skeleton.Find("right_" + name.substr(5))) = offset;
    } else if (!name.starts_with("right_")) {
      skeleton.offsets(0, joint) = 0;
    }
  }
  return skeleton;
}

}  // namespace choreo::fixtures
