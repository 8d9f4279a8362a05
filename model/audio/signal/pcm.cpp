#include "model/audio/signal/pcm.h"

#include <bit>
#include <cstdint>
#include <cstring>

#include "model/core/error.h"

namespace choreo {

static_assert(std::endian::native == std::endian::little, "PCM samples are read as they come");

std::vector<float> ReadPcm(std::string_view bytes, bool floats, int channels,
                           const std::string& field) {
  const size_t sample_bytes = floats ? sizeof(float) : sizeof(int16_t);
  const size_t frame_bytes = sample_bytes * static_cast<size_t>(channels);
  if (bytes.size() % frame_bytes != 0) {
    throw InvalidArgument(field, std::to_string(bytes.size()) + " bytes are not whole samples of " +
                                     std::to_string(frame_bytes) + " bytes");
  }
  std::vector<float> samples(bytes.size() / sample_bytes);
  if (floats) {
    std::memcpy(samples.data(), bytes.data(), bytes.size());
  } else {
    for (size_t i = 0; i < samples.size(); ++i) {
      int16_t value = 0;
      std::memcpy(&value, bytes.data() + i * sizeof value, sizeof value);
      samples[i] = static_cast<float>(value) / 32768.0F;
    }
  }
  return samples;
}

}  // namespace choreo
