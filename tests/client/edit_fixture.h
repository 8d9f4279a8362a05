#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "model/formats/containers/npz.h"
#include "model/formats/motion_file.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/client/command_fixture.h"
#include "tests/client/test_music.h"

namespace choreo {

/// Largest acceleration of a joint at a frame, m/s^2; past the end the dance begins again.
inline double AccelerationAt(const Motion& motion, size_t frame) {
  const size_t count = motion.frames.size();
  const auto joints = [&](size_t at) {
    return JointPositions(Skeleton::Smpl24(), motion.frames[at % count]);
  };
  const Eigen::Matrix3Xd second = joints(frame + count - 1) - 2 * joints(frame) + joints(frame + 1);
  return second.colwise().norm().maxCoeff() * motion.fps * motion.fps;
}

inline double LargestAcceleration(const Motion& motion, size_t first, size_t last) {
  double largest = 0;
  for (size_t frame = first; frame <= last; ++frame)
    largest = std::max(largest, AccelerationAt(motion, frame));
  return largest;
}

/// Rows of an array in two files that differ in any bit: the first, and the one after the last.
inline std::pair<size_t, size_t> ChangedRows(const std::filesystem::path& a,
                                             const std::filesystem::path& b,
                                             const std::string& key) {
  const NpyArray left = NpzArchive::Read(a).Array(key);
  const NpyArray right = NpzArchive::Read(b).Array(key);
  EXPECT_EQ(left.shape, right.shape) << key;
  const auto rows = static_cast<size_t>(left.shape[0]);
  const auto x = left.As<double>();
  const auto y = right.As<double>();
  const size_t width = x.size() / rows;
  size_t first = rows;
  size_t end = 0;
  for (size_t row = 0; row < rows; ++row) {
    if (std::memcmp(&x[row * width], &y[row * width], width * sizeof(double)) == 0) continue;
    first = std::min(first, row);
    end = row + 1;
  }
  return {first, end};
}

/// `choreo edit` on dance.npz, which has its keys at the frames keys_.
class EditTest : public CommandTest {
 protected:
  void SetUp() override {
    WriteClicks(folder_ / "song.wav", 10);
    const Outcome outcome = Choreo("dance " + At("song.wav") + Server() + "--seed 3 -o " +
                                   At("dance.npz") + " --report " + At("report.json"));
    ASSERT_EQ(outcome.code, 0) << outcome.said;
    const nlohmann::json report = ReadJson(folder_ / "report.json");
    for (const auto& key : report["keyframes"]) keys_.push_back(key["frame"]);
    ASSERT_GE(keys_.size(), 4U);
  }

  Outcome Edit(const std::string& arguments) {
    return Choreo("edit " + At("dance.npz") + Server() + arguments);
  }
  Motion Read(const std::string& name) const {
    return ReadMotion(folder_ / name, Skeleton::Smpl24());
  }
  static std::string Seconds(size_t frame) {
    return std::to_string(static_cast<double>(frame) / 30);
  }

  /// Every array of the file differs in these frames and in no other.
  void ExpectChanged(const std::string& name, size_t first, size_t end) {
    for (const char* key : {"rotations", "root_positions", "poses", "trans"}) {
      EXPECT_EQ(ChangedRows(folder_ / "dance.npz", folder_ / name, key), std::pair(first, end))
          << key;
    }
    const auto contacts = ChangedRows(folder_ / "dance.npz", folder_ / name, "contacts");
    EXPECT_GE(contacts.first, first);
    EXPECT_LE(contacts.second, end);
  }

  std::vector<size_t> keys_;
};

}  // namespace choreo
