#include "model/audio/music/made_song.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <span>
#include <string_view>

#include "model/audio/signal/format.h"

namespace choreo {
namespace {

constexpr double kRate = kModelSampleRate;
constexpr double kTurn = 2 * std::numbers::pi;

/// One bar of drums, a letter per step: x loud, o soft. All strings of a groove have equal length.
struct Groove {
  std::string_view name, kick, snare, hat;
  double slowest, fastest;  // bpm at which people play it
};

constexpr auto kFourGrooves = std::to_array<Groove>({
    {"rock", "x.......x.......", "....x.......x...", "x.x.x.x.x.x.x.x.", 50, 200},
    {"rock, pushed", "x.....x.x.......", "....x.......x...", "x.x.x.x.x.x.x.x.", 50, 200},
    {"ballad", "x.......x.......", "....x.......x...", "x...x...x...x...", 50, 200},
    {"house", "x...x...x...x...", "....x.......x...", "..x...x...x...x.", 90, 150},
    {"disco", "x...x...x...x...", "....x.......x...", "x.ooxxoox.ooxxoo", 90, 140},
    {"funk", "x..x..x...x.x...", "....x..o.o..x..o", "xoxoxoxoxoxoxoxo", 50, 125},
    {"breakbeat", "x.........x.....", "....x.......x...", "x.x.x.x.x.x.x.x.", 90, 200},
    {"pop", "x..x..x.x.....x.", "....x.......x...", "x.x.x.x.x.x.x.x.", 50, 150},
    {"metal", "xoxoxoxoxoxoxoxo", "....x.......x...", "x...x...x...x...", 100, 200},
    {"gallop", "x.xxx.xxx.xxx.xx", "....x.......x...", "x...x...x...x...", 110, 200},
    {"double kick", "x.x.x.x.x.x.x.x.", "....x.......x...", "x...x...x...x...", 100, 200},
    {"blast", "x.x.x.x.x.x.x.x.", ".x.x.x.x.x.x.x.x", "x...x...x...x...", 130, 200},
    {"hard rock", "x...x...x.x.x...", "....x.......x...", "x...x...x...x...", 70, 200},
    {"one and three", "x.......x.......", "................", "x.x.x.x.x.x.x.x.", 60, 200},
    {"claps", "x.....x...x.....", "....x.......x...", "................", 70, 180},
    {"march", "x...x...x...x...", "..o.x.o...o.x.oo", "................", 70, 200},
    {"sixteenths", "x......xx.......", "....x.......x...", "xoxoxoxoxoxoxoxo", 50, 110},
});
constexpr auto kSwingGrooves = std::to_array<Groove>({
    {"shuffle", "x.....x.....", "...x.....x..", "x.xx.xx.xx.x", 60, 190},
    {"jazz", "o..o..o..o..", "...o.....o..", "x..x.xx..x.x", 80, 200},
    {"blues", "x..x..x..x..", "...x.....x..", "x.xx.xx.xx.x", 50, 150},
});
constexpr auto kThreeGrooves = std::to_array<Groove>({
    {"waltz", "x...........", "....x...x...", "x...x...x...", 50, 200},
    {"waltz in eighths", "x.........o.", "....x...x...", "x.x.x.x.x.x.", 50, 200},
    {"three with a backbeat", "x.....o.....", "........x...", "x.x.x.x.x.x.", 50, 180},
});
constexpr auto kSixGrooves = std::to_array<Groove>({
    {"six", "x...........", "......x.....", "x.o.o.x.o.o.", 40, 120},
    {"six, pushed", "x...x.......", "......x.....", "x.x.x.x.x.x.", 40, 120},
    {"slow six", "x.........o.", "......x.....", "x.x.x.x.x.x.", 40, 90},
});

int BeatsOf(Meter meter) { return meter == Meter::kFour ? 4 : meter == Meter::kThree ? 3 : 2; }

std::span<const Groove> GroovesOf(const SongPlan& plan) {
  if (plan.swing) return kSwingGrooves;
  if (plan.meter == Meter::kThree) return kThreeGrooves;
  if (plan.meter == Meter::kSix) return kSixGrooves;
  return kFourGrooves;
}

double TempoAt(const std::vector<SongPlan::Tempo>& tempo, double second) {
  const auto next = std::ranges::upper_bound(tempo, second, {}, &SongPlan::Tempo::second);
  if (next == tempo.begin()) return next->bpm;
  const SongPlan::Tempo& before = *(next - 1);
  if (next == tempo.end()) return before.bpm;
  return std::lerp(before.bpm, next->bpm,
                   (second - before.second) / (next->second - before.second));
}

bool IsIn(const std::vector<SongPlan::Span>& spans, double second) {
  return std::ranges::any_of(
      spans, [=](const SongPlan::Span& span) { return second >= span.begin && second < span.end; });
}

class Player {
 public:
  explicit Player(const SongPlan& plan)
      : plan_(plan), random_(static_cast<uint32_t>(plan.seed * 2654435761U + 12345)) {
    song_.mono.resize(static_cast<size_t>(plan.seconds * kRate));
  }

