#pragma once

#include <span>

#include "model/flow/plan_options.h"

namespace choreo {

inline constexpr double kPauseSeconds = 1.5;  ///< from beat to beat, and the music pauses

/// What of a transition says how its time runs.
struct BeatTiming {
  std::span<const double> beats;  ///< in frames from frame 0, ascending
  int frames = 0;
  bool keyed = false;  ///< it ends on a key
  double fps;          ///< above 0
  PlanOptions options = {};

  /// Where on a plan the pose of frame `t` is taken from, in frames; t in [-1, frames - 1], where
  /// -1 is the history's last pose. Between two beats time runs as t + A P / 2 pi sin(2 pi (t -
  /// beat) / P): at 1 + A on each beat, at 1 - A half way between, A being the accent. A way to a
  /// key has a larger A at either end that stands on a beat, as dancers are slow at key poses. The
  /// ends stay where they are; before the first beat, behind the last and where the music pauses
  /// time runs evenly.
  double Time(double t) const;

 private:
  double Share(double period) const;
  double Shift(double t) const;
  double KeyShift(double key, int step, double t) const;
};

}  // namespace choreo
