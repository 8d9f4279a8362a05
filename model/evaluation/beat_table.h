#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/evaluation/table.h"
#include "model/evaluation/windows.h"

namespace choreo {

/// How many of the kinematic beats fall on the music's (paper F, 4.5.1: maxima of the mean joint
/// speed, at most two frames away), and how many there are for each music beat, wherever they fall.
/// `music`: frames, ascending; those outside the dance do not count.
struct BeatFigures {
  double hit_rate = 0;   ///< B_a / B_k: aligned ones over kinematic beats
  double coverage = 0;   ///< B_k / B_m: kinematic beats over music beats
  double alignment = 0;  ///< BeatAlignmentScore
};
BeatFigures ScoreBeats(std::span<const float> speeds, const std::vector<double>& music, double fps);

/// Gathers dances beside a set's songs, scores each on its own song and, for chance, on the set's
/// other songs from their beginnings: what a dance hits by its own density and tempo.
class BeatTable {
 public:
  /// The set outlives the table.
  explicit BeatTable(const ClipSet& set) : set_(set) {}

  /// A dance of the row `name` beside frames `start` on of a clip; mean joint speeds step by step.
  /// Those of a clip without beats do not count.
  void Add(const std::string& name, size_t clip, int start, const std::vector<float>& speeds);

  /// Rows in the order in which they were first added, "real" first; intervals over songs.
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
