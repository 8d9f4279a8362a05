#include "model/dance/controls/path_track.h"

#include <algorithm>
#include <cmath>

#include "model/dance/controls/path_lead.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo {
namespace {

constexpr double kKeyTolerance = 0.05;    // metres between key and path without a warning
constexpr double kDancerTolerance = 0.5;  // metres from dancer to path's start, likewise

bool HasHeights(const PathCurve* curve) { return curve != nullptr && curve->has_heights(); }

}  // namespace

// Finds the curve for a transition from `first_frame` on, including the frame directly before it.
const PathCurve* PathTrack::CurveAt(int64_t frame, int64_t first_frame) const {
  const int64_t known = std::min(frame, first_frame);
  const auto latest = std::find_if(paths_.rbegin(), paths_.rend(), [&](const auto& path) {
    return path.from <= known && path.what->Covers(frame);
  });
  return latest != paths_.rend() ? latest->what.get() : nullptr;
}

Pose PathTrack::Stance(const Skeleton& skeleton, int64_t first_frame,
                       const std::optional<Target>& key_on_it) const {
  Pose stance = StandingPose(skeleton);
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
  } else if (const auto height = StandingHeight(skeleton, pose, mask)) {
    stance.root_position.y() = *height;
  }
  return stance;
}

void PathTrack::Fill(const ModelInfo& model, const std::string& key_id, TransitionSpec* spec,
                     ControlCurve* curve, std::vector<Warning>* warnings) const {
  const int frames = spec->frames;
  const int64_t first_frame = spec->first_frame;
  const std::vector<Pose>& history = spec->history;
  const std::optional<Target>& target = spec->target;
  LeadRequest way;
  way.first_frame = first_frame;
  way.fps = model.fps;
  for (int frame = 0; frame < frames; ++frame)
    way.curves.push_back(CurveAt(first_frame + frame, first_frame));
  if (std::ranges::count(way.curves, nullptr) == frames) return;
  const Eigen::Vector3d start = history.back().root_position;
  curve->requested[kPathHeight] = std::ranges::any_of(way.curves, HasHeights);
  if (IsHold(*spec, model.fps)) {
    curve->values = start.replicate(1, frames);
    return;
  }
  way.start.position = start;
  if (history.size() > 1) way.start.velocity = start - history.rbegin()[1].root_position;
  way.rests = target && spec->hit;
  if (target && target->mask.root_position) way.end.emplace().position = target->pose.root_position;
  WarnOfDistance(way, warnings);
  const Lead floor = LeadPath(way);

  way.axes = {0, 1, 0};
  for (const PathCurve*& one : way.curves) {
    if (!HasHeights(one)) one = nullptr;
  }
  const std::optional<double> standing =
      target ? StandingHeight(model.skeleton, target->pose, target->mask) : std::nullopt;
  const bool has_place = way.end.has_value();
  way.end_wins = has_place;
  if (!has_place && way.curves.back() == nullptr)
    way.end.emplace().position.y() = standing.value_or(model.skeleton.pelvis_height);
  const Lead height = LeadPath(way);

  const Eigen::Matrix3Xd path = floor.path + height.path;
  curve->values = path;
  const int64_t last = first_frame + frames - 1;
  const double missed = (floor.missed + height.missed).norm();
  if (missed > kKeyTolerance) warnings->push_back(KeyOffPath(key_id, last, missed));
  if (standing && !has_place && std::abs(path(1, frames - 1) - *standing) > kKeyTolerance)
    warnings->push_back(KeyOffHeight(key_id, last, *standing, path(1, frames - 1)));
  Eigen::Matrix3Xd steps = path;
  steps.col(0) -= start;
  steps.rightCols(frames - 1) -= path.leftCols(frames - 1);
  Eigen::Index where = 0;
  const double fastest = steps.colwise().norm().maxCoeff(&where) * model.fps;
  if (fastest > RequiredSpeed::kRootLimit)
    warnings->push_back(PathTooFast(first_frame + where, fastest));
}

void PathTrack::WarnOfDistance(const LeadRequest& request, std::vector<Warning>* warnings) const {
  const PathCurve* before = CurveAt(request.first_frame - 1, request.first_frame);
  for (size_t i = 0; i < request.curves.size(); before = request.curves[i++]) {
    const PathCurve* curve = request.curves[i];
    // In frames without a path, the root moves to the next path.
    if (curve == nullptr || curve == before || (i > 0 && before == nullptr)) continue;
    const int64_t frame = request.first_frame + static_cast<int64_t>(i);
    const Eigen::Vector3d dancer = i == 0 ? request.start.position : before->At(frame - 1).position;
    const Eigen::Vector3d way = (dancer - curve->At(frame - 1).position).cwiseProduct(request.axes);
    if (way.norm() > kDancerTolerance) warnings->push_back(PathAway(frame, way.norm()));
  }
}

std::optional<Warning> PathTrack::BehindEnd(int64_t end) const {
  if (paths_.empty() || paths_.back().what->first() < end) return std::nullopt;
  return PathBehindEnd(paths_.back().what->first(), end);
}

}  // namespace choreo
