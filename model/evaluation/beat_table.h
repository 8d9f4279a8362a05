#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/evaluation/table.h"
#include "model/evaluation/windows.h"

namespace choreo {

/// How many kinematic beats fall on the music's (paper F, 4.5.1: maxima of the mean joint speed, at
/// most two frames away), and how many there are per music beat. `music`: frames, ascending;
/// ignores those outside the dance.
struct BeatFigures {
  double hit_rate = 0;   ///< B_a / B_k: aligned beats over kinematic beats
  double coverage = 0;   ///< B_k / B_m: kinematic beats over music beats
  double alignment = 0;  ///< BeatAlignmentScore
};
BeatFigures ScoreBeats(std::span<const float> speeds, const std::vector<double>& music, double fps);

/// Scores each dance on its own song and, for chance, on the set's other songs from their
/// beginnings, which it hits by density and tempo alone.
class BeatTable {
 public:
  /// The set must outlive the table.
  explicit BeatTable(const ClipSet& set) : set_(set) {}

  /// Adds a dance to the row `name`, for frames `start` on of a clip; mean joint speeds step by
  /// step. Ignores clips without beats.
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
