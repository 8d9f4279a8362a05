#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/audio/beats/onset.h"

namespace choreo {

/// A rhythm pattern: the mean onsets at each position in a bar, relative to their mean over three
/// seconds.
struct BarPattern {
  static constexpr size_t kPlaces = 4;
  using Bands = std::array<double, Onset::kBands>;

  int beats = 4;
  /// Positions within a beat, as shares of it, starting with the beat itself. Only the first
  /// `places` are used.
  std::array<double, kPlaces> place{0, 0.5, 0.25, 0.75};
  size_t places = 4;
  double slowest_bpm = 48, fastest_bpm = 208;
  std::vector<Bands> rise{};  ///< [beat * kPlaces + place]
};

/// The patterns 4/4, 4/4 with triplets, 3/4 and 6/8. Their rises are means over synthetic songs.
std::span<const BarPattern> BarPatterns();

/// Divides onsets by their mean over the last three seconds, per band, so that loud and soft
/// passages look alike. -1 for a silent band. Not thread-safe.
class EvenOnsets {
 public:
  static constexpr float kLoudest = 8;  ///< limits the weight of a crash

  /// Values are capped at `loudest` times the mean.
  explicit EvenOnsets(float loudest = kLoudest) : loudest_(loudest) {}

  std::array<float, Onset::kBands> Even(const Onset& onset);

  /// Starts as if `onsets` had played before. Without it the first onsets weigh too much.
  void Settle(std::span<const Onset> onsets) {
    for (int round = 0; round < kRounds; ++round) {
      for (const Onset& onset : onsets.first(std::min(onsets.size(), kSettled))) Even(onset);
    }
  }

 private:
  static constexpr int kRounds = 4;  // until the mean settles
  static constexpr size_t kSettled = 3 * kModelSampleRate / kOnsetHop;

  float loudest_;
  std::array<double, Onset::kBands> level_{};
};

/// The bar pointer model (Whiteley et al. 2006) on the state space of Krebs et al. 2015: a state is
/// a pattern, a position in its bar (in frames) and a tempo (whole frames per beat). Tempo changes
/// only at beats, and larger changes cost more. Onsets are exponentially distributed around a
/// pattern's means. Frames are pushed one by one. Not thread-safe.
class BarPointer {
 public:
  struct Limits {
    double slowest_bpm = 0, fastest_bpm = 1000;  ///< within the patterns' range
  };
  /// One beat of the best path.
  struct Step {
    int64_t frame;
    int period;  ///< frames
    int in_bar;  ///< 0: a downbeat
    size_t pattern;
    int beats;  ///< in this bar
  };

  BarPointer(std::span<const BarPattern> patterns, const Limits& limits);

  /// EvenOnsets::Settle. Call it before the first Add.
  void Settle(std::span<const Onset> onsets) { even_.Settle(onsets); }
  /// Reserves memory for this many frames in all, which saves time.
  void Reserve(size_t frames) { back_.reserve(frames * from_.size()); }
  void Add(const Onset& onset);

  /// The beats of the best path to the last frame, ascending, from the first frame on. Needs 1 kB
  /// of memory per frame.
  std::vector<Step> Path() const;

 private:
  static constexpr size_t kBeats = 4;      // in a bar, at most; shorter bars leave lanes unused
  static constexpr size_t kHistory = 128;  // frames; longer than any beat
  static constexpr size_t kPlaces = BarPattern::kPlaces;
  static constexpr size_t kScores = kPlaces * kBeats;  // of a pattern's places: [place][beat]
  static constexpr int8_t kNowhere = -128;

  // A pattern at one tempo. The scores of the best paths to the start of each of its beats in the
  // last `period` frames form a ring, [period][kBeats]: `zero` is the latest.
  struct Tempo {
    size_t first_score;
    int period, zero;
    // For each place, its first frame, counted from the beat's first; kNowhere: too close to an
    // earlier place.
    std::array<int8_t, kPlaces> begin;
  };
  // A pattern's tempi, from the fastest on.
  struct Part {
    size_t pattern, beats, first_tempo, tempi;
    size_t first_place;                   // of all patterns' scores of places
    std::array<size_t, kBeats> previous;  // beat of the bar
  };
  struct State {
    size_t part, tempo, beat;  // the tempo of all parts'
    int frames_since;          // the beat began
  };

  void AddPart(size_t pattern, const Limits& limits);
  void Score(const Onset& onset);
  void Leave(const Part& part);
  void Arrive(const Part& part);
  // The scores of all places in a frame.
  size_t At(int64_t frame) const {
    return static_cast<size_t>(frame) % kHistory * parts_.size() * kScores;
  }
  State Best() const;

  std::vector<BarPattern> patterns_;
  // a + b x: [band][place of all patterns].
  std::array<std::vector<double>, Onset::kBands> constant_, slope_;
  std::vector<Tempo> tempi_;
  std::vector<Part> parts_;
  // For each of the last kHistory frames: each place's score, and the sum over this frame and the
  // next three.
  std::vector<float> place_scores_, beginning_;
  std::vector<float> scores_;  // of all rings
  std::vector<float> best_;    // [tempo][kBeats]: of the paths to this frame
  std::vector<int> from_;      // and the tempo of its part they come from
  std::vector<uint8_t> back_;  // from_ by [frame]
  EvenOnsets even_;
  int64_t frames_ = 0;
};

}  // namespace choreo
