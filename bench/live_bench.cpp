#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <mutex>
#include <random>
#include <thread>

#include "client/choreo_client.h"
#include "client/cli/local_server.h"
#include "client/cli/music.h"
#include "client/cli/pose_library.h"

/// How steadily a live stream dances: a song is sent in real time, in chunks as a sound card would
/// hand them over, to a choreod over gRPC, and the arrival of every frame is measured.
///
/// A frame is due when the chunk has been sent that holds the sample it needs: that of its own time
/// plus the header's `latency_frames`. `after due` is how much later it came. A frame is late if a
/// player lacks it that follows the music at the distance of latency_frames, one chunk and 50 ms.
namespace choreo {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kAllowance_ms = 50;

struct Options {
  std::string server;
  std::string song;
  double seconds = 4;
  int dances = 24;
  int together = 4;
};

struct Figures {
  std::vector<double> first_ms;  ///< first frames, after due
  std::vector<double> all_ms;    ///< all frames, after due
  int late = 0;

  void Add(const Figures& other) {
    first_ms.insert(first_ms.end(), other.first_ms.begin(), other.first_ms.end());
    all_ms.insert(all_ms.end(), other.all_ms.begin(), other.all_ms.end());
    late += other.late;
  }
};

double Percentile(std::vector<double>& values, double share) {
  if (values.empty()) return std::nan("");
  const auto rank =
      static_cast<size_t>(std::clamp(std::ceil(share * static_cast<double>(values.size())) - 1, 0.0,
                                     static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank),
                   values.end());
  return values[rank];
}

std::chrono::duration<double> Seconds(double seconds) {
  return std::chrono::duration<double>(seconds);
}

Clock::time_point After(Clock::time_point start, double seconds) {
  return start + std::chrono::duration_cast<Clock::duration>(Seconds(seconds));
}

/// A chunk of music: its end, in seconds of the song, and when it was sent.
struct Sent {
  double end_s;
  Clock::time_point at;
};

/// Sends the song as it plays. `shortest_s` to `longest_s`: chunks, their lengths drawn evenly.
std::vector<Sent> Play(client::RemoteDance& dance, const client::Audio& song, double shortest_s,
                       double longest_s, Clock::time_point start, uint32_t seed) {
  std::minstd_rand random(seed);
  std::uniform_real_distribution<double> length(shortest_s, longest_s);
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

Figures DanceOnce(const client::Client& client, const client::Audio& song, double seconds,
                  double shortest_s, double longest_s, uint32_t seed) {
  const Clock::time_point start = Clock::now();
  const auto dance = client.StartDance({.seed = seed, .audio = song.format});
  for (const double share : {0.5, 1.0}) {
    client::KeyPose key;
    key.id = share < 1 ? "middle" : "end";
    key.time_s = share * seconds - 0.1;
    key.pose = cli::FindLibraryPose(share < 1 ? "side_reach" : "groove").pose;
    dance->SendKey(key);
  }
  dance->CompleteKeys();
  std::vector<Sent> sent;
  std::thread player([&] { sent = Play(*dance, song, shortest_s, longest_s, start, seed); });
  double fps = 30;
  int latency = 0;
  std::vector<Clock::time_point> arrivals;
  while (const std::optional<client::Message> message = dance->Next()) {
    if (const auto* header = std::get_if<client::Header>(&*message)) {
      fps = header->fps;
      latency = header->latency_frames;
    } else if (const auto* block = std::get_if<client::FrameBlock>(&*message)) {
      arrivals.insert(arrivals.end(), block->poses.size(), Clock::now());
    }
  }
  player.join();

  Figures figures;
  for (size_t frame = 0; frame < arrivals.size(); ++frame) {
    const double needs_s = (static_cast<double>(frame) + latency) / fps;
    // Behind its end, the song's end is what is waited for.
    auto chunk = std::lower_bound(sent.begin(), sent.end(), needs_s,
                                  [](const Sent& one, double s) { return one.end_s < s; });
    if (chunk == sent.end()) --chunk;
    const auto ms = [](Clock::duration d) {
      return std::chrono::duration<double, std::milli>(d).count();
    };
    figures.all_ms.push_back(ms(arrivals[frame] - chunk->at));
    if (frame == 0) figures.first_ms.push_back(figures.all_ms.back());
    figures.late +=
        arrivals[frame] > After(start, needs_s + longest_s + kAllowance_ms / 1000) ? 1 : 0;
  }
  return figures;
}

void Measure(const client::Client& client, const client::Audio& song, const Options& options,
             double shortest_ms, double longest_ms) {
  Figures figures;
  std::mutex mutex;
  std::vector<std::thread> dancers;
  for (int dancer = 0; dancer < options.together; ++dancer) {
    dancers.emplace_back([&, dancer] {
      // Not all in step.
      std::this_thread::sleep_for(Seconds(options.seconds * dancer / options.together));
      for (int i = dancer; i < options.dances; i += options.together) {
        const Figures one = DanceOnce(client, song, options.seconds, shortest_ms / 1000,
                                      longest_ms / 1000, static_cast<uint32_t>(1 + i));
        const std::lock_guard lock(mutex);
        figures.Add(one);
      }
    });
  }
  for (std::thread& dancer : dancers) dancer.join();
  std::printf("%3.0f-%-3.0f   %6.1f %6.1f %6.1f    %6.1f %6.1f %6.1f %6.1f   %5d of %zu\n",
              shortest_ms, longest_ms, Percentile(figures.first_ms, 0.5),
              Percentile(figures.first_ms, 0.99), Percentile(figures.first_ms, 1),
              Percentile(figures.all_ms, 0.5), Percentile(figures.all_ms, 0.95),
              Percentile(figures.all_ms, 0.99), Percentile(figures.all_ms, 1), figures.late,
              figures.all_ms.size());
  std::fflush(stdout);
}

client::Audio Song(const Options& options) {
  if (!options.song.empty()) return cli::ReadAudioFor(options.song, options.seconds);
  client::Audio song;
  song.format = {client::AudioKind::kPcmFloat, 44100, 2};
  for (int i = 0; i < static_cast<int>(options.seconds * 44100); ++i) {
    const double t = i / 44100.0;
    const double value = 0.5 * std::exp(-8 * std::fmod(t, 0.5)) * std::sin(1400 * t);
    song.samples.insert(song.samples.end(), 2, static_cast<float>(value));
  }
  return song;
}

void Run(const Options& options) {
  std::unique_ptr<cli::LocalServer> own;
  if (options.server.empty()) own = std::make_unique<cli::LocalServer>();
  const client::Client client({.addresses = {own ? own->address() : options.server}});
  const client::ServerDescription server = client.GetServerInfo();
  const client::Audio song = Song(options);
  std::printf("live: %d dances of %g s, %d at once, model %s on %s, %u cores\n", options.dances,
              options.seconds, options.together, server.models.front().name.c_str(),
              server.devices.front().c_str(), std::thread::hardware_concurrency());
  std::printf("chunk, ms  first frame after due, ms  frames after due, ms             late\n");
  std::printf("             p50    p99    max       p50    p95    p99    max\n");
  for (const auto& [shortest, longest] :
       {std::pair(5.0, 5.0), {20.0, 20.0}, {100.0, 100.0}, {500.0, 500.0}, {5.0, 500.0}}) {
    Measure(client, song, options, shortest, longest);
  }
}

}  // namespace
}  // namespace choreo

int main(int argc, char** argv) {
  CLI::App program{"Sends songs in real time and measures when the frames come.", "live_bench"};
  choreo::Options options;
  program.add_option("--server", options.server, "HOST:PORT; default: one is started here.");
  program.add_option("--song", options.song, "Default: a made-up one, 44.1 kHz in stereo.")
      ->check(CLI::ExistingFile);
  program.add_option("--seconds", options.seconds, "Length of a dance.")
      ->check(CLI::Range(1.0, 600.0))
      ->capture_default_str();
  program.add_option("--dances", options.dances, "Dances for each kind of chunks.")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  program.add_option("--together", options.together, "Dances at once.")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  CLI11_PARSE(program, argc, argv);
  try {
    choreo::Run(options);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "live_bench: " << error.what() << '\n';
    return 1;
  }
}
