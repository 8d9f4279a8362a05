#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "model/evaluation/evaluation.h"
#include "model/metrics/control_figures.h"
#include "model/motion/controls/path_curve.h"

namespace choreo {

/// The rows of tables about controls: real motion, interpolation along the path, and each engine of
/// `methods`: the network alone (if any) and as served; engines without keys only as served.
std::vector<Method> WaysOf(const std::vector<Method>& methods);

/// The velocity factors of each pose of `danced`, which follows `before`.
SpeedTrack SpeedTrackOf(const Skeleton& skeleton, const Pose& before,
                        const std::vector<Pose>& danced);

/// The share of steps in which a foot skates (QualityReport::skate_ratio).
double SkateRatioOf(const Skeleton& skeleton, double fps, const Pose& before,
                    const std::vector<Pose>& danced);

/// A real transition and the controls that request it again.
struct ControlledWindow : EvalWindow {
  Pose before = {};  ///< the last history pose
  std::vector<Pose> real = {};
  Pose key = {};  ///< the last pose of `real`, unless moved
  Eigen::Matrix3Xd path = {};
  SpeedTrack factors = {};  ///< requested; no columns: none
};

/// The windows of one length and their requests, which any method can dance. The evaluation must
/// outlive the course.
class ControlCourse {
 public:
  ControlCourse(const Evaluation& evaluation, int frames);

  /// Requests drawn paths in place of recorded ones, and no factors. `draw` may move the key. It
  /// returns points whose frames count from the transition's first.
  using Draw = std::function<RootPath(ControlledWindow*)>;
  void Redraw(const Draw& draw);

  /// Requests constant speeds, metres per frame, in place of the real dance's.
  void RequestConstant(const std::array<float, kBodyParts>& speeds);

  /// One dance per window with its controls: the real path and factors unless replaced above, with
  /// factors times `scale` if the method takes any. Empty if the method cannot dance that long.
  Dances Dance(const Method& way, double scale = 1) const;

  /// A figure of one window.
  using Figure = std::function<double(const ControlledWindow&, const std::vector<Pose>& danced)>;
  std::vector<ClipFigure> FiguresOf(const Dances& dances, const Figure& figure) const;

 private:
  TransitionSpec RequestFor(size_t window) const;

  const Evaluation& evaluation_;
  const ModelInfo& model_;
  int frames_;
  std::vector<ControlledWindow> windows_;
};

}  // namespace choreo
