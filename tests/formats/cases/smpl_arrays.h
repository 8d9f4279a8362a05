#pragma once

#include <functional>
#include <vector>

#include "model/core/files/npy.h"
#include "model/formats/arrays/amass_npz.h"
#include "tests/formats/cases/cases.h"

namespace choreo::cases_test {

/// A body that steps, in SMPL's terms, by 20 frames; Z up as AMASS has it.
struct SmplArrays {
  Motion motion;  ///< ours
  std::vector<double> root, body, trans;

  explicit SmplArrays(int frames = 20) {
    motion.fps = 30;
    for (int frame = 0; frame < frames; ++frame) {
      Pose pose = RestPose(kSmpl);
      pose.root_position.x() = 0.05 * frame;
      pose.rotations.col(kSmpl.left_hip) << -0.02 * frame, 0, 0;
      pose.rotations.col(kSmpl.left_knee) << 0.03 * frame, 0, 0.1;
      pose.rotations.col(kSmpl.Find("head")) << 0, 0.5, 0.2;
      motion.frames.push_back(pose);
      const Pose amass = ToAmass(pose);
      root.insert(root.end(), amass.rotations.data(), amass.rotations.data() + 3);
      body.insert(body.end(), amass.rotations.data() + 3, amass.rotations.data() + 66);
      trans.insert(trans.end(), amass.root_position.begin(), amass.root_position.end());
    }
  }
  int64_t frames() const { return std::ssize(motion.frames); }
  NpyArray Root() const { return {{frames(), 3}, root}; }
  NpyArray Body() const { return {{frames(), 63}, body}; }
  NpyArray Trans() const { return {{frames(), 3}, trans}; }
  // All 22 joints, `width` values each, as `state` has a rotation vector.
  std::vector<double> All(const std::function<std::vector<double>(Eigen::Vector3d)>& state,
                          int joints) const {
    std::vector<double> all;
    for (int64_t frame = 0; frame < frames(); ++frame) {
      for (int joint = 0; joint < joints; ++joint) {
        Eigen::Vector3d turn = Eigen::Vector3d::Zero();
        if (joint == 0)
          turn = Eigen::Map<const Eigen::Vector3d>(&root[3 * static_cast<size_t>(frame)]);
        if (joint > 0 && joint < 22) {
          turn = Eigen::Map<const Eigen::Vector3d>(
              &body[static_cast<size_t>(63 * frame + 3 * (joint - 1))]);
        }
        const std::vector<double> values = state(turn);
        all.insert(all.end(), values.begin(), values.end());
      }
    }
    return all;
  }
};

// What arrays have of a rotation vector: a matrix, its first rows, its first columns, itself.
inline std::vector<double> AsMatrix(const Eigen::Vector3d& turn) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> m = ExpMap(turn);
  return {m.data(), m.data() + 9};
}
inline std::vector<double> AsRows(const Eigen::Vector3d& turn) {
  std::vector<double> m = AsMatrix(turn);
  m.resize(6);
  return m;
}
inline std::vector<double> AsColumns(const Eigen::Vector3d& turn) {
  const auto six = SixDFromMatrix(ExpMap(turn));
  return {six.begin(), six.end()};
}
inline std::vector<double> AsVector(const Eigen::Vector3d& turn) {
  return {turn.begin(), turn.end()};
}

}  // namespace choreo::cases_test
