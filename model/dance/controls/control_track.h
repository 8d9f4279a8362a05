#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "model/core/error.h"
#include "model/dance/controls/path_track.h"
#include "model/dance/controls/track_frames.h"
#include "model/dance/controls/velocity_track.h"
#include "model/dance/timeline/spec_poses.h"
#include "model/dance/timeline/warning.h"

namespace choreo {

/// Limits per dance: on the number of requests, and on the sum of all paths' points and all other
/// controls' values.
inline constexpr size_t kMaxControls = 1000;
inline constexpr size_t kMaxControlValues = 1'000'000;

/// Selects the class that tracks a control's requests over a dance. It has Check, Set and Fill,
/// and may have Stance, BehindEnd and Missed.
template <typename Request>
struct TrackFor;
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

/// Throws Error(kInvalidArgument) below `field` for invalid values and for controls that the model
/// does not support.
template <typename Request>
void CheckControls(const Request& request, const ModelInfo& model, const std::string& field,
                   std::span<const ControlRow> rows = kControls) {
  Request::VisitControls(
      [&](size_t row, const auto& control) {
        if (!control) return;
        const std::string name = field + "." + std::string(rows[row].name);
        if (!model.Supports(rows[row].name)) {
          throw InvalidArgument(name,
                                "the model \"" + model.name + "\" does not have this control");
        }
        TrackOf<std::remove_cvref_t<decltype(*control)>>::Check(*control, model, name);
      },
      request);
}

/// Counts the points or values of a control's request: the size of its largest field.
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

/// The frames that a control's request changes.
struct ControlChange {
  std::string_view label;  ///< the control's label
  ChangedFrames frames;
};

/// The controls of one dance. `Tracks` has a track for each row of `Request`. Later controls
/// override earlier ones in the way that their track defines. Cheap to copy. Not thread-safe.
template <typename Request, typename Tracks>
class ControlTrackOf {
 public:
  /// The model must outlive the track.
  explicit ControlTrackOf(const ModelInfo& model) : model_(&model) {}

  /// Sets controls for transitions that begin at `from` or later, and returns the changed frames.
  /// The request must be valid. `from` must not decrease between calls. Throws
  /// Error(kInvalidArgument) beyond kMaxControls or kMaxControlValues.
  std::vector<ControlChange> Set(const Request& request, int64_t from, const std::string& field,
                                 std::span<const ControlRow> rows = kControls) {
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
    std::vector<ControlChange> changes;
    Request::VisitControls(
        [&](size_t row, const auto& control, auto& track) {
          if (control) changes.push_back({rows[row].label, track.Set(*control, from)});
        },
        request, tracks_);
    return changes;
  }

  /// The pose before `first_frame` of a dancer without a history: at rest, facing +Z, on the path
  /// if one covers this frame, otherwise at the origin. A key on `first_frame` sets the pose. The
  /// tracks' Stance functions give the pose; at least one track must have one.
  Pose Stance(int64_t first_frame, const std::optional<Target>& key_on_it) const {
    Pose stance;
    Request::VisitControls(
        [&](size_t /*row*/, const auto& track) {
          if constexpr (requires { track.Stance(model_->skeleton, first_frame, key_on_it); })
            stance = track.Stance(model_->skeleton, first_frame, key_on_it);
        },
        tracks_);
    return stance;
  }

  /// Fills in the spec's controls. Reads the spec's first frame, length, history (at least one
  /// pose) and target. Warns where controls and keys contradict each other. `key_id`: the key's
  /// name in warnings.
  void FillControls(const std::string& key_id, TransitionSpec* spec,
                    std::vector<Warning>* warnings) const {
    Request::VisitControls(
        [&](size_t row, const auto& track) {
          track.Fill(*model_, key_id, spec, &spec->controls[row], warnings);
        },
        tracks_);
  }

  /// The tracks' warnings if the dance ends before `end`.
  std::vector<Warning> BehindEnd(int64_t end) const {
    return WarningsOf([&](const auto& track) -> std::optional<Warning> {
      if constexpr (requires { track.BehindEnd(end); }) return track.BehindEnd(end);
      return std::nullopt;
    });
  }
  /// The tracks' warnings about requests that the reported dance did not meet.
  std::vector<Warning> Missed(const QualityReport& report) const {
    return WarningsOf([&](const auto& track) -> std::optional<Warning> {
      if constexpr (requires { track.Missed(report); }) return track.Missed(report);
      return std::nullopt;
    });
  }

 private:
  // The warnings that `warning_of` returns for the tracks.
  std::vector<Warning> WarningsOf(const auto& warning_of) const {
    std::vector<Warning> warnings;
    Request::VisitControls(
        [&](size_t /*row*/, const auto& track) {
          if (auto warning = warning_of(track)) warnings.push_back(std::move(*warning));
        },
        tracks_);
    return warnings;
  }

  const ModelInfo* model_;
  Tracks tracks_;
  size_t requests_ = 0;
  size_t values_ = 0;
};

using ControlTrack = ControlTrackOf<ControlRequest, EachControl<TrackOf>>;

}  // namespace choreo
