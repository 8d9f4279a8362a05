#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/audio/format.h"

namespace choreo {

/// Samples at 22 050 Hz from one onset, and one beat frame, to the next: 90 a second.
inline constexpr int kOnsetHop = 245;
inline constexpr double kOnsetRate =
    static_cast<double>(kModelSampleRate) / kOnsetHop;  ///< a second
/// Samples that an onset is heard in, half of them before its own.
inline constexpr int kOnsetWindow = 1024;

/// How strongly something begins.
struct Onset {
  static constexpr size_t kBands = 3;
  /// Below 160 Hz, where the low drum and the bass are; up to 1600 Hz; above. By how many dB the
  /// Fourier bands there rose within two frames, their mean.
  std::array<float, kBands> rise{};
  float loud_db = -100;  ///< the loudest of the Fourier bands, 0: a sine of full scale

  friend bool operator==(const Onset&, const Onset&) = default;
};

/// Onsets frame by frame. What lies more than 50 dB below the loudest band of the last two seconds
/// is not heard, nor is a DC offset. An onset depends on no more than the kMemory frames before it.
/// Not thread-safe.
class OnsetMeter {
 public:
  static constexpr size_t kLoudFrames = 180;  // two seconds
  static constexpr size_t kMemory = kLoudFrames + 2;

  /// `window`: kOnsetWindow samples around the next frame.
  Onset Add(std::span<const float> window);

 private:
  static constexpr size_t kBands = 24, kRise = 2;
  using BandsDb = std::array<double, kBands>;

  BandsDb Decibels(std::span<const float> window);

  size_t frames_ = 0;
  std::array<BandsDb, kRise> before_{};
  std::array<double, kLoudFrames> loudest_{};
};

/// The onsets of mono samples at 22 050 Hz, all of them. Frame f is centred at sample f *
/// kOnsetHop; there are 1 + samples / kOnsetHop. Audio before and after is silence. Throws
/// Error(kInvalidArgument) for no samples.
std::vector<Onset> FindOnsets(std::span<const float> mono);

/// One number a frame: the mean of its bands, the bass alone counting as much as the others
/// together.
std::vector<float> OnsetStrength(std::span<const Onset> onsets);

}  // namespace choreo
