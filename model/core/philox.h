#pragma once

#include <cmath>
#include <cstdint>

#ifdef __CUDACC__
#define CHOREO_HOST_DEVICE __host__ __device__
#else
#define CHOREO_HOST_DEVICE
#endif

/// The arithmetic of counter-based noise, for the CPU and for CUDA kernels: plain arrays, no
/// library. random.h says what it is for.
namespace choreo::philox {

/// Philox4x32-10: replaces a counter with its 128 random bits.
CHOREO_HOST_DEVICE inline void Scramble(uint32_t (&c)[4], uint64_t seed) {
  uint32_t k0 = static_cast<uint32_t>(seed), k1 = static_cast<uint32_t>(seed >> 32);
  for (int round = 0; round < 10; ++round) {
    const uint64_t p0 = uint64_t{0xD2511F53} * c[0];
    const uint64_t p1 = uint64_t{0xCD9E8D57} * c[2];
    const uint32_t next[4] = {
        static_cast<uint32_t>(p1 >> 32) ^ c[1] ^ k0, static_cast<uint32_t>(p1),
        static_cast<uint32_t>(p0 >> 32) ^ c[3] ^ k1, static_cast<uint32_t>(p0)};
    for (int i = 0; i < 4; ++i) c[i] = next[i];
    k0 += 0x9E3779B9;
    k1 += 0xBB67AE85;
  }
}

/// Two independent normals out of 64 random bits. The half keeps the logarithm's argument off zero.
CHOREO_HOST_DEVICE inline void BoxMuller(uint32_t a, uint32_t b, double (&z)[2]) {
  constexpr double kTwoPi = 6.283185307179586476925286766559;
  const double radius = std::sqrt(-2.0 * std::log((a + 0.5) * 0x1p-32));
  const double angle = kTwoPi * (b * 0x1p-32);
  z[0] = radius * std::cos(angle);
  z[1] = radius * std::sin(angle);
}

/// Dimensions 4 * block to 4 * block + 3 of a frame's noise.
CHOREO_HOST_DEVICE inline void FrameNormals(uint64_t seed, uint32_t candidate, int64_t frame,
                                            uint32_t block, float (&out)[4]) {
  const auto at = static_cast<uint64_t>(frame);
  uint32_t bits[4] = {block, candidate, static_cast<uint32_t>(at), static_cast<uint32_t>(at >> 32)};
  Scramble(bits, seed);
  for (int pair = 0; pair < 4; pair += 2) {
    double z[2];
    BoxMuller(bits[pair], bits[pair + 1], z);
    out[pair] = static_cast<float>(z[0]);
    out[pair + 1] = static_cast<float>(z[1]);
  }
}

}  // namespace choreo::philox
