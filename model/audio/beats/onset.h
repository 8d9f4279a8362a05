#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/audio/signal/format.h"

namespace choreo {

/// Samples at 22 050 Hz between onset (and beat) frames: 90 a second.
inline constexpr int kOnsetHop = 245;
inline constexpr double kOnsetRate =
    static_cast<double>(kModelSampleRate) / kOnsetHop;  ///< per second
/// Samples in an onset's window, half of them before its centre.
inline constexpr int kOnsetWindow = 1024;

/// The strength of an onset at a frame.
struct Onset {
  static constexpr size_t kBands = 3;
  /// Mean rise in dB over two frames of the Fourier bands below 160 Hz (bass drum and bass), up to
  /// 1600 Hz, and above.
  std::array<float, kBands> rise{};
  float loud_db = -100;  ///< the loudest Fourier band; 0: a full-scale sine

  friend bool operator==(const Onset&, const Onset&) = default;
};

/// Measures onsets frame by frame. Ignores DC, and levels more than 50 dB below the loudest band of
/// the last two seconds. An onset depends on at most the kMemory frames before it. Not thread-safe.
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

/// All onsets of mono samples at 22 050 Hz. Frame f is centred at sample f * kOnsetHop; there are 1
/// + samples / kOnsetHop. Before and after is silence at the mean of the nearest second, so that a
/// DC offset has no onset. Throws Error(kInvalidArgument) for no samples.
std::vector<Onset> FindOnsets(std::span<const float> mono);

/// The onset envelope, one value per frame: the mean over bands, with the bass weighted like the
/// others together.
std::vector<float> OnsetStrength(std::span<const Onset> onsets);

}  // namespace choreo
