#pragma once

#include <array>
#include <cstdint>
#include <span>

/// Counter-based random numbers: Philox4x32-10 (Salmon et al. 2011, "Parallel random numbers: as
/// easy as 1, 2, 3"). A number is a pure function of its coordinates, so order, batching and
/// threads can't change it. Pure functions; thread-safe.
namespace choreo {

/// One Philox block: 128 random bits from a 128-bit counter and a 64-bit key.
std::array<uint32_t, 4> Philox4x32(const std::array<uint32_t, 4>& counter,
                                   const std::array<uint32_t, 2>& key);

/// Standard normal noise of one frame of one candidate: out[d] depends on (seed, candidate,
/// absolute_frame, d) alone, whatever out.size() is. Box-Muller in double, rounded to float;
/// |out[d]| < 6.8.
void FillNormal(uint64_t seed, uint32_t candidate, int64_t absolute_frame, std::span<float> out);

/// FillNormal for a frame that repeats frame `like`. `variation` 0 gives that frame's numbers, 1
/// the frame's own, and values between correlate with `like`'s by sqrt(1 - variation²).
void FillNormalLike(uint64_t seed, uint32_t candidate, int64_t absolute_frame, int64_t like,
                    double variation, std::span<float> out);

/// A sequence of random numbers for training and for sampling data, independent of FillNormal's
/// numbers for the same seed. A copy continues from the same position. Not thread-safe; give each
/// thread its own `stream`.
class Random {
 public:
  explicit Random(uint64_t seed, uint32_t stream = 0) : seed_(seed), stream_(stream) {}

  /// 32 random bits.
  uint32_t Next();
  /// A number in [0, 1) of 53 random bits.
  double Uniform();
  /// A number in [low, high).
  double Uniform(double low, double high);
  /// Mean 0, standard deviation 1.
  double Normal();
  void FillNormal(std::span<float> out);
  /// Each of low, ..., high - 1 equally likely. Throws Error(kInvalidArgument) unless low < high.
  int64_t Integer(int64_t low, int64_t high);

 private:
  uint64_t seed_;
  uint32_t stream_;
  uint64_t position_ = 0;               // 32-bit words drawn so far
  std::array<uint32_t, 4> block_ = {};  // holds word `position_` unless that starts a new block
};

}  // namespace choreo
