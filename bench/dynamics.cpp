// How far a dance shows that its music is heard: free dances of streams, as they are served, to
// songs of which a part is drums, a pad, or silent, to songs of which a part returns, and to whole
// songs. What each row says stands in its heading.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "model/audio/beats.h"
#include "model/audio/decode.h"
#include "model/audio/made_song.h"
#include "model/audio/music_id.h"
#include "model/audio/passages.h"
#include "model/dance/dance_stream.h"
#include "model/metrics/joint_track.h"
#include "model/motion/canonical.h"
#include "model/motion/kinematics.h"
#include "model/samplers/samplers.h"

namespace choreo::bench {
namespace {

constexpr int kSeeds = 3;
constexpr int kPartSeconds = 20, kWindowSeconds = 4;
// Frames of a part that its dance is not judged by: the music is heard up to a transition's begin.
constexpr size_t kSettles = 2 * kUsualFrames;

class Listener : public DanceSink {
 public:
  void OnFrames(int64_t, std::span<const Pose> poses, std::span<const Contacts>) override {
    poses_.insert(poses_.end(), poses.begin(), poses.end());
  }
  void OnEvent(const DanceEvent&) override {}
  void OnContinuation(const Continuation&) override {}
  void OnSummary(const QualityReport&) override { End(std::nullopt); }
  void OnError(const Error& error) override { End(error); }

  std::vector<Pose> Wait() {
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [this] { return is_over_; });
    if (error_) throw *error_;
    return std::move(poses_);
  }

 private:
  void End(const std::optional<Error>& error) {
    const std::lock_guard lock(mutex_);
    error_ = error;
    is_over_ = true;
    ended_.notify_all();
  }

