#include "model/evaluation/tables/hearing_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "model/audio/beats/beats.h"
#include "model/audio/music/feature_stream.h"
#include "model/audio/music/made_song.h"
#include "model/audio/music/music_analysis.h"
#include "model/audio/music/music_id.h"
#include "model/evaluation/judges/heard_dance.h"
#include "model/evaluation/tables/beat_table.h"
#include "model/metrics/joint_track.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo {
namespace {

constexpr int kHeardSeconds = 4;
constexpr size_t kHeardFrames = kHeardSeconds * size_t{30};
// Frames at the start of a part that do not count, because their transition began with the music of
// the part before.
constexpr size_t kSettles = 2 * kTypicalFrames;
constexpr double kSongSeconds = 80, kHitSeconds = 60;

// Seconds of a song before its drop, of the calm that precedes it, and after it.
constexpr double kBeforeDrop = 20, kCalm = 6, kAfterDrop = 12;
// Three seeds give 36 dances. With 12, the burst would come after 0.4 to 1.7 s, by chance.
constexpr int kDropsASeed = 12;
// A synthetic song begins with up to kMadeLead seconds of hiss. Drums may sound kEarlyDrums seconds
// before a beat.
constexpr double kMadeLead = 1, kEarlyDrums = 0.01;
// The frames with which a response is compared: before the drop, and after the dance has settled.
constexpr size_t kBefore = 60, kSettledFrom = 120, kSettledTo = 300;
constexpr size_t kSmooth = 11;  // frames of a moving mean

struct Setting {
  const char* name;
  bool live = false;  // the music is not known before it sounds
  double dynamics = kDefaultDynamics, variation = kDefaultVariation;
};
constexpr Setting kSettings[] = {{"usual"},
                                 {.name = "live", .live = true},
                                 {.name = "music_dynamics 0", .dynamics = 0},
                                 {.name = "variation 0", .variation = 0},
                                 {.name = "variation 1", .variation = 1}};
constexpr const Setting &kUsual = kSettings[0], &kLive = kSettings[1];
// Settings that change how music moves a dance, when it does, and whether it repeats.
const std::vector<const Setting*> kEnergetic{&kUsual, &kLive, &kSettings[2]},
    kTimely{&kUsual, &kLive}, kVaried{&kUsual, &kLive, &kSettings[3], &kSettings[4]},
    kOnlyUsual{&kUsual};

double MeanOf(std::span<const float> values) {
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
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : NAN;
}

/// LUFS of each window.
std::vector<double> LoudnessOf(std::span<const float> mono) {
  const std::vector<RowSound> rows = SoundsOf(mono);
  std::vector<double> loudness;
  for (size_t first = 0; first + kHeardFrames <= rows.size(); first += kHeardFrames) {
    double power = 0;
    for (const RowSound& row : std::span(rows).subspan(first, kHeardFrames)) power += row.power;
    loudness.push_back(Loudness(power / kHeardFrames));
  }
  return loudness;
}

/// A synthetic song of `seconds` that begins with its first beat.
std::vector<float> FromFirstBeat(uint64_t seed, double seconds) {
  MadeSong song = MakeSong({.seed = seed, .seconds = seconds + kMadeLead});
  const auto at = [](double second) { return std::llround(second * kModelSampleRate); };
  song.mono.erase(song.mono.begin(), song.mono.begin() + at(song.beats.front() - kEarlyDrums));
  song.mono.resize(static_cast<size_t>(at(seconds)));
  return std::move(song.mono);
}

/// Joins parts into a song.
std::vector<float> Join(std::initializer_list<const std::vector<float>*> parts) {
  std::vector<float> song;
  for (const std::vector<float>* part : parts) song.insert(song.end(), part->begin(), part->end());
  return song;
}

/// The mean distance of joints, metres, with both dancers moved to one place and heading.
double Apart(const Skeleton& skeleton, std::span<const Pose> a, std::span<const Pose> b) {
  const auto joints = [&](const Pose& pose) {
    return JointPositions(skeleton, GroundFrame::Of(pose).ToLocal(pose));
  };
  double sum = 0;
  const size_t frames = std::min(a.size(), b.size());
  for (size_t i = 0; i < frames; ++i) sum += (joints(a[i]) - joints(b[i])).colwise().norm().mean();
  return sum / static_cast<double>(frames);
}

class Judge {
 public:
  Judge(SampleQueue& queue, const HearingOptions& options, Table* table)
      : queue_(queue), skeleton_(queue.model().skeleton), options_(options), table_(*table) {}

