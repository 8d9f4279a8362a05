#include "model/core/random.h"

#include <algorithm>
#include <string>

#include "model/core/error.h"
#include "model/core/philox.h"

namespace choreo {
namespace {

// Marks the blocks of Random. FillNormal has the upper half of a frame number there, which no dance
// makes this large.
constexpr uint32_t kSequenceDomain = 0x53455155;

}  // namespace

std::array<uint32_t, 4> Philox4x32(const std::array<uint32_t, 4>& counter,
                                   const std::array<uint32_t, 2>& key) {
  uint32_t bits[4] = {counter[0], counter[1], counter[2], counter[3]};
  philox::Scramble(bits, key[0] | uint64_t{key[1]} << 32);
  return {bits[0], bits[1], bits[2], bits[3]};
}

void FillNormal(uint64_t seed, uint32_t candidate, int64_t absolute_frame, std::span<float> out) {
  for (size_t first = 0; first < out.size(); first += 4) {
    float z[4];
    philox::FrameNormals(seed, candidate, absolute_frame, static_cast<uint32_t>(first / 4), z);
    std::copy_n(z, std::min<size_t>(4, out.size() - first), out.begin() + first);
  }
}

Random::Random(uint64_t seed, uint32_t stream) : Random(State{seed, stream, 0}) {}

Random::Random(const State& state) : state_(state) {
  // Positions inside a block need the block that Next would have made at its first word.
  if (const uint64_t offset = state_.position % 4; offset != 0) {
    state_.position -= offset;
    for (uint64_t i = 0; i < offset; ++i) Next();
  }
}

uint32_t Random::Next() {
  const uint64_t offset = state_.position % 4;
  if (offset == 0) {
    const uint64_t block = state_.position / 4;
    block_ =
        Philox4x32({static_cast<uint32_t>(block), static_cast<uint32_t>(block >> 32), state_.stream,
                    kSequenceDomain},
                   {static_cast<uint32_t>(state_.seed), static_cast<uint32_t>(state_.seed >> 32)});
  }
  ++state_.position;
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
  double z[2];
  philox::BoxMuller(a, b, z);
  return z[0];
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
  // 2^64 mod range: draws below it would make the small remainders too likely.
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
