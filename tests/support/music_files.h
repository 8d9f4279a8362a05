#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

namespace choreo {

inline constexpr int kMusicRate = 22050;

/// A steadily rising tone, so that all feature rows differ.
inline std::vector<float> Music(double seconds) {
  std::vector<float> samples;
  for (int i = 0; i < seconds * kMusicRate; ++i) {
    const double t = static_cast<double>(i) / kMusicRate;
    samples.push_back(static_cast<float>(
        std::round(16000 * std::sin(2 * M_PI * (200 * t + 60 * t * t))) / 32768));
  }
  return samples;
}

inline void WriteWav(const std::filesystem::path& path, const std::vector<float>& samples) {
  std::ofstream out(path, std::ios::binary);
  const auto put = [&](uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out.put(static_cast<char>(value >> (8 * i) & 0xff));
  };
  const auto size = static_cast<uint32_t>(2 * samples.size());
  out << "RIFF";
  put(36 + size, 4);
  out << "WAVEfmt ";
  put(16, 4), put(1, 2), put(1, 2), put(kMusicRate, 4), put(2 * kMusicRate, 4), put(2, 2),
      put(16, 2);
  out << "data";
  put(size, 4);
  for (const float sample : samples) {
    put(static_cast<uint16_t>(static_cast<int16_t>(std::lround(sample * 32768))), 2);
  }
}

}  // namespace choreo
