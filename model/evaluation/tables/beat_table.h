#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/evaluation/table.h"
#include "model/evaluation/windows.h"

namespace choreo {

/// How well kinematic beats (maxima of the mean joint speed; paper F, 4.5.1) match the music's.
/// Beats at most two frames apart are aligned.
struct BeatFigures {
  double hit_rate = 0;   ///< B_a / B_k: aligned beats over kinematic beats
  double coverage = 0;   ///< B_k / B_m: kinematic beats over music beats
  double alignment = 0;  ///< BeatAlignmentScore
};
/// `music`: beats in frames, ascending; beats outside the dance do not count.
BeatFigures ScoreBeats(std::span<const float> speeds, const std::vector<double>& music, double fps);

/// Scores each dance on its own song and, for the level of chance, on the set's other songs from
/// their beginnings: it hits their beats only by density and tempo.
class BeatTable {
 public:
  /// The set must outlive the table.
  explicit BeatTable(const ClipSet& set) : set_(set) {}

  /// Adds a dance to the row `name`. It goes with the clip's frames from `start` on. `speeds`: mean
  /// joint speed of each step, m/s. Ignores clips without beats.
  void Add(const std::string& name, size_t clip, int start, const std::vector<float>& speeds);

  /// The rows, "real" first, then in the order in which they were added. Intervals are over songs.
  Table Finish() const;

 private:
  struct Entry {
    size_t clip;
    BeatFigures own, chance;
  };
  struct Row {
    std::string name;
    std::vector<Entry> entries;
  };
  const ClipSet& set_;
  std::vector<Row> rows_;
};

}  // namespace choreo