  MadeSong Play() {
    const double offset = Draw(0.1, 0.9);  // the first beat is not the first sample
    for (double at = offset; at < plan_.seconds; at += 60 / TempoAt(plan_.tempo, at))
      times_.push_back(at);
    const auto bar = static_cast<size_t>(BeatsOf(plan_.meter));
    for (size_t beat = 0; beat < times_.size(); ++beat) {
      if (IsIn(plan_.silent, times_[beat])) continue;
      song_.beats.push_back(times_[beat]);
      if (beat % bar == 0) song_.downbeats.push_back(times_[beat]);
    }
    ChooseBand();
    for (size_t beat = 0; beat < times_.size(); beat += bar) PlayBar(beat, bar);
    Master();
    return std::move(song_);
  }

 private:
  double Draw(double least, double most) {
    return least + (most - least) * static_cast<double>(random_()) / 4294967296.0;
  }
  size_t Pick(size_t count) { return random_() % count; }
  bool Chance(double share) { return Draw(0, 1) < share; }

  void ChooseBand() {
    double slow = 1e9, fast = 0;
    for (const SongPlan::Tempo& tempo : plan_.tempo) {
      slow = std::min(slow, tempo.bpm);
      fast = std::max(fast, tempo.bpm);
    }
    std::vector<const Groove*> fitting;
    for (const Groove& groove : GroovesOf(plan_)) {
      if (groove.slowest <= slow && groove.fastest >= fast) fitting.push_back(&groove);
    }
    if (fitting.empty()) fitting.push_back(&GroovesOf(plan_).front());
    groove_ = fitting[Pick(fitting.size())];
    song_.groove = groove_->name;
    root_ = 41.2 * std::exp2(Draw(0, 1));
    is_minor_ = Chance(0.5);
    jitter_ = Draw(0, 0.008);
    drums_ = Draw(0.25, 0.9);
    kick_hz_ = Draw(42, 65);
    snare_hz_ = Draw(160, 230);
    bass_ = Draw(0.1, 0.4);
    chords_ = Draw(0.05, 0.3);
    lead_ = Chance(0.6) ? Draw(0.03, 0.15) : 0;
    bass_style_ = Pick(4);
    chord_style_ = Pick(5);
    drive_ = Chance(0.4) ? Draw(2, 8) : 1;
    echo_ = Chance(0.5) ? Draw(0.1, 0.5) : 0;
    mute_ = Pick(3);
  }

  /// The time, in seconds, of a step of a bar that begins with `beat`.
  double At(size_t beat, double beats) const {
    const auto whole = static_cast<size_t>(beats);
    const size_t i = std::min(beat + whole, times_.size() - 1);
    const double step = 60 / TempoAt(plan_.tempo, times_[i]);
    return times_[i] + (beats - static_cast<double>(i - beat)) * step;
  }

