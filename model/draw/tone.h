#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "model/body/colour.h"
#include "model/body/lanes.h"
#include "model/core/numbers/smooth_step.h"

namespace choreo {

inline Eigen::Vector3f Linear(const Colour& colour) {
  const auto linear = [](double value) { return static_cast<float>(std::pow(value, 2.2)); };
  return {linear(colour.r), linear(colour.g), linear(colour.b)};
}

inline float SmoothStep(float from, float to, float value) {
  const float t = std::clamp((value - from) / (to - from), 0.0f, 1.0f);
  return SmoothStep(t);
}

/// Converts linear light to sRGB bytes.
class Tone {
 public:
  /// Writes pixels; clips values to [0, 1].
  void Put(const Lanes& linear, uint8_t* rgb) const {
    typedef int Whole __attribute__((vector_size(sizeof(Lane))));
    int channel = 0;
    for (const Lane& values : {linear.x, linear.y, linear.z}) {
      const Whole step = __builtin_convertvector(Within01(values) * kSteps + 0.5f, Whole);
      for (int lane = 0; lane < kLanes; ++lane) rgb[3 * lane + channel] = bytes_[step[lane]];
      ++channel;
    }
  }
  void Put(const Eigen::Vector3f& linear, uint8_t* rgb) const {
    for (int i = 0; i < 3; ++i)
      rgb[i] = bytes_[static_cast<size_t>(std::clamp(linear[i], 0.0f, 1.0f) * kSteps + 0.5f)];
  }

 private:
  // Fine enough for the steep dark end, where a table step is less than one byte step.
  static constexpr int kSteps = 1 << 15;
  static std::vector<uint8_t> Bytes() {
    std::vector<uint8_t> made;
    for (int i = 0; i <= kSteps; ++i)
      made.push_back(
          static_cast<uint8_t>(std::lround(255 * std::pow(double{1} * i / kSteps, 1 / 2.2))));
    return made;
  }
  static const uint8_t* Shared() {
    static const std::vector<uint8_t> bytes = Bytes();
    return bytes.data();
  }
  const uint8_t* bytes_ = Shared();
};

}  // namespace choreo
