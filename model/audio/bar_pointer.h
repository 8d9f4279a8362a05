#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/audio/onset.h"

namespace choreo {

/// A rhythm pattern: the mean onsets at each position in a bar, relative to their mean over three
/// seconds.
struct BarPattern {
  static constexpr size_t kPlaces = 4;
  using Bands = std::array<double, Onset::kBands>;

  int beats = 4;
  /// Positions within a beat, as shares of it, starting with the beat itself. Those from `places`
  /// on are unused.
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

  /// Starts as if this music had played before; otherwise its beginning would have too much weight.
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
  void Add(const Onset& onset);

  /// The beats of the best path to the last frame, ascending, without those before the first frame.
  /// Needs 1 kB of memory per frame.
  std::vector<Step> Path() const;

 private:
  static constexpr size_t kBeats = 4;      // in a bar, at most; shorter bars leave lanes unused
  static constexpr size_t kHistory = 128;  // frames; longer than any beat
  static constexpr int8_t kNowhere = -128;

  // One beat of a pattern at one tempo, with the scores of the best paths to its start in the last
  // `period` frames, as a ring: `zero` is the latest.
  struct Ring {
    uint32_t first_score;
    int period, zero;
    // Where the frames that count as each place begin, from the beat's first frame on; kNowhere:
    // too close to an earlier place.
    std::array<int8_t, BarPattern::kPlaces> begin;
  };
  // A pattern's rings, [tempo][kBeats], from the fastest tempo on.
  struct Part {
    size_t pattern, beats, first_ring, tempi;
    size_t first_place;  // of all patterns'
  };

  static size_t At(size_t place, int64_t frame) {
    return place * kHistory + static_cast<size_t>(frame) % kHistory;
  }
  void AddPart(size_t pattern, const Limits& limits);
  void Leave(const Part& part);
  void Arrive(const Part& part);
  // The score, by the frames so far, of a beat that starts at `start`.
  float ScoreSince(const Ring& ring, size_t first_place, int64_t start) const;
  size_t BestRing(int* frames_since) const;
  const Part& PartOf(size_t ring) const;

  std::vector<BarPattern> patterns_;
  std::vector<std::array<double, 2>> likelihood_;  // [place * bands]: a + b x
  std::vector<Ring> rings_;
  std::vector<Part> parts_;
  // The score of each place in the last kHistory frames, and its sum with the next three.
  std::vector<float> place_scores_, beginning_;
  std::vector<float> scores_;                 // of all rings
  std::vector<float> best_;                   // by ring: of the paths to its beat in this frame
  std::vector<int> from_;                     // and the tempo they come from
  std::vector<uint8_t> back_;                 // from_ by [frame][ring]
  std::vector<float> step_cost_, stay_cost_;  // by period
  EvenOnsets even_;
  int64_t frames_ = 0;
};

}  // namespace choreo