  void PlayBar(size_t beat, size_t bar) {
    static constexpr std::array<int, 8> kProgression{0, 5, 3, 4, 0, 3, 5, 4};
    static constexpr std::array<double, 7> kMajor{0, 2, 4, 5, 7, 9, 11},
        kMinor{0, 2, 3, 5, 7, 8, 10};
    const auto& scale = is_minor_ ? kMinor : kMajor;
    const auto tone = [&](int degree) {
      const int octave = degree / 7;
      return root_ * std::exp2(octave + scale[static_cast<size_t>(degree % 7)] / 12);
    };
    const size_t number = beat / bar;
    const int chord = kProgression[number % kProgression.size()];
    const double begin = times_[beat], length = At(beat, static_cast<double>(bar)) - begin;
    const std::array<double, 3> tones{tone(chord + 7), tone(chord + 9), tone(chord + 11)};
    if (plan_.only_pad || chord_style_ == 0) {
      for (const double hz : tones) Pad(begin, length, 2 * hz, chords_);
      if (plan_.only_pad) return;
    }
    const bool drums = !IsIn(plan_.without_drums, begin);
    const size_t steps = groove_->kick.size();
    const double beats_a_step = static_cast<double>(bar) / static_cast<double>(steps);
    // Every eighth bar is a fill; a crash marks its end.
    const bool fills = drums && number % 8 == 7, crash = drums && number % 8 == 0;
    if (crash) Noise(begin, 0.4 * drums_, 1.2, 3000);
    const size_t division = steps / bar;  // per beat
    for (size_t step = 0; step < steps; ++step) {
      const double beats = beats_a_step * static_cast<double>(step);
      if (beat + static_cast<size_t>(beats) >= times_.size()) break;
      const double at = At(beat, beats);
      if (drums) PlayDrums(at, step, fills && 4 * step >= 3 * steps);
      const bool eighth = division == 4 ? step % 2 == 0
                          : plan_.swing ? step % 3 != 1
                                        : step % 2 == 0;
      PlayTones(at, step, division, eighth, beats_a_step * 60 / TempoAt(plan_.tempo, at),
                tone(chord), tones);
    }
  }

  void PlayDrums(double at, size_t step, bool fill) {
    const auto level = [&](std::string_view part) {
      return (part[step] == 'x' ? 1 : part[step] == 'o' ? 0.4 : 0) * Draw(0.8, 1.1) * drums_;
    };
    const double second = at + Draw(-jitter_, jitter_);
    if (const double kick = level(groove_->kick); kick > 0)
      Tone(
          second, 0.18, [=, this](double t) { return kick_hz_ * (1 + 1.6 * std::exp(-t / 0.03)); },
          0.9 * kick, 14);
    if (const double snare = level(groove_->snare); snare > 0) {
      Noise(second, 0.5 * snare, 0.12, 900);
      Tone(
          second, 0.1, [this](double) { return snare_hz_; }, 0.4 * snare, 25);
    }
    if (const double hat = level(groove_->hat); hat > 0) Noise(second, 0.22 * hat, 0.04, 6000);
    if (fill && Chance(0.5))
      Tone(
          second, 0.15, [this](double) { return 2 * kick_hz_; }, 0.4 * drums_, 18);
  }

  void PlayTones(double at, size_t step, size_t division, bool eighth, double length, double root,
                 const std::array<double, 3>& tones) {
    const double second = at + Draw(-jitter_, jitter_);
    const bool on_beat = step % division == 0;
    const bool with_kick = groove_->kick[step] != '.';
    const bool bass = bass_style_ == 0   ? step == 0
                      : bass_style_ == 1 ? with_kick || step == 0
                      : bass_style_ == 2 ? eighth
                                         : on_beat;
    if (bass)
      String(second, 2 * length * (bass_style_ == 0 ? 4 : 1), root, bass_ * Draw(0.8, 1.1), 4);
    // Stabs between the beats, strummed eighths, and broken chords.
    if (chord_style_ == 1 && eighth && !on_beat) {
      for (const double hz : tones) String(second, length, hz, 0.6 * chords_, 8);
    } else if (chord_style_ == 2 && eighth) {
      for (const double hz : {tones[0], 1.5 * tones[0], 2 * tones[0]})
        String(second, 2 * length, hz, chords_ * (on_beat ? 1 : 0.8), 12);
    } else if (chord_style_ == 3 && eighth) {
      String(second, 3 * length, 2 * tones[(step / 2) % 3], 1.2 * chords_, 6);
    } else if (chord_style_ == 4 && (eighth || mute_ > 0)) {
      // Distorted and palm-muted, also in sixteenths or a gallop; rings where chords change.
      if (mute_ == 2 && step % 4 == 1) return;
      const bool rings = step == 0 || (on_beat && Chance(0.2));
      Guitar(second, rings ? 6 * length : length, tones[0] / 2, chords_ * Draw(0.7, 1.1));
    }
    if (lead_ > 0 && eighth && Chance(on_beat ? 0.5 : 0.25))
      String(second, length * Draw(2, 5), 4 * tones[Pick(3)], lead_, 3);
  }

