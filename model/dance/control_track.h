#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/dance/quality_report.h"
#include "model/dance/root_path.h"
#include "model/dance/transition.h"
#include "model/dance/velocity_request.h"
#include "model/dance/warning.h"

namespace choreo {

struct LeadRequest;

/// Limits of one dance: requests, and the points of all its paths plus the values of all its
/// velocity factors.
inline constexpr size_t kMaxControls = 1000;
inline constexpr size_t kMaxControlValues = 1'000'000;

/// Throws Error(kInvalidArgument) below `field` for bad values and for a control that the model
/// does not take.
void ValidateControls(const ControlRequest& request, const ModelInfo& model,
                      const std::string& field);

/// The controls of one dance. Of those set for transitions from a frame on, the last counts: of
/// root paths the last that speaks of a frame, of velocity factors part by part; parts and frames
/// that nobody speaks of have the model's first reference. A path is the curve of PathCurve, bent
/// smoothly to the dancer at a transition's start and to the key at its end (LeadPath): the key
/// wins, and a warning tells by how much. Heights that nobody asks for lead to the key's: the one
/// it states, or that at which its pose stands on the floor; a path with heights wins over the
/// latter. A transition that the path has no frame of is left to the model. Not thread-safe.
class ControlTrack {
 public:
  /// The model must outlive the track.
  explicit ControlTrack(const ModelInfo& model) : model_(&model) {}

  /// For transitions that begin at `from` or later. The request is valid; `from` never shrinks from
  /// call to call. Throws Error(kInvalidArgument) beyond kMaxControls or kMaxControlValues.
  void Set(const ControlRequest& request, int64_t from, const std::string& field);

  /// How a dancer of whom nothing is known stands before `first_frame`: at rest, facing +Z, where a
  /// path that has this frame goes on from, or else at the origin. What a key on that very frame
  /// asks, she has done already.
  Pose Stance(int64_t first_frame, const std::optional<Target>& key_on_it) const;

  /// Fills in the request's controls by its first frame, length, history (at least one pose) and
  /// target, which warnings call `key_id`; `warnings` tell where what is asked contradicts itself.
  void Ask(const std::string& key_id, TransitionRequest* request,
           std::vector<Warning>* warnings) const;

  /// The path that was set last, if frames before `end` are none of its.
  std::optional<Warning> BehindEnd(int64_t end) const;
  /// Which of the parts that velocity factors named were 15 % and 1 mm a frame slower or faster
  /// than they asked, over the dance of this report.
  std::optional<Warning> SpeedsMissed(const QualityReport& report) const;

 private:
  template <typename Control>
  struct Since {
    int64_t from;
    Control control;
  };

  const PathCurve* CurveAt(int64_t frame, int64_t first_frame) const;
  void WarnOfDistance(const LeadRequest& request, std::vector<Warning>* warnings) const;
  void AskPath(const std::string& key_id, TransitionRequest* request,
               std::vector<Warning>* warnings) const;
  void AskVelocities(TransitionRequest* request) const;

  const ModelInfo* model_;
  std::vector<Since<PathCurve>> paths_;
  std::vector<Since<VelocityRequest>> velocities_;
  size_t requests_ = 0;
  size_t values_ = 0;
};

}  // namespace choreo
