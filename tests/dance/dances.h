#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "model/dance/dance_stream.h"
#include "tests/dance/poses.h"
#include "tests/dance/recorder.h"

namespace choreo {

/// `seconds` of a beat with some noise, interleaved.
inline std::vector<float> Song(double rate, double seconds, int channels = 1, uint32_t seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> noise(-0.1F, 0.1F);
  std::vector<float> samples;
  const auto count = static_cast<int64_t>(std::llround(seconds * rate));
  for (int64_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / rate;
    const double beat = std::exp(-8 * std::fmod(t, 0.5)) * std::sin(2 * 3.14159265 * 180 * t);
    for (int channel = 0; channel < channels; ++channel) {
      samples.push_back(static_cast<float>(0.5 * beat) + noise(random));
    }
  }
  return samples;
}

/// What a client would send: everything at once, keys in order.
struct Dance {
  DanceConfig config;
  std::vector<Key> keys;
  std::vector<float> samples;  // config.audio's
  int64_t chunk = 4000;        // sample frames a message
};

/// Some keys, two of them partial, and music on request.
inline Dance RandomDance(uint32_t seed, double music_seconds = 0) {
  std::mt19937 random(seed);
  Dance dance;
  dance.config.seed = seed;
  if (music_seconds > 0) {
    dance.config.audio = DanceConfig::Audio{22050, 1, 0};
    dance.samples = Song(22050, music_seconds, 1, seed);
    for (double beat = 0.5; beat < music_seconds; beat += 0.5)
      dance.config.music_beats.push_back(beat);
  }
  int64_t frame = 0;
  for (int i = 0; i < 5; ++i) {
    frame += 10 + static_cast<int64_t>(random() % 40);
    Key key{"key" + std::to_string(i), frame, RandomPose(random), {}};
    if (i == 1) key.mask.root_position = false;
    if (i == 2) {
      key.mask.joints.assign(24, false);
      for (size_t joint = 16; joint < 24; ++joint) key.mask.joints[joint] = true;
    }
    dance.keys.push_back(std::move(key));
  }
  return dance;
}

/// One without given beats, to music with a beat every half second.
inline Dance LiveDance(uint32_t seed, double music_seconds) {
  Dance dance = RandomDance(seed, music_seconds);
  dance.config.music_beats.clear();
  return dance;
}

inline void SendKey(DanceStream& stream, const Key& key) { stream.SetKey(key, AtFrame{key.frame}); }

/// Sends the song from its sample `from` on.
inline void SendSong(DanceStream& stream, const Dance& dance, int64_t from = 0) {
  const int64_t channels = dance.config.audio->channels;
  const int64_t samples = static_cast<int64_t>(dance.samples.size()) / channels;
  for (int64_t at = from; at < samples; at += dance.chunk) {
    const int64_t count = std::min(dance.chunk, samples - at);
    stream.PushAudio(
        std::span(dance.samples)
            .subspan(static_cast<size_t>(at * channels), static_cast<size_t>(count * channels)),
        at);
  }
}

inline Recording Perform(SampleQueue& queue, const Dance& dance) {
  auto sink = std::make_shared<Recorder>();
  DanceStream stream(queue, Checked(queue, dance.config), sink);
  for (const Key& key : dance.keys) SendKey(stream, key);
  if (dance.config.audio) SendSong(stream, dance, dance.config.audio->first_sample);
  stream.HalfClose();
  return sink->WaitForEnd();
}

}  // namespace choreo
