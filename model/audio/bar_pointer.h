#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/audio/onset.h"

namespace choreo {

/// Where onsets tend to fall in a bar: mean onsets relative to their mean over three seconds.
struct BarPattern {
  static constexpr size_t kPlaces = 4;
  using Bands = std::array<double, Onset::kBands>;

  int beats = 4;
  /// Positions within a beat, starting with the beat itself; those from `places` on are unused.
  std::array<double, kPlaces> place{0, 0.5, 0.25, 0.75};
  size_t places = 4;
  double slowest_bpm = 48, fastest_bpm = 208;
  std::vector<Bands> rise{};  ///< [beat * kPlaces + place]
};

/// 4/4, 4/4 with triplets, 3/4, 6/8. Their rises are means over made songs.
std::span<const BarPattern> BarPatterns();

/// Onsets divided by their mean over the last three seconds, per band, so that loud and soft
/// passages look alike. -1 for a silent band.
class EvenOnsets {
 public:
  static constexpr float kLoudest = 8;  ///< limits the weight of a crash

  /// Values are capped at `loudest` times the mean.
  explicit EvenOnsets(float loudest = kLoudest) : loudest_(loudest) {}

  std::array<float, Onset::kBands> Even(const Onset& onset);

 private:
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

  void Add(const Onset& onset);

  /// The beats of the best path to the last frame, ascending, without those before the first frame.
  /// Costs 1 kB per frame.
  std::vector<Step> Path() const;

 private:
  struct Hit {
    int at;        // frame of the beat
    size_t place;  // in the pattern
  };
  // One beat of a pattern at one tempo. Its states form a ring; moving `zero` advances them all by
  // a frame.
  struct Ring {
    size_t pattern, first_state;
    int beat, period, zero;
    std::vector<Hit> hits;
  };
  // One beat of a pattern at all tempi.
  struct Group {
    size_t pattern, first_ring, count, before;  // before: the group whose beat leads here
  };

  Step StepOf(size_t ring, int64_t frame) const;
  size_t BestState(int* frames_since) const;  // returns its ring

  std::vector<BarPattern> patterns_;
  std::vector<std::vector<std::array<double, 2>>> likelihood_;  // [pattern][place * bands]: a + b x
  std::vector<Ring> rings_;
  std::vector<Group> groups_;
  std::vector<std::vector<float>> place_score_;  // of the current frame, by pattern
  std::vector<float> states_, leaving_, arriving_;
  std::vector<uint8_t> from_, back_;          // back_: [frame][ring]
  std::vector<float> step_cost_, stay_cost_;  // by period
  EvenOnsets even_;
  int64_t frames_ = 0;
};

}  // namespace choreo
