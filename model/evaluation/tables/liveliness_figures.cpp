#include "model/evaluation/tables/liveliness_figures.h"

#include <cmath>

#include "model/dance/delivery/quality_meter.h"
#include "model/evaluation/tables/beat_table.h"
#include "model/metrics/contrast.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/kinematic_beats.h"
#include "model/motion/pose/motion_faults.h"

namespace choreo {

LivelinessFigures MeasureLiveliness(const ModelInfo& model, const LongPlan& plan,
                                    const std::vector<Pose>& poses) {
  LivelinessFigures figures;
  figures.clip = plan.clip;
  std::vector<Pose> whole = {plan.history.back()};
  whole.insert(whole.end(), poses.begin(), poses.end());
  figures.track = TrackJoints(model.skeleton, whole);
  figures.speeds = MeanSpeeds(figures.track, model.fps);
  figures.median_speed = Percentile(figures.speeds, 0.5);
  figures.turns = WindowTurns(whole, model.fps);
  figures.faces_away = FacesAway(whole, GroundFrame::Of(whole.front()).heading);
  std::vector<int> keys;
  for (const auto& [frame, pose] : plan.keys) keys.push_back(frame + 1);
  figures.limbs = MeasureLimbTravel(model.skeleton, figures.track, keys);
  figures.bounce = PelvisBounce(figures.track, model.fps);
  figures.jerk = SmoothJerk(figures.track, model.fps);
  figures.raw_jerk = RawJerk(figures.track, model.fps);
  const Motion motion{.fps = model.fps, .frames = whole};
  figures.skate_ratio = MeasureMotion(model.skeleton, motion).skate_ratio;
  figures.arms_inside = FaultShare(FindMotionFaults(model.skeleton, motion),
                                   MotionFaultKind::kArmInside, std::ssize(whole));
  const double a_minute = 60 * model.fps / poses.size();
  figures.kinematic_beats = a_minute * KinematicBeats(figures.speeds, model.fps).size();
  const Snaps snaps = CountSnaps(model.skeleton, model.fps, figures.track);
  figures.knee_snaps = a_minute * snaps.knees;
  figures.elbow_snaps = a_minute * snaps.elbows;
  return figures;
}

Cell HitsOverChance(const LivelinessDances& dances, double bpm, double phase, double fps) {
  const auto shifts = static_cast<int>(std::lround(60 * fps / bpm));
  std::vector<ClipFigure> figures;
  for (const LivelinessFigures& dance : dances) {
    const auto hits = [&](double at) {
      const auto frames = static_cast<int>(dance.speeds.size()) + 1;
      // The track begins a frame before the dance.
      std::vector<double> beats = RegularBeats(bpm, at, fps, frames);
      for (double& beat : beats) ++beat;
      return 100 * ScoreBeats(dance.speeds, beats, fps).hit_rate;
    };
    double chance = 0;
    for (int shift = 0; shift < shifts; ++shift)
      chance += hits(phase + static_cast<double>(shift) / shifts) / shifts;
    figures.push_back({dance.clip, hits(phase) - chance});
  }
  return Mean(figures);
}

}  // namespace choreo
