#include "tests/client/test_music.h"

#include <cmath>
#include <cstdint>
#include <fstream>

namespace choreo {
namespace {

constexpr int kRate = 22050;

template <typename T>
void Put(std::ofstream& file, T value) {
  file.write(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

std::vector<float> Clicks(double seconds) {
  std::vector<float> samples(static_cast<size_t>(seconds * kRate));
  for (size_t i = 0; i < samples.size(); ++i) {
    const double since_click = static_cast<double>(i % (kRate / 2)) / kRate;
    const double t = static_cast<double>(i) / kRate;
    samples[i] = static_cast<float>(0.05 * std::sin(2 * M_PI * 220 * t) +
                                    0.7 * std::exp(-60 * since_click) *
                                        std::sin(2 * M_PI * 1000 * since_click));
  }
  return samples;
}

void WriteClicks(const std::filesystem::path& path, double seconds) {
  const std::vector<float> samples = Clicks(seconds);
  const auto bytes = static_cast<uint32_t>(2 * samples.size());
  std::ofstream file(path, std::ios::binary);
  file << "RIFF";
  Put<uint32_t>(file, 36 + bytes);
  file << "WAVEfmt ";
  Put<uint32_t>(file, 16);
  Put<uint16_t>(file, 1);  // PCM
  Put<uint16_t>(file, 1);  // channel
  Put<uint32_t>(file, kRate);
  Put<uint32_t>(file, 2 * kRate);
  Put<uint16_t>(file, 2);   // bytes a sample
  Put<uint16_t>(file, 16);  // bits
  file << "data";
  Put<uint32_t>(file, bytes);
  for (const float sample : samples)
    Put<int16_t>(file, static_cast<int16_t>(std::lround(32767 * sample)));
}

client::Audio ClicksAudio(double seconds) {
  return {{client::AudioKind::kPcmFloat, kRate, 1}, Clicks(seconds), {}};
}

}  // namespace choreo