  void Parts();
  void Loudness(const std::string& name, const std::vector<std::vector<float>>& songs);
  /// Measures the seconds from a drop, after a calm part (a pad or silence), to the dance's
  /// response.
  void Drops(const std::string& calm, bool is_pad);
  void Form();
  void Hits();
  /// Adds the figures of all dances so far.
  void Fastest();

 private:
  /// Adds a figure at the settings that it depends on, `matters`, and a dash for others.
  template <typename Figure>
  void Row(const std::string& label, int digits, const std::vector<const Setting*>& matters,
           Figure of) {
    table_.AddRow({label});
    for (const Setting& setting : kSettings) {
      const bool applies = std::ranges::count(matters, &setting) > 0;
      table_.Put(setting.name, digits, applies ? of(setting) : NAN);
    }
  }
  std::vector<Pose> Dance(const std::vector<float>& mono, int seed, const Setting& setting) {
    DanceConfig config;
    config.seed = static_cast<uint64_t>(seed);
    config.music_dynamics = setting.dynamics;
    config.variation = setting.variation;
    if (!setting.live) Know(mono, &config);
    return Dance(mono, config, setting);
  }
  /// Fills in the facts that a song's file provides, as `choreo dance` does.
  void Know(const std::vector<float>& mono, DanceConfig* config) {
    const uint64_t id = MusicId(mono);
    if (!known_.contains(id)) known_[id] = AnalyseMusic(mono);
    const MusicAnalysis& music = known_[id];
    config->music_beats = music.beats;
    config->music_downbeats = music.downbeats;
    config->music_passages = music.passages;
    config->music_energies = music.energies;
  }
  std::vector<Pose> Dance(std::span<const float> mono, const DanceConfig& config,
                          const Setting& setting, std::span<const Key> keys = {},
                          const ControlRequest& controls = {}) {
    std::vector<Pose> dance = setting.live ? DanceLiveTo(queue_, mono, config)
                                           : DanceTo(queue_, mono, config, keys, controls);
    Tally& tally = tallies_[setting.name];
    ++tally.dances;
    const std::vector<float> speeds = Speeds(dance);
    tally.exploded += std::ranges::max(speeds) > options_.top_speed;
    tally.frames += static_cast<double>(speeds.size());
    tally.rare += static_cast<double>(
        std::ranges::count_if(speeds, [this](float speed) { return speed > options_.rare_speed; }));
    return dance;
  }
  std::vector<float> Speeds(std::span<const Pose> dance) const {
    return MeanSpeeds(TrackJoints(skeleton_, dance), kModelFps);
  }
  std::vector<float> MakePart(uint64_t nth, bool only_pad) const {
    const uint64_t seed = options_.first_seed + nth;
    return MakeSong({.seed = seed,
                     .seconds = static_cast<double>(options_.part_seconds),
                     .tempo = {{0, 90 + 10 * static_cast<double>(seed % 5)}},
                     .only_pad = only_pad})
        .mono;
  }
  size_t part_frames() const { return static_cast<size_t>(options_.part_seconds) * 30; }
  /// The values judged in the nth part.
  template <typename Values>
  auto Part(const Values& of_frames, size_t nth) const {
    const size_t from = nth * part_frames() + kSettles;
    return std::span(of_frames).subspan(
        from, std::min((nth + 1) * part_frames(), of_frames.size()) - from);
  }
  struct HitRate {
    double percent = 0, chance = 0;
  };
  HitRate HitsOf(const MadeSong& song, const std::vector<Pose>& dance) const;

  struct Tally {
    double dances = 0, exploded = 0, frames = 0, rare = 0;
  };

