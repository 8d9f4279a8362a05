#include "bench/lateness.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <thread>

#include "client/authoring/keys/pose_library.h"
#include "model/core/error.h"

namespace choreo::bench {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kAllowance_s = 0.05;

Clock::time_point After(Clock::time_point start, double seconds) {
  return start +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

/// A chunk of music: its end, in seconds of the song, and when it was sent.
struct Sent {
  double end_s;
  Clock::time_point at;
};

// Sends the song in real time.
std::vector<Sent> Play(client::RemoteDance& dance, const client::Audio& song,
                       const LiveRequest& request, Clock::time_point start) {
  std::minstd_rand random(request.seed);
  std::uniform_real_distribution<double> length(request.shortest_chunk_s, request.longest_chunk_s);
  const auto channels = static_cast<size_t>(song.format.channels);
  const size_t total = song.samples.size() / channels;
  std::vector<Sent> sent;
  for (size_t at = 0; at < total;) {
    const auto count = static_cast<size_t>(std::llround(length(random) * song.format.sample_rate));
    const size_t end = std::min(total, at + std::max<size_t>(1, count));
    const double end_s = static_cast<double>(end) / song.format.sample_rate;
    std::this_thread::sleep_until(After(start, end_s));
    dance.SendSamples(std::span(song.samples).subspan(at * channels, (end - at) * channels));
    sent.push_back({end_s, Clock::now()});
    at = end;
  }
  dance.EndAudio();
  return sent;
}

}  // namespace

void Lateness::Add(const Lateness& other) {
  first_ms.insert(first_ms.end(), other.first_ms.begin(), other.first_ms.end());
  all_ms.insert(all_ms.end(), other.all_ms.begin(), other.all_ms.end());
  missed += other.missed;
  refused_ms.insert(refused_ms.end(), other.refused_ms.begin(), other.refused_ms.end());
}

double Percentile(std::vector<double>& values, double share) {
  if (values.empty()) return std::nan("");
  const auto last = static_cast<double>(values.size() - 1);
  const double rank =
      std::clamp(std::ceil(share * static_cast<double>(values.size())) - 1, 0.0, last);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

client::Audio ClickSong(double seconds, int sample_rate, int channels) {
  client::Audio song;
  song.format = {client::AudioKind::kPcmFloat, sample_rate, channels};
  const auto frames = static_cast<int64_t>(seconds * sample_rate);
  for (int64_t i = 0; i < frames; ++i) {
    const double t = static_cast<double>(i) / sample_rate;
    const double value = 0.5 * std::exp(-8 * std::fmod(t, 0.5)) * std::sin(1400 * t);
    song.samples.insert(song.samples.end(), static_cast<size_t>(channels),
                        static_cast<float>(value));
  }
  return song;
}

void SendKeys(client::RemoteDance& dance, double seconds, double key_each_s) {
  const std::vector<authoring::LibraryPose>& poses = authoring::PoseLibrary();
  const auto keys = std::max<int64_t>(1, std::llround(seconds / key_each_s));
  for (int64_t i = 1; i <= keys; ++i) {
    client::KeyPose key;
    key.id = std::to_string(i);
    key.time_s = static_cast<double>(i) / static_cast<double>(keys) * seconds - 0.1;
    key.pose = poses[static_cast<size_t>(i) % poses.size()].pose;
    dance.SendKey(key);
  }
  dance.CompleteKeys();
}

Lateness DanceLive(const client::Client& client, const client::Audio& song,
                   const LiveRequest& request) {
  const double seconds =
      static_cast<double>(song.samples.size()) / song.format.channels / song.format.sample_rate;
  const Clock::time_point start = Clock::now();
  const auto dance = client.StartDance({.seed = request.seed, .audio = song.format});
  SendKeys(*dance, seconds, request.key_each_s);
  std::vector<Sent> sent;
  std::thread player([&] { sent = Play(*dance, song, request, start); });
  double fps = kModelFps;
  int latency = 0;
  std::vector<Clock::time_point> arrivals;
  Lateness lateness;
  try {
    while (const std::optional<client::Message> message = dance->Next()) {
      if (const auto* header = std::get_if<client::Header>(&*message)) {
        fps = header->fps;
        latency = header->latency_frames;
      } else if (const auto* block = std::get_if<client::FrameBlock>(&*message)) {
        arrivals.insert(arrivals.end(), block->poses.size(), Clock::now());
      }
    }
  } catch (const Error& error) {
    const std::chrono::duration<double, std::milli> until_refusal = Clock::now() - start;
    player.join();
    if (error.code() != ErrorCode::kResourceExhausted || !arrivals.empty()) throw;
    lateness.refused_ms.push_back(until_refusal.count());
    return lateness;
  }
  player.join();

  for (size_t frame = 0; frame < arrivals.size(); ++frame) {
    const double needs_s = (static_cast<double>(frame) + latency) / fps;
    // For frames after the song, wait for the song's end.
    auto chunk = std::ranges::lower_bound(sent, needs_s, {}, &Sent::end_s);
    if (chunk == sent.end()) --chunk;
    lateness.all_ms.push_back(
        std::chrono::duration<double, std::milli>(arrivals[frame] - chunk->at).count());
    if (frame == 0) lateness.first_ms.push_back(lateness.all_ms.back());
    const double needed_s = needs_s + request.longest_chunk_s + kAllowance_s;
    if (arrivals[frame] > After(start, needed_s)) ++lateness.missed;
  }
  return lateness;
}

}  // namespace choreo::bench
