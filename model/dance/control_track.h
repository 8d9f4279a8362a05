#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/dance/quality_meter.h"
#include "model/dance/root_path.h"
#include "model/dance/transition.h"
#include "model/dance/velocity_request.h"
#include "model/dance/warning.h"

namespace choreo {

struct LeadRequest;

/// Limits per dance: on requests, and on the points of all paths plus the values of all velocity
/// factors.
inline constexpr size_t kMaxControls = 1000;
inline constexpr size_t kMaxControlValues = 1'000'000;

/// Throws Error(kInvalidArgument) below `field` for bad values and for controls that the model does
/// not support.
void ValidateControls(const ControlRequest& request, const ModelInfo& model,
                      const std::string& field);

/// The controls of one dance. Later controls override earlier ones: a root path for the frames it
/// covers, velocity factors part by part. Parts and frames without velocity factors use the model's
/// first reference. A path is the curve of PathCurve, bent smoothly to the dancer at a transition's
/// start and to the key at its end (LeadPath); the key wins, and a warning gives the distance. At
/// keys that are hit it comes to rest; while a pose is held (IsHold) it waits.
/// Where no path sets the height, the root is led to the key's height: the one it states, or the
/// one at which its pose stands on the floor. A path with heights overrides the latter. Transitions
/// that no path covers are left to the model. Cheap to copy. Not thread-safe.
class ControlTrack {
 public:
  /// The model must outlive the track.
  explicit ControlTrack(const ModelInfo& model) : model_(&model) {}

  /// Applies to transitions that begin at `from` or later. The request must be valid; `from` never
  /// decreases between calls. Throws Error(kInvalidArgument) beyond kMaxControls or
  /// kMaxControlValues.
  void Set(const ControlRequest& request, int64_t from, const std::string& field);

  /// The pose before `first_frame` of a dancer without a history: at rest, facing +Z, on the path
  /// if one covers this frame, or else at the origin. A key on that very frame sets the pose.
  Pose Stance(int64_t first_frame, const std::optional<Target>& key_on_it) const;

  /// Fills in the spec's controls from its first frame, length, history (at least one pose) and
  /// target, which warnings call `key_id`. Appends `warnings` where controls and keys contradict
  /// each other.
  void FillControls(const std::string& key_id, TransitionSpec* spec,
                    std::vector<Warning>* warnings) const;

  /// A warning if the last path set begins at `end` or later.
  std::optional<Warning> BehindEnd(int64_t end) const;
  /// A warning that names the parts whose speed, over the dance of this report, missed the
  /// requested one by more than 15 % and 1 mm a frame.
  std::optional<Warning> SpeedsMissed(const QualityReport& report) const;

 private:
  template <typename Control>
  struct Since {
    int64_t from;
    std::shared_ptr<const Control> control;  // shared by copies of the track
  };

  const PathCurve* CurveAt(int64_t frame, int64_t first_frame) const;
  void WarnOfDistance(const LeadRequest& request, std::vector<Warning>* warnings) const;
  void FillPath(const std::string& key_id, TransitionSpec* spec,
                std::vector<Warning>* warnings) const;
  void FillVelocities(TransitionSpec* spec) const;

  const ModelInfo* model_;
  std::vector<Since<PathCurve>> paths_;
  std::vector<Since<VelocityRequest>> velocities_;
  size_t requests_ = 0;
  size_t values_ = 0;
};

}  // namespace choreo
