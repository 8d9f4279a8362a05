#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "client/choreo_client.h"

namespace choreo {

/// A dance of `frames` frames. Calls `between`, if any, when the first of them have come, and no
/// others may.
inline std::vector<Pose> DanceAround(const client::Client& client, const std::string& model,
                                     int64_t frames, const std::function<void()>& between = {}) {
  constexpr int64_t kFirst = 30;
  const auto dance =
      client.StartDance({.model = model, .seed = 1, .frames = frames, .generate_until = 0});
  dance->GenerateUntil(kFirst);
  std::vector<Pose> poses;
  while (const std::optional<client::Message> message = dance->Next()) {
    const auto* block = std::get_if<client::FrameBlock>(&*message);
    if (block == nullptr) continue;
    poses.insert(poses.end(), block->poses.begin(), block->poses.end());
    if (std::ssize(poses) != kFirst) continue;
    if (between) between();
    dance->CompleteKeys();
  }
  EXPECT_EQ(std::ssize(poses), frames);
  return poses;
}

inline void ExpectSamePoses(const std::vector<Pose>& poses, const std::vector<Pose>& wanted) {
  ASSERT_EQ(poses.size(), wanted.size());
  for (size_t i = 0; i < poses.size(); ++i) {
    ASSERT_EQ(poses[i].root_position, wanted[i].root_position) << i;
    ASSERT_EQ(poses[i].rotations, wanted[i].rotations) << i;
  }
}

}  // namespace choreo
