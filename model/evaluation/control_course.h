#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "model/dance/root_path.h"
#include "model/evaluation/evaluation.h"
#include "model/metrics/control_figures.h"

namespace choreo {

/// The rows that answer requests with controls: real motion, interpolation along the path, and each
/// engine of `methods`: the network alone, if any, and as served; without keys, as served.
std::vector<Method> WaysOf(const std::vector<Method>& methods);

/// Velocity factors of each of `danced`, which follows `before`.
FactorTrack FactorTrackOf(const Skeleton& skeleton, const Pose& before,
                          const std::vector<Pose>& danced);

/// Share of the steps in which a foot skates (QualityReport::skate_ratio).
double SkateRatioOf(const Skeleton& skeleton, double fps, const Pose& before,
                    const std::vector<Pose>& danced);

/// A real transition, and the controls for dancing it again.
struct ControlledWindow : EvalWindow {
  Pose before = {};  ///< the last history pose
  std::vector<Pose> real = {};
  Pose key = {};  ///< the last of `real`, unless it was moved
  Eigen::Matrix3Xd path = {};
  FactorTrack factors = {};  ///< no columns: none requested
};

/// The windows of one length, for any method to dance. The evaluation must outlive it.
class ControlCourse {
 public:
  ControlCourse(const Evaluation& evaluation, int frames);

  /// Requests a path that no dancer recorded, as the service follows it, and no factors. `draw` may
  /// move the key, and returns points with frames counted from the transition's first.
  using Draw = std::function<RootPath(ControlledWindow*)>;
  void Redraw(const Draw& draw);

  /// Requests constant speeds, metres a frame, instead of the real dance's.
  void AskConstant(const std::array<float, kBodyParts>& speeds);

  /// One dance per window with its controls: the real path and factors, unless replaced above;
  /// factors times `scale` if the method takes any. None if the method can't dance that long.
  Dances Dance(const Method& way, double scale = 1) const;

  /// A figure of each window.
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