  std::vector<Pose> poses_;
  std::mutex mutex_;
  std::condition_variable ended_;
  std::optional<Error> error_;
  bool is_over_ = false;
};

std::vector<Pose> Poses(SampleQueue& queue, const std::vector<float>& mono, DanceConfig config) {
  config.audio = DanceConfig::Audio{kModelSampleRate, 1, 0};
  config.music_id = MusicId(mono);
  const auto listener = std::make_shared<Listener>();
  DanceStream stream(queue, config, listener);
  stream.PushAudio(mono, 0);
  stream.HalfClose();
  return listener->Wait();
}

/// Mean joint speed of each step, m/s.
std::vector<float> Dance(SampleQueue& queue, const std::vector<float>& mono, uint64_t seed,
                         double dynamics) {
  DanceConfig config;
  config.seed = seed;
  config.music_dynamics = dynamics;
  return MeanSpeeds(TrackJoints(queue.model().skeleton, Poses(queue, mono, config)), kModelFps);
}

double Mean(std::span<const float> values) {
  double sum = 0;
  for (const float value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

double Correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto count = static_cast<double>(a.size());
  double mean_a = 0, mean_b = 0, ab = 0, aa = 0, bb = 0;
  for (size_t i = 0; i < a.size(); ++i) mean_a += a[i] / count, mean_b += b[i] / count;
  for (size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean_a) * (b[i] - mean_b);
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

/// LUFS of each window.
std::vector<double> LoudnessOf(const std::vector<float>& mono) {
  FeatureStream stream(kModelSampleRate, 1);
  stream.Push(mono);
  stream.Finish();
  constexpr int64_t kRows = kWindowSeconds * int64_t{30};
  std::vector<double> loudness;
  for (int64_t row = 0; row + kRows <= stream.audio_rows(); row += kRows) {
    double power = 0;
    for (int64_t r = row; r < row + kRows; ++r) power += stream.Sound(r).power;
    loudness.push_back(Loudness(power / kRows));
  }
  return loudness;
}

double CorrelationOf(const std::vector<float>& mono, std::span<const float> speeds) {
  constexpr size_t kFrames = kWindowSeconds * size_t{30};
  std::vector<double> loudness = LoudnessOf(mono), moved;
  for (size_t i = 0; i < loudness.size() && (i + 1) * kFrames <= speeds.size(); ++i)
    moved.push_back(Mean(speeds.subspan(i * kFrames, kFrames)));
  loudness.resize(moved.size());
  return Correlation(loudness, moved);
}

struct Parts {
  double drums = 0, pad = 0, silence = 0;  // m/s

  void Add(const Parts& other) {
    drums += other.drums;
    pad += other.pad;
    silence += other.silence;
  }
  void Print(const char* name) const {
    std::printf(
        "%-34s drums %.2f, pad %.2f, silence %.2f m/s; drums / pad %.2f, silence / drums "
        "%.2f\n",
        name, drums / kSeeds, pad / kSeeds, silence / kSeeds, drums / pad, silence / drums);
  }
};

std::vector<float> MakePart(uint64_t seed, bool only_pad) {
  return MakeSong({.seed = seed,
                   .seconds = kPartSeconds,
                   .tempo = {{0, 90 + 10 * static_cast<double>(seed % 5)}},
                   .only_pad = only_pad})
      .mono;
}

void JudgeParts(SampleQueue& queue, uint64_t first_seed, double dynamics) {
  Parts apart, within;
  for (uint64_t i = 0; i < kSeeds; ++i) {
    const std::vector<float> drums = MakePart(first_seed + i, false);
    const std::vector<float> pad = MakePart(first_seed + i, true);
    const std::vector<float> silence(drums.size());
    const auto alone = [&](const std::vector<float>& mono) {
      const std::vector<float> speeds = Dance(queue, mono, i, dynamics);
      return Mean(std::span(speeds).subspan(kSettles));
    };
    apart.Add({alone(drums), alone(pad), alone(silence)});
    std::vector<float> song;
    for (const auto* part : {&drums, &pad, &drums, &silence, &drums})
      song.insert(song.end(), part->begin(), part->end());
    const std::vector<float> speeds = Dance(queue, song, i, dynamics);
    constexpr size_t kPart = kPartSeconds * size_t{30};
    const auto part = [&](size_t at) {
      const size_t from = at * kPart + kSettles, to = std::min((at + 1) * kPart, speeds.size());
      return Mean(std::span(speeds).subspan(from, to - from));
    };
    within.Add({(part(0) + part(2) + part(4)) / 3, part(1), part(3)});
  }
  apart.Print("  a song each");
  within.Print("  one song");
}

void JudgeSong(SampleQueue& queue, const std::string& name, const std::vector<float>& mono,
               double dynamics) {
  double speed = 0, correlation = 0;
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    const std::vector<float> speeds = Dance(queue, mono, seed, dynamics);
    speed += Mean(speeds) / kSeeds;
    correlation += CorrelationOf(mono, speeds) / kSeeds;
  }
  std::printf("  %-32s %.2f m/s; correlation of loudness and speed %.2f\n", name.c_str(), speed,
              correlation);
  std::fflush(stdout);
}

// Mean distance of joints, metres, both dancers standing at one place, facing one way.
double Apart(const Skeleton& skeleton, std::span<const Pose> a, std::span<const Pose> b) {
  double sum = 0;
  const size_t frames = std::min(a.size(), b.size());
  for (size_t i = 0; i < frames; ++i) {
    const auto joints = [&](const Pose& pose) {
      return JointPositions(skeleton, GroundFrame::Of(pose).ToLocal(pose));
    };
    sum += (joints(a[i]) - joints(b[i])).colwise().norm().mean();
  }
  return sum / static_cast<double>(frames);
}

/// Songs whose first part returns twice: how far apart dances of it are, and of parts that differ.
void JudgeForm(SampleQueue& queue, uint64_t first_seed, double variation) {
  double same = 0, other = 0, songs = 0, seeds = 0;
  const Skeleton& skeleton = queue.model().skeleton;
  for (uint64_t i = 0; i < kSeeds; ++i) {
    const auto part = [&](uint64_t nth) { return MakePart(first_seed + 20 + 3 * i + nth, false); };
    std::vector<float> song;
    for (const uint64_t nth : {0, 1, 0, 2, 0}) {
      const std::vector<float> next = part(nth);
      song.insert(song.end(), next.begin(), next.end());
    }
    DanceConfig config;
    config.seed = i;
    config.variation = variation;
    config.music_beats = FindBeats(song).Seconds();
    config.music_passages = FindPassages(song, config.music_beats);
    const std::vector<Pose> danced = Poses(queue, song, config);
    const auto apart = [&](size_t a, size_t b) {
      constexpr size_t kPart = kPartSeconds * size_t{30};
      const auto of = [&](size_t nth) {
        return std::span(danced).subspan(nth * kPart + kSettles, kPart - kSettles);
      };
      return Apart(skeleton, of(a), of(b));
    };
    same += (apart(0, 2) + apart(0, 4) + apart(2, 4)) / 3;
    other += (apart(0, 1) + apart(0, 3) + apart(1, 2) + apart(2, 3)) / 4;
    const auto alone = [&](uint64_t nth, uint64_t seed) {
      DanceConfig once;
      once.seed = seed;
      return Poses(queue, part(nth), once);
    };
    const std::vector<Pose> first = alone(0, i);
    songs += Apart(skeleton, first, alone(1, i));
    seeds += Apart(skeleton, first, alone(0, i + kSeeds));
  }
  std::printf(
      "--variation %.2f\n  a part that returns %.1f cm apart, other parts %.1f: %.2f; two songs "
      "%.1f cm, two seeds %.1f: %.2f\n",
      variation, 100 * same / kSeeds, 100 * other / kSeeds, same / other, 100 * songs / kSeeds,
      100 * seeds / kSeeds, songs / seeds);
  std::fflush(stdout);
}

}  // namespace
}  // namespace choreo::bench

