#pragma once

#include <span>

#include "model/plan/plan_stage.h"

namespace choreo {

/// The dancer of a plan goes fastest on the music's beats, which is what a kinematic beat is (paper
/// F, Section 4.2). Where a path says when to be where, time is not the beats' to bend.
class BeatTiming final : public PlanStage {
 public:
  struct Options {
    double accent = 0.25;      ///< A: the share of its speed that a dancer gains on a beat
    double whole_accent = 30;  ///< frames: shorter transitions, which keys rule, have less
    double fastest = 10;       ///< frames between beats; faster ones are accented less
    double slowest = 45;       ///< frames between beats; beyond, the music pauses
    double key_accent = 0.75;  ///< gained besides on a key that stands on a beat
    double on_beat = 2.5;      ///< frames between key and beat
    double no_key_accent = 30, whole_key_accent = 60;  ///< frames of a transition
  };
  BeatTiming() = default;
  explicit BeatTiming(const Options& options) : options_(options) {}
  void Apply(const PlanContext& context, std::vector<Pose>* plan) const override;

  /// Where on a plan of `frames` frames the pose of frame `t` is taken from, in frames; t in [-1,
  /// frames - 1], where -1 is the last pose of the history. Between two beats the plan's time runs
  /// as t + A P / 2 pi sin(2 pi (t - beat) / P), so at 1 + A on each beat and at 1 - A half way
  /// between: poses move by a frame or two, and speed peaks where the music does. A way to a key
  /// (`keyed`) has a larger A at either end that stands on a beat: dancers are slow at key poses,
  /// which is not what a beat asks for. The ends stay where they are, so history and key do.
  /// `beats`: ascending, in frames from frame 0; before the first, behind the last and where the
  /// music pauses time runs evenly.
  double Time(std::span<const double> beats, int frames, bool keyed, double t) const;

 private:
  double Share(double period) const;
  double Shift(std::span<const double> beats, double t) const;
  double KeyShift(std::span<const double> beats, double key, int step, double t) const;

  Options options_;
};

}  // namespace choreo
