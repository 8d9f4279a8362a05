#include "model/core/numbers/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "model/core/error.h"

namespace choreo {
namespace {

// Separates Random's blocks from FillNormal's, whose counter holds the upper half of a frame number
// here: no dance reaches this one.
constexpr uint32_t kSequenceDomain = 0x53455155;

// Two independent normals from 64 random bits. Adding a half keeps the logarithm's argument above
// 0.
std::array<double, 2> BoxMuller(uint32_t a, uint32_t b) {
  const double radius = std::sqrt(-2.0 * std::log((a + 0.5) * 0x1p-32));
  const double angle = 2 * std::numbers::pi * (b * 0x1p-32);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

std::array<uint32_t, 2> KeyOf(uint64_t seed) {
  return {static_cast<uint32_t>(seed), static_cast<uint32_t>(seed >> 32)};
}

}  // namespace

std::array<uint32_t, 4> Philox4x32(const std::array<uint32_t, 4>& counter,
                                   const std::array<uint32_t, 2>& key) {
  std::array<uint32_t, 4> c = counter;
  auto [k0, k1] = key;
  for (int round = 0; round < 10; ++round) {
    const uint64_t p0 = uint64_t{0xD2511F53} * c[0];
    const uint64_t p1 = uint64_t{0xCD9E8D57} * c[2];
    c = {static_cast<uint32_t>(p1 >> 32) ^ c[1] ^ k0, static_cast<uint32_t>(p1),
         static_cast<uint32_t>(p0 >> 32) ^ c[3] ^ k1, static_cast<uint32_t>(p0)};
    k0 += 0x9E3779B9;
    k1 += 0xBB67AE85;
  }
  return c;
}

void FillNormal(uint64_t seed, uint32_t candidate, int64_t absolute_frame, std::span<float> out) {
  const auto at = static_cast<uint64_t>(absolute_frame);
  for (size_t first = 0; first < out.size(); first += 4) {
    const auto bits = Philox4x32({static_cast<uint32_t>(first / 4), candidate,
                                  static_cast<uint32_t>(at), static_cast<uint32_t>(at >> 32)},
                                 KeyOf(seed));
    const auto [a, b] = BoxMuller(bits[0], bits[1]);
    const auto [c, d] = BoxMuller(bits[2], bits[3]);
    const double normals[] = {a, b, c, d};
    for (size_t i = 0; i < 4 && first + i < out.size(); ++i)
      out[first + i] = static_cast<float>(normals[i]);
  }
}

void FillNormalLike(uint64_t seed, uint32_t candidate, int64_t absolute_frame, int64_t like,
                    double variation, std::span<float> out) {
  if (like == absolute_frame || variation >= 1)
    return FillNormal(seed, candidate, absolute_frame, out);
  FillNormal(seed, candidate, like, out);
  if (variation <= 0) return;
  std::vector<float> own(out.size());
  FillNormal(seed, candidate, absolute_frame, own);
  const double kept = std::sqrt(1 - variation * variation);
  for (size_t d = 0; d < out.size(); ++d)
    out[d] = static_cast<float>(kept * out[d] + variation * own[d]);
}

uint32_t Random::Next() {
  const uint64_t offset = position_ % 4;
  if (offset == 0) {
    const uint64_t block = position_ / 4;
    block_ = Philox4x32({static_cast<uint32_t>(block), static_cast<uint32_t>(block >> 32), stream_,
                         kSequenceDomain},
                        KeyOf(seed_));
  }
  ++position_;
  return block_[offset];
}

double Random::Uniform() {
  const uint64_t high = Next();
  const uint64_t low = Next();
  return static_cast<double>(((high << 32) | low) >> 11) * 0x1p-53;
}

double Random::Uniform(double low, double high) { return low + (high - low) * Uniform(); }

double Random::Normal() {
  const uint32_t a = Next();
  const uint32_t b = Next();
  return BoxMuller(a, b)[0];
}

void Random::FillNormal(std::span<float> out) {
  for (float& value : out) value = static_cast<float>(Normal());
}

int64_t Random::Integer(int64_t low, int64_t high) {
  if (low >= high) {
    throw InvalidArgument("", "Random::Integer: low " + std::to_string(low) +
                                  " is not below high " + std::to_string(high));
  }
  const uint64_t range = static_cast<uint64_t>(high) - static_cast<uint64_t>(low);
  // 2^64 mod range: accepting draws below it would make small remainders too likely.
  const uint64_t unfair = (uint64_t{0} - range) % range;
  uint64_t draw;
  do {
    const uint64_t upper = Next();
    const uint64_t lower = Next();
    draw = (upper << 32) | lower;
  } while (draw < unfair);
  return static_cast<int64_t>(static_cast<uint64_t>(low) + draw % range);
}

}  // namespace choreo
