#include "model/audio/signal/format.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "model/core/error.h"
#include "model/core/rounded.h"
#include "model/core/text/field.h"

namespace choreo {

void CheckAudioFormat(double sample_rate, int channels, const std::string& name) {
  if (!(sample_rate >= kMinSampleRate && sample_rate <= kMaxSampleRate) ||
      sample_rate != std::floor(sample_rate)) {
    throw InvalidArgument(name + ".sample_rate", InFull(sample_rate) +
                                                     " Hz is not a whole number from " +
                                                     std::to_string(kMinSampleRate) + " to " +
                                                     std::to_string(kMaxSampleRate));
  }
  if (channels < 1 || channels > kMaxChannels) {
    throw InvalidArgument(name + ".channels", std::to_string(channels) + " is not within 1 to " +
                                                  std::to_string(kMaxChannels));
  }
}

void CheckBeats(std::span<const double> beats, const std::string& field) {
  if (beats.size() > kMaxBeats) {
    throw InvalidArgument(
        field, std::to_string(beats.size()) + " beats, the limit is " + std::to_string(kMaxBeats));
  }
  for (size_t i = 0; i < beats.size(); ++i) {
    const std::string at = At(field, static_cast<int64_t>(i));
    if (!(beats[i] >= 0 && beats[i] <= kMaxAudioSeconds)) {
      throw InvalidArgument(
          at, InFull(beats[i]) + " s is not within 0 to " + std::to_string(kMaxAudioSeconds));
    }
    if (i > 0 && beats[i] <= beats[i - 1]) {
      throw InvalidArgument(at, InFull(beats[i]) + " s is not after the beat before it, " +
                                    InFull(beats[i - 1]) + " s");
    }
  }
}

void CheckDownbeats(std::span<const double> downbeats, std::span<const double> beats,
                    const std::string& field) {
  CheckBeats(downbeats, field);
  for (size_t i = 0; i < downbeats.size(); ++i) {
    if (!std::ranges::binary_search(beats, downbeats[i])) {
      throw InvalidArgument(At(field, static_cast<int64_t>(i)),
                            InFull(downbeats[i]) + " s is not one of the beats");
    }
  }
}

void CheckEnergies(std::span<const float> energies, const std::string& field) {
  if (energies.size() > kMaxEnergies) {
    throw InvalidArgument(field, std::to_string(energies.size()) + " energies, the limit is " +
                                     std::to_string(kMaxEnergies));
  }
  for (size_t i = 0; i < energies.size(); ++i) {
    if (std::abs(energies[i]) <= kMaxEnergy) continue;
    throw InvalidArgument(At(field, static_cast<int64_t>(i)), InFull(energies[i]) + " is not in [" +
                                                                  InFull(-kMaxEnergy) + ", " +
                                                                  InFull(kMaxEnergy) + "]");
  }
}

void CheckLevels(std::span<const float> interleaved, int channels, int64_t first_sample,
                 const std::string& name) {
  for (size_t i = 0; i < interleaved.size(); ++i) {
    const float level = interleaved[i];
    if (std::abs(level) <= kMaxLevel) continue;
    const int64_t sample = first_sample + static_cast<int64_t>(i) / channels;
    throw InvalidArgument(
        name, "sample " + std::to_string(sample) + " of channel " +
                  std::to_string(i % static_cast<size_t>(channels)) + " is " +
                  (std::isfinite(level) ? InFull(level) + ", full scale is -1 to 1, the limit " +
                                              Rounded(kMaxLevel) +
                                              ": divide samples that were 16-bit integers by 32768"
                                        : std::to_string(level) + ", not a finite number"));
  }
}

}  // namespace choreo
