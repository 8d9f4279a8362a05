#include "model/audio/format.h"

#include <cmath>
#include <cstddef>

#include "model/core/error.h"

namespace choreo {

void CheckAudioFormat(double sample_rate, int channels, const std::string& name) {
  if (!(sample_rate >= kMinSampleRate && sample_rate <= kMaxSampleRate) ||
      sample_rate != std::floor(sample_rate)) {
    throw InvalidArgument(name + ".sample_rate", std::to_string(sample_rate) +
                                                     " Hz is not a whole number from " +
                                                     std::to_string(kMinSampleRate) + " to " +
                                                     std::to_string(kMaxSampleRate));
  }
  if (channels < 1 || channels > kMaxChannels) {
    throw InvalidArgument(name + ".channels", std::to_string(channels) + " is not within 1 to " +
                                                  std::to_string(kMaxChannels));
  }
}

void CheckFinite(std::span<const float> interleaved, int channels, int64_t first_sample,
                 const std::string& name) {
  for (size_t i = 0; i < interleaved.size(); ++i) {
    if (!std::isfinite(interleaved[i])) {
      const int64_t sample = first_sample + static_cast<int64_t>(i) / channels;
      throw InvalidArgument(name + ".data", "sample " + std::to_string(sample) + " of channel " +
                                                std::to_string(i % static_cast<size_t>(channels)) +
                                                " is " + std::to_string(interleaved[i]) +
                                                ", not a finite number");
    }
  }
}

}  // namespace choreo
