#include "model/dance/control_track.h"

#include <algorithm>
#include <cmath>

#include "model/core/error.h"
#include "model/core/rounded.h"
#include "model/dance/path_lead.h"
#include "model/motion/kinematics.h"

namespace choreo {
namespace {

constexpr double kKeyTolerance = 0.05;    // metres that a key may be off the path without a warning
constexpr double kDancerTolerance = 0.5;  // the same for the dancer where a path begins
// How far a speed may miss the requested one without a warning: a share, and metres a frame.
constexpr double kSpeedTolerance = 0.15, kMinMiss = 0.001;

bool HasHeights(const PathCurve* curve) { return curve != nullptr && curve->has_heights(); }

}  // namespace

void ValidateControls(const ControlRequest& request, const ModelInfo& model,
                      const std::string& field) {
  const auto field_of = [&](size_t control) {
    std::string name = field + "." + std::string(kControls[control].name);
    if (model.Takes(control)) return name;
    throw InvalidArgument(name, "the model \"" + model.name + "\" does not have this control");
  };
  if (request.root_path) ValidatePath(*request.root_path, field_of(kRootPath));
  if (request.velocity_factors)
    ValidateVelocities(*request.velocity_factors, model, field_of(kVelocityFactors));
}

void ControlTrack::Set(const ControlRequest& request, int64_t from, const std::string& field) {
  if (requests_ >= kMaxControls) {
    throw InvalidArgument(field, "is one more than the limit of " + std::to_string(kMaxControls));
  }
  const size_t values = values_ + (request.root_path ? request.root_path->frames.size() : 0) +
                        (request.velocity_factors ? request.velocity_factors->factors.size() +
                                                        request.velocity_factors->speeds.size()
                                                  : 0);
  if (values > kMaxControlValues) {
    throw InvalidArgument(field, "brings the dance's controls to " + std::to_string(values) +
                                     " points and values, the limit is " +
                                     std::to_string(kMaxControlValues));
  }
  ++requests_;
  values_ = values;
  if (request.root_path) paths_.push_back({from, std::make_shared<PathCurve>(*request.root_path)});
  if (request.velocity_factors)
    velocities_.push_back({from, std::make_shared<VelocityRequest>(*request.velocity_factors)});
}

// Finds the curve for a transition from `first_frame` on, and for the frame right before it.
const PathCurve* ControlTrack::CurveAt(int64_t frame, int64_t first_frame) const {
  const int64_t known = std::min(frame, first_frame);
  const auto said = std::find_if(paths_.rbegin(), paths_.rend(), [&](const auto& path) {
    return path.from <= known && path.control->Covers(frame);
  });
  return said != paths_.rend() ? said->control.get() : nullptr;
}

Pose ControlTrack::Stance(int64_t first_frame, const std::optional<Target>& key_on_it) const {
  Pose stance = StandingPose(model_->skeleton);
  const PathCurve* curve = CurveAt(first_frame, first_frame);
  if (curve != nullptr) {
    const double height = stance.root_position.y();
    stance.root_position = curve->At(static_cast<double>(first_frame)).position;
    stance.root_position.y() = height;
  }
  if (!key_on_it) return stance;
  const Pose& pose = key_on_it->pose;
  const PoseMask& mask = key_on_it->mask;
  stance = Masked(pose, mask, std::move(stance));
  if (mask.root_position) return stance;
  if (HasHeights(curve)) {
    stance.root_position.y() = curve->At(static_cast<double>(first_frame)).position.y();
  } else if (const auto height = StandingHeight(model_->skeleton, pose, mask)) {
    stance.root_position.y() = *height;
  }
  return stance;
}

void ControlTrack::FillPath(const std::string& key_id, TransitionSpec* spec,
                            std::vector<Warning>* warnings) const {
  const int frames = spec->frames;
  const int64_t first_frame = spec->first_frame;
  const std::vector<Pose>& history = spec->history;
  const std::optional<Target>& target = spec->target;
  LeadRequest way;
  way.first_frame = first_frame;
  way.fps = model_->fps;
  for (int frame = 0; frame < frames; ++frame)
    way.curves.push_back(CurveAt(first_frame + frame, first_frame));
  if (std::ranges::count(way.curves, nullptr) == frames) return;
  const Eigen::Vector3d start = history.back().root_position;
  ControlCurve& control = spec->controls[kRootPath];
  control.requested[kPathHeight] = std::ranges::any_of(way.curves, HasHeights);
  if (IsHold(*spec, model_->fps)) {
    control.values = start.replicate(1, frames);
    return;
  }
  way.start.position = start;
  if (history.size() > 1) way.start.velocity = start - history.rbegin()[1].root_position;
  way.rests = target && spec->hit;
  if (target && target->mask.root_position) way.end.emplace().position = target->pose.root_position;
  WarnOfDistance(way, warnings);
  const Lead floor = LeadPath(way);

  way.axes = {0, 1, 0};
  for (const PathCurve*& curve : way.curves) {
    if (!HasHeights(curve)) curve = nullptr;
  }
  const std::optional<double> standing =
      target ? StandingHeight(model_->skeleton, target->pose, target->mask) : std::nullopt;
  const bool has_place = way.end.has_value();
  way.end_wins = has_place;
  if (!has_place && way.curves.back() == nullptr)
    way.end.emplace().position.y() = standing.value_or(model_->skeleton.pelvis_height);
  const Lead height = LeadPath(way);

  const Eigen::Matrix3Xd path = floor.path + height.path;
  control.values = path;
  const int64_t last = first_frame + frames - 1;
  const double missed = (floor.missed + height.missed).norm();
  if (missed > kKeyTolerance) warnings->push_back(KeyOffPath(key_id, last, missed));
  if (standing && !has_place && std::abs(path(1, frames - 1) - *standing) > kKeyTolerance)
    warnings->push_back(KeyOffHeight(key_id, last, *standing, path(1, frames - 1)));
  Eigen::Matrix3Xd steps = path;
  steps.col(0) -= start;
  steps.rightCols(frames - 1) -= path.leftCols(frames - 1);
  Eigen::Index where = 0;
  const double fastest = steps.colwise().norm().maxCoeff(&where) * model_->fps;
  if (fastest > RequiredSpeed::kRootLimit)
    warnings->push_back(PathTooFast(first_frame + where, fastest));
}

void ControlTrack::WarnOfDistance(const LeadRequest& request,
                                  std::vector<Warning>* warnings) const {
  const PathCurve* before = CurveAt(request.first_frame - 1, request.first_frame);
  for (size_t i = 0; i < request.curves.size(); before = request.curves[i++]) {
    const PathCurve* curve = request.curves[i];
    // Frames without a path lead to the next path.
    if (curve == nullptr || curve == before || (i > 0 && before == nullptr)) continue;
    const int64_t frame = request.first_frame + static_cast<int64_t>(i);
    const Eigen::Vector3d dancer = i == 0 ? request.start.position : before->At(frame - 1).position;
    const Eigen::Vector3d way = (dancer - curve->At(frame - 1).position).cwiseProduct(request.axes);
    if (way.norm() > kDancerTolerance) warnings->push_back(PathAway(frame, way.norm()));
  }
}

void ControlTrack::FillVelocities(TransitionSpec* spec) const {
  const int64_t first_frame = spec->first_frame;
  if (velocities_.empty() || velocities_.front().from > first_frame) return;
  ControlCurve& factors = spec->controls[kVelocityFactors];
  factors.values.resize(kBodyParts, spec->frames);
  VelocityRequest usual;
  usual.factors = {1};
  for (int part = 0; part < kBodyParts; ++part) {
    const auto body_part = static_cast<BodyPart>(part);
    const auto said = std::find_if(velocities_.rbegin(), velocities_.rend(), [&](const auto& one) {
      return one.from <= first_frame && Names(*one.control, body_part);
    });
    const bool is_asked = said != velocities_.rend();
    factors.requested[static_cast<size_t>(part)] = is_asked;
    const VelocityRequest& asked = is_asked ? *said->control : usual;
    for (int frame = 0; frame < spec->frames; ++frame)
      factors.values(part, frame) = SpeedAt(asked, first_frame + frame, body_part, *model_);
  }
}

std::optional<Warning> ControlTrack::BehindEnd(int64_t end) const {
  if (paths_.empty() || paths_.back().control->first() < end) return std::nullopt;
  return PathBehindEnd(paths_.back().control->first(), end);
}

std::optional<Warning> ControlTrack::SpeedsMissed(const QualityReport& report) const {
  if (report.part_speeds.empty()) return std::nullopt;
  std::string misses;
  for (size_t i = 0; i < kBodyParts; ++i) {
    const auto named = [part = static_cast<BodyPart>(i)](const auto& one) {
      return Names(*one.control, part);
    };
    const auto [asked, danced] = report.part_speeds[i];
    const double miss = std::abs(danced - asked);
    if (std::ranges::none_of(velocities_, named) || miss <= kMinMiss ||
        miss <= kSpeedTolerance * asked)
      continue;
    misses += (misses.empty() ? "" : ", ") + std::string(kBodyPartNames[i]) + ' ' +
              Rounded(100 * danced) + " instead of " + Rounded(100 * asked);
  }
  if (misses.empty()) return std::nullopt;
  return VelocityNotMet(report.measured_from + report.frames - 1, misses);
}

void ControlTrack::FillControls(const std::string& key_id, TransitionSpec* spec,
                                std::vector<Warning>* warnings) const {
  FillPath(key_id, spec, warnings);
  FillVelocities(spec);
}

}  // namespace choreo