int main(int argc, char** argv) {
  using namespace choreo;
  CLI::App program("Measures how far free dances show what is heard, over three seeds.");
  std::string model = "model/checkpoints/default.safetensors";
  std::vector<std::string> songs;
  std::vector<double> dynamics{0, kUsualDynamics, 1}, variations{0, kUsualVariation, 1};
  uint64_t first_seed = 2'000'000;
  program.add_option("songs", songs, "Songs that are danced to.")->check(CLI::ExistingFile);
  program.add_option("--model", model, "Checkpoint")->capture_default_str();
  program.add_option("--music-dynamics", dynamics, "DanceConfig::music_dynamics, each in turn")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  program.add_option("--variation", variations, "DanceConfig::variation, each in turn")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  program.add_option("--made", first_seed, "First seed of the made songs")->capture_default_str();
  CLI11_PARSE(program, argc, argv);
  std::vector<std::unique_ptr<Sampler>> samplers;
  samplers.push_back(MakeSampler(model, Device{}));
  SampleQueue queue(std::move(samplers), {});
  for (const double variation : variations) bench::JudgeForm(queue, first_seed, variation);
  for (const double share : dynamics) {
    std::printf("--music-dynamics %.2f\n", share);
    bench::JudgeParts(queue, first_seed, share);
    for (uint64_t i = 0; i < 3; ++i) {
      const std::vector<SongPlan::Span> quiet{{0, 12}, {40, 56}};
      const MadeSong made =
          MakeSong({.seed = first_seed + 10 + i, .seconds = 80, .without_drums = quiet});
      bench::JudgeSong(queue, "made, an intro and a break", made.mono, share);
    }
    for (const std::string& path : songs) {
      bench::JudgeSong(queue, std::filesystem::path(path).stem(),
                       ToModelRate(DecodeAudioFile(path)), share);
    }
  }
  return 0;
}
