#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/dance/controls/path_validation.h"
#include "model/dance/controls/track_frames.h"
#include "model/dance/timeline/spec_poses.h"
#include "model/dance/timeline/warning.h"

namespace choreo {

struct LeadRequest;

/// The root paths of one dance. A later path overrides earlier ones for the frames that it covers.
/// A path is a PathCurve, bent smoothly to the dancer at a transition's start and to the key at its
/// end (LeadPath). If both cannot be met, the key has precedence, and a warning states the
/// distance. The path comes to rest at keys with a hit, and waits while a pose is held (IsHold).
/// Where no path sets the height, the root is guided to the key's height: its own, or the height at
/// which its pose stands on the floor. A path with heights overrides only a standing height.
/// Transitions without a path are left to the model.
class PathTrack {
 public:
  static void Check(const RootPath& path, const ModelInfo& /*model*/, const std::string& field) {
    CheckPath(path, field);
  }
  /// Changes the frames that the path covers.
  ChangedFrames Set(const RootPath& path, int64_t from) {
    paths_.push_back({from, std::make_shared<PathCurve>(path)});
    return {path.frames.front(), path.frames.back()};
  }

  /// Implements ControlTrack::Stance.
  Pose Stance(const Skeleton& skeleton, int64_t first_frame,
              const std::optional<Target>& key_on_it) const;
  /// Fills in the curve of the spec's controls.
  void Fill(const ModelInfo& model, const std::string& key_id, TransitionSpec* spec,
            ControlCurve* curve, std::vector<Warning>* warnings) const;
  /// A warning if the path set last begins at `end` or later.
  std::optional<Warning> BehindEnd(int64_t end) const;

 private:
  const PathCurve* CurveAt(int64_t frame, int64_t first_frame) const;
  void WarnOfDistance(const LeadRequest& request, std::vector<Warning>* warnings) const;

  std::vector<EffectiveFrom<PathCurve>> paths_;
};

}  // namespace choreo