  void Add(double second, double length, const std::function<double(double)>& wave) {
    const auto first = static_cast<int64_t>(second * kRate);
    const auto count = static_cast<int64_t>(length * kRate);
    for (int64_t i = std::max<int64_t>(0, -first); i < count; ++i) {
      if (first + i >= std::ssize(song_.mono)) break;
      song_.mono[static_cast<size_t>(first + i)] +=
          static_cast<float>(wave(static_cast<double>(i) / kRate));
    }
  }
  /// A sine whose pitch may glide.
  void Tone(double second, double length, const std::function<double(double)>& hz, double level,
            double decay) {
    double phase = 0;
    Add(second, length, [&](double t) {
      phase += hz(t) / kRate;
      return level * std::exp(-decay * t) * std::sin(kTurn * phase);
    });
  }
  /// Noise roughly above `hz`.
  void Noise(double second, double level, double length, double hz) {
    const double keep = std::exp(-kTurn * hz / kRate);
    double low = 0;
    Add(second, 3 * length, [&](double t) {
      const double white = Draw(-1, 1);
      low = keep * low + (1 - keep) * white;
      return level * std::exp(-t / length) * (white - low);
    });
  }
  /// A few harmonics; higher ones fade faster.
  void String(double second, double length, double hz, double level, double brightness) {
    Add(second, length, [=](double t) {
      double sum = 0;
      for (int k = 1; k <= 6 && k * hz < 9000; ++k)
        sum += std::exp(-t * k * 3) * std::sin(kTurn * hz * k * t) *
               std::min(1.0, brightness / (k * k));
      return level * std::min(1.0, t / 0.004) * std::min(1.0, (length - t) / 0.02) * sum;
    });
  }
  /// A fifth through a distorting amplifier, with the pick's attack.
  void Guitar(double second, double length, double hz, double level) {
    double low = 0;
    Add(second, length, [&, hz, level, length](double t) {
      const double fade =
          std::exp(-t * (length > 0.3 ? 1 : 12)) * std::min(1.0, (length - t) / 0.01);
      double sum = 0;
      for (int k = 1; k <= 5; ++k)
        sum += (std::sin(kTurn * hz * k * t) + std::sin(kTurn * 1.5 * hz * k * t)) / k;
      const double pick = Draw(-1, 1) * std::exp(-t / 0.01);
      low = 0.6 * low + 0.4 * std::tanh(6 * (sum * fade + pick));
      return level * low * fade;
    });
  }
  void Pad(double second, double length, double hz, double level) {
    Add(second, 1.1 * length, [=](double t) {
      const double swell = std::sin(std::numbers::pi * t / (1.1 * length));
      return 0.5 * level * swell *
             (std::sin(kTurn * hz * t) + 0.5 * std::sin(kTurn * 1.003 * hz * t));
    });
  }

  void Master() {
    if (echo_ > 0) {  // a room: three combs, like Schroeder's
      const std::vector<float> dry = song_.mono;
      for (const int64_t delay : {617, 787, 1051}) {
        std::vector<float> wet(dry.size());
        for (int64_t i = delay; i < std::ssize(wet); ++i)
          wet[i] = static_cast<float>(0.75) * wet[i - delay] + dry[i - delay];
        for (size_t i = 0; i < wet.size(); ++i)
          song_.mono[i] += static_cast<float>(echo_ / 3) * wet[i];
      }
    }
    double loudest = 1e-9;
    for (const float sample : song_.mono) loudest = std::max(loudest, double{std::abs(sample)});
    const double gain = std::exp(Draw(std::log(0.05), 0.0)), floor = std::exp(Draw(-11, -6));
    for (size_t i = 0; i < song_.mono.size(); ++i) {
      const double hiss = floor * Draw(-1, 1);
      float& sample = song_.mono[i];
      sample = static_cast<float>(gain * std::tanh(drive_ * sample / loudest + hiss) /
                                  std::tanh(drive_));
      if (IsIn(plan_.silent, static_cast<double>(i) / kRate)) sample = 0;
    }
  }

  const SongPlan& plan_;
  std::mt19937 random_;
  MadeSong song_;
  std::vector<double> times_;  // of all beats, silent ones included
  const Groove* groove_ = nullptr;
  double root_ = 0, jitter_ = 0, drums_ = 0, kick_hz_ = 0, snare_hz_ = 0, bass_ = 0, chords_ = 0,
         lead_ = 0, drive_ = 1, echo_ = 0;
  bool is_minor_ = false;
  size_t bass_style_ = 0, chord_style_ = 0, mute_ = 0;
};

}  // namespace

MadeSong MakeSong(const SongPlan& plan) { return Player(plan).Play(); }

}  // namespace choreo