  SampleQueue& queue_;
  const Skeleton& skeleton_;
  const HearingOptions& options_;
  Table& table_;
  std::map<std::string, Tally> tallies_;     // by setting
  std::map<uint64_t, MusicAnalysis> known_;  // by MusicId
};

void Judge::Parts() {
  struct Speed {
    double drums = 0, pad = 0, silence = 0;
  };
  std::map<std::string, Speed> speeds;
  for (const Setting* setting : kEnergetic) {
    for (int i = 0; i < options_.seeds; ++i) {
      const auto nth = static_cast<uint64_t>(i);
      const std::vector<float> drums = MakePart(nth, false), pad = MakePart(nth, true);
      const std::vector<float> silence(drums.size());
      const std::vector<float> danced =
          Speeds(Dance(Join({&drums, &pad, &drums, &silence, &drums}), i, *setting));
      Speed& speed = speeds[setting->name];
      for (const size_t part : {0, 2, 4}) speed.drums += MeanOf(Part(danced, part)) / 3;
      speed.pad += MeanOf(Part(danced, 1));
      speed.silence += MeanOf(Part(danced, 3));
    }
  }
  Row("drums ÷ pad", 2, kEnergetic, [&](const Setting& setting) {
    return speeds[setting.name].drums / speeds[setting.name].pad;
  });
  Row("silence ÷ drums", 2, kEnergetic, [&](const Setting& setting) {
    return speeds[setting.name].silence / speeds[setting.name].drums;
  });
}

void Judge::Loudness(const std::string& name, const std::vector<std::vector<float>>& songs) {
  Row("loudness and speed, " + name, 2, kEnergetic, [&](const Setting& setting) {
    double sum = 0;
    for (const std::vector<float>& song : songs) {
      for (int seed = 0; seed < options_.seeds; ++seed) {
        const std::vector<float> speeds = Speeds(Dance(song, seed, setting));
        std::vector<double> loudness = LoudnessOf(song), moved;
        for (size_t i = 0; i < loudness.size() && (i + 1) * kHeardFrames <= speeds.size(); ++i)
          moved.push_back(MeanOf(std::span(speeds).subspan(i * kHeardFrames, kHeardFrames)));
        loudness.resize(moved.size());
        sum += Correlation(loudness, moved);
      }
    }
    return sum / static_cast<double>(songs.size()) / options_.seeds;
  });
}

void Judge::Drops(const std::string& calm, bool is_pad) {
  const auto lateness = [&](const Setting& setting) {
    std::vector<double> speeds(kBefore + kSettledTo);  // around the drop, mean of all dances
    const int dances = kDropsASeed * options_.seeds;
    for (int i = 0; i < dances; ++i) {
      // Transitions begin every two seconds; drops fall anywhere in them.
      const double drop = kBeforeDrop + 2.0 * i / dances;
      const uint64_t seed = options_.first_seed + 60 + static_cast<uint64_t>(i);
      const auto part = [&](double seconds, bool only_pad) {
        return MakeSong({.seed = seed, .seconds = seconds, .only_pad = only_pad}).mono;
      };
      const std::vector<float> drums = part(drop - kCalm, false),
                               burst = FromFirstBeat(seed, kAfterDrop);
      std::vector<float> quiet = part(kCalm, true);
      if (!is_pad) std::ranges::fill(quiet, 0.0F);
      const std::vector<float> danced = Speeds(Dance(Join({&drums, &quiet, &burst}), i, setting));
      const size_t first = static_cast<size_t>(std::lround(drop * kModelFps)) - kBefore;
      for (size_t frame = 0; frame < speeds.size(); ++frame)
        speeds[frame] += danced[first + frame] / dances;
    }
    const auto mean = [&](size_t from, size_t to) {
      double sum = 0;
      for (size_t frame = from; frame < to; ++frame) sum += speeds[frame];
      return sum / static_cast<double>(to - from);
    };
    const double half = (mean(0, kBefore) + mean(kBefore + kSettledFrom, kBefore + kSettledTo)) / 2;
    size_t frame = kBefore;
    while (frame + kSmooth / 2 + 1 < speeds.size() &&
           mean(frame - kSmooth / 2, frame + kSmooth / 2 + 1) < half)
      ++frame;
    return static_cast<double>(frame - kBefore) / kModelFps;
  };
  Row("seconds from a drop after " + calm + " to the burst", 2, kTimely, lateness);
}

void Judge::Form() {
  double songs = 0, seeds = 0;
  Row("a part again ÷ another part", 2, kVaried, [&](const Setting& setting) {
    double same = 0, other = 0;
    for (int i = 0; i < options_.seeds; ++i) {
      const uint64_t first = 20 + 3 * static_cast<uint64_t>(i);
      const std::vector<float> a = MakePart(first, false), b = MakePart(first + 1, false),
                               c = MakePart(first + 2, false);
      const std::vector<float> song = Join({&a, &b, &a, &c, &a});
      const std::vector<Pose> dance = Dance(song, i, setting);
      const auto apart = [&](size_t one, size_t two) {
        return Apart(skeleton_, Part(dance, one), Part(dance, two));
      };
      same += (apart(0, 2) + apart(0, 4) + apart(2, 4)) / 3;
      other += (apart(0, 1) + apart(0, 3) + apart(1, 2) + apart(2, 3)) / 4;
      if (&setting != &kUsual) continue;
      const std::vector<Pose> alone = Dance(a, i, setting);
      songs += Apart(skeleton_, alone, Dance(b, i, setting));
      seeds += Apart(skeleton_, alone, Dance(a, i + options_.seeds, setting));
    }
    return same / other;
  });
  Row("two songs ÷ two seeds", 2, kOnlyUsual, [&](const Setting&) { return songs / seeds; });
}

Judge::HitRate Judge::HitsOf(const MadeSong& song, const std::vector<Pose>& dance) const {
  const std::vector<float> speeds = Speeds(dance);
  const auto hits = [&](double moved) {
    std::vector<double> beats;
    for (const double beat : song.beats) beats.push_back(beat * kModelFps + moved);
    return 100 * ScoreBeats(speeds, beats, kModelFps).hit_rate;
  };
  const int shifts = static_cast<int>(std::lround(60 * kModelFps / TempoOf(song.beats)));
  HitRate rate{.percent = hits(0)};
  for (int shift = 0; shift < shifts; ++shift) rate.chance += hits(shift) / shifts;
  return rate;
}

void Judge::Hits() {
  std::map<std::string, HitRate> rates;  // by how the dances are led
  for (int i = 0; i < options_.seeds; ++i) {
    const double bpm = 90 + 20 * static_cast<double>(i);
    const MadeSong song = MakeSong({.seed = options_.first_seed + 40 + static_cast<uint64_t>(i),
                                    .seconds = kHitSeconds,
                                    .tempo = {{0, bpm}}});
    const auto add = [&](const char* led, const std::vector<Pose>& dance) {
      const HitRate rate = HitsOf(song, dance);
      rates[led].percent += rate.percent / options_.seeds;
      rates[led].chance += rate.chance / options_.seeds;
    };
    DanceConfig config;
    config.seed = static_cast<uint64_t>(i);
    Know(song.mono, &config);
    const std::vector<Pose> dance = Dance(song.mono, config, kUsual);
    const std::vector<Key> keys = KeysOf(dance);
    const bool takes_path = queue_.model().Supports(kRootPath);
    add("free", dance);
    if (takes_path)
      add("free on a path", Dance(song.mono, config, kUsual, {}, Circle(dance.size())));
    config.seed += static_cast<uint64_t>(options_.seeds);
    add("keyed", Dance(song.mono, config, kUsual, keys));
    if (takes_path)
      add("keyed on a path", Dance(song.mono, config, kUsual, keys, Circle(dance.size())));
  }
  for (const auto& [led, rate] : rates) {
    Row("hits %, " + led, 0, kOnlyUsual, [&](const Setting&) { return rate.percent; });
    Row("hits over chance, " + led + " points", 0, kOnlyUsual,
        [&](const Setting&) { return rate.percent - rate.chance; });
  }
}

void Judge::Fastest() {
  const auto row = [&](const std::string& label, int digits, double Tally::*some,
                       double Tally::*all) {
    Row(label, digits, kEnergetic, [&](const Setting& setting) {
      const Tally& tally = tallies_[setting.name];
      return 100 * tally.*some / tally.*all;
    });
  };
  row("rarely fast frames %", 2, &Tally::rare, &Tally::frames);
  row("exploded %", 0, &Tally::exploded, &Tally::dances);
}

}  // namespace

Table EvaluateHearing(SampleQueue& queue, const std::vector<NamedSong>& songs,
                      const HearingOptions& options) {
  Table table;
  table.name = "hearing";
  table.title = "Is the music heard";
  table.label_headings = {"figure"};
  table.note = std::to_string(options.seeds) + " dances of each song; songs are made from seed " +
               std::to_string(options.first_seed) + " on, and " + std::to_string(songs.size()) +
               " are given.";
  Judge judge(queue, options, &table);
  judge.Parts();
  std::vector<std::vector<float>> made;
  for (int i = 0; i < options.seeds; ++i) {
    made.push_back(MakeSong({.seed = options.first_seed + 10 + static_cast<uint64_t>(i),
                             .seconds = kSongSeconds,
                             .without_drums = {{0, 12}, {40, 56}}})
                       .mono);
  }
  judge.Loudness("made songs with an intro and a break", made);
  for (const NamedSong& song : songs) judge.Loudness(song.name, {song.mono});
  judge.Drops("a pad", true);
  judge.Drops("silence", false);
  judge.Form();
  judge.Hits();
  judge.Fastest();
  return table;
}

}  // namespace choreo
