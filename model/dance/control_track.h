#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "model/core/error.h"
#include "model/dance/held_track.h"
#include "model/dance/path_track.h"
#include "model/dance/transition.h"
#include "model/dance/velocity_track.h"
#include "model/dance/warning.h"

namespace choreo {

/// Limits per dance: on requests, and on the points of all paths plus the values of all other
/// controls.
inline constexpr size_t kMaxControls = 1000;
inline constexpr size_t kMaxControlValues = 1'000'000;

/// The class that follows a control's requests over a dance.
template <typename Request>
struct TrackFor {
  using Track = HeldTrack<Request>;
};
template <>
struct TrackFor<RootPath> {
  using Track = PathTrack;
};
template <>
struct TrackFor<VelocityRequest> {
  using Track = VelocityTrack;
};
template <typename Request>
using TrackOf = typename TrackFor<Request>::Track;

/// Throws Error(kInvalidArgument) below `field` for bad values and for controls that the model does
/// not support.
template <typename Request>
void ValidateControls(const Request& request, const ModelInfo& model, const std::string& field,
                      std::span<const ControlRow> rows = kControls) {
  Request::VisitControls(
      [&](size_t row, const auto& control) {
        if (!control) return;
        const std::string name = field + "." + std::string(rows[row].name);
        if (!model.Takes(rows[row].name)) {
          throw InvalidArgument(name,
                                "the model \"" + model.name + "\" does not have this control");
        }
        TrackOf<std::remove_cvref_t<decltype(*control)>>::Validate(*control, model, name);
      },
      request);
}

/// How many points or values a control's request has: those of its largest field.
struct ValueCount {
  size_t* most;

  void operator()(const char* /*name*/, const auto& /*others*/) const {}
  void operator()(const char* /*name*/, const std::vector<double>& values) const {
    *most = std::max(*most, values.size());
  }
  void operator()(const char* /*name*/, const std::vector<Eigen::Vector2d>& points) const {
    *most = std::max(*most, points.size());
  }
};

/// The controls of one dance, `Tracks`: a track for each row of `Request`. Later controls override
/// earlier ones, as their tracks say. Cheap to copy. Not thread-safe.
template <typename Request, typename Tracks>
class ControlTrackOf {
 public:
  /// The model must outlive the track.
  explicit ControlTrackOf(const ModelInfo& model) : model_(&model) {}

  /// Applies to transitions that begin at `from` or later. The request must be valid; `from` never
  /// decreases between calls. Throws Error(kInvalidArgument) beyond kMaxControls or
  /// kMaxControlValues.
  void Set(const Request& request, int64_t from, const std::string& field) {
    if (requests_ >= kMaxControls) {
      throw InvalidArgument(field, "is one more than the limit of " + std::to_string(kMaxControls));
    }
    size_t values = values_;
    Request::VisitControls(
        [&](size_t /*row*/, const auto& control) {
          size_t own = 0;
          if (control) control->VisitFields(*control, ValueCount{&own});
          values += own;
        },
        request);
    if (values > kMaxControlValues) {
      throw InvalidArgument(field, "brings the dance's controls to " + std::to_string(values) +
                                       " points and values, the limit is " +
                                       std::to_string(kMaxControlValues));
    }
    ++requests_;
    values_ = values;
    Request::VisitControls(
        [from](size_t /*row*/, const auto& control, auto& track) {
          if (control) track.Set(*control, from);
        },
        request, tracks_);
  }

  /// The pose before `first_frame` of a dancer without a history: at rest, facing +Z, on the path
  /// if one covers this frame, or else at the origin. A key on that very frame sets the pose.
  Pose Stance(int64_t first_frame, const std::optional<Target>& key_on_it) const {
    return tracks_.root_path.Stance(model_->skeleton, first_frame, key_on_it);
  }

  /// Fills in the spec's controls from its first frame, length, history (at least one pose) and
  /// target, which warnings call `key_id`. Appends `warnings` where controls and keys contradict
  /// each other.
  void FillControls(const std::string& key_id, TransitionSpec* spec,
                    std::vector<Warning>* warnings) const {
    Request::VisitControls(
        [&](size_t row, const auto& track) {
          track.Fill(*model_, key_id, spec, &spec->controls[row], warnings);
        },
        tracks_);
  }

  /// As the tracks say.
  std::optional<Warning> BehindEnd(int64_t end) const { return tracks_.root_path.BehindEnd(end); }
  std::optional<Warning> SpeedsMissed(const QualityReport& report) const {
    return tracks_.velocity_factors.Missed(report);
  }

 private:
  const ModelInfo* model_;
  Tracks tracks_;
  size_t requests_ = 0;
  size_t values_ = 0;
};

using ControlTrack = ControlTrackOf<ControlRequest, EachControl<TrackOf>>;

}  // namespace choreo
