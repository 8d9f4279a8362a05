#include "model/dance/controls/path_lead.h"

#include <algorithm>

#include "model/core/numbers/smooth_step.h"
#include "model/plan/plan_stages.h"

namespace choreo {
namespace {

constexpr double kDetourSpeed = 1.0;  // m/s, at its fastest
constexpr double kMinDetourSeconds = 0.5;
constexpr double kPushOff = 10;  // m/s^2; people push off with little more than their weight

double Smooth(double s) { return SmoothStep(std::clamp(s, 0.0, 1.0)); }

class Leader {
 public:
  explicit Leader(const LeadRequest& request)
      : request_(request),
        frames_(static_cast<int>(request.curves.size())),
        here_(Led(request.start)) {
    lead_.path.setZero(3, frames_);
  }

  Lead Run() {
    for (int from = 0, to = 0; from < frames_; from = to) {
      while (to < frames_ && Curve(to) == Curve(from)) ++to;
      if (Curve(from) != nullptr) {
        Follow(from, to);
      } else {
        Bridge(from, to);
      }
    }
    if (request_.end && Curve(frames_ - 1) != nullptr) BendToEnd();
    return std::move(lead_);
  }

 private:
  const PathCurve* Curve(int frame) const { return request_.curves[static_cast<size_t>(frame)]; }

  PathPoint Led(const PathPoint& point) const {
    return {point.position.cwiseProduct(request_.axes), point.velocity.cwiseProduct(request_.axes)};
  }
  /// The frame of the curve whose position is used in this frame. It is a later one while the path
  /// comes to rest, with the timing of a gently hit pose.
  double Time(int frame) const {
    const double window = std::min(kHitSeconds * request_.fps, static_cast<double>(frames_));
    const double since = frame - (frames_ - 1 - window);
    if (!request_.rests || since <= 0) return frame;
    return frame - since + window * HitTime(since / window, 0);
  }
  /// The point at a frame on the curve of `of_frame`.
  PathPoint Asked(int of_frame, int frame) const {
    const double time = Time(frame);
    PathPoint point = Led(Curve(of_frame)->At(static_cast<double>(request_.first_frame) + time));
    point.velocity *= time - Time(frame - 1);
    return point;
  }

  double DetourFrames(const Eigen::Vector3d& offset, int available) const {
    // A smooth step's peak speed is 1.5 times its average.
    const double seconds = std::max(1.5 * offset.norm() / kDetourSpeed, kMinDetourSeconds);
    return std::min(seconds * request_.fps, static_cast<double>(available));
  }

  void Follow(int from, int to) {
    // A bridge to a curve ends on it.
    const bool on_it = from > 0 && Curve(from - 1) == nullptr;
    PathPoint offset;
    if (!on_it) {
      const Eigen::Vector3d asked = Asked(from, from - 1).position;
      const Eigen::Vector3d step = asked - Asked(from, from - 2).position;
      offset = {here_.position - asked, here_.velocity - step};
    }
    const double detour = DetourFrames(offset.position, to - from);
    for (int frame = from; frame < to; ++frame) {
      const double left = 1 - std::min((frame - from + 1) / detour, 1.0);
      lead_.path.col(frame) = Asked(from, frame).position + Smooth(left) * offset.position +
                              detour * (1 - left) * left * left * offset.velocity;
    }
    here_ = Asked(from, to - 1);
  }

  void Bridge(int from, int to) {
    PathPoint goal{here_.position, Eigen::Vector3d::Zero()};
    double duration = to - from;
    if (to < frames_) {
      goal = Asked(to, to);
      ++duration;
    } else if (request_.end) {
      goal = Led(*request_.end);
    }
    const PathPoint leaving = here_;
    // Limits the velocity so that a running dancer turns without swinging out far.
    const double most = 3 * (goal.position - here_.position).norm() / duration;
    if (here_.velocity.norm() > most) here_.velocity *= most / here_.velocity.norm();
    if (to == frames_ && from > 0 && PushOff(goal, duration) > kPushOff) return GoOn(from, leaving);
    PathPoint point;
    for (int frame = from; frame < to; ++frame) {
      point = CubicBetween(here_, goal, duration, frame - from + 1);
      lead_.path.col(frame) = point.position;
    }
    here_ = point;
  }

  /// The largest acceleration on the cubic from here, m/s^2, which is at one of its ends.
  double PushOff(const PathPoint& goal, double duration) const {
    const Eigen::Vector3d leg = 6 * (goal.position - here_.position);
    const Eigen::Vector3d leave = 2 * duration * here_.velocity;
    const Eigen::Vector3d arrive = 2 * duration * goal.velocity;
    const double largest =
        std::max((leg - 2 * leave - arrive).norm(), (leg - leave - 2 * arrive).norm());
    return largest * request_.fps * request_.fps / (duration * duration);
  }

  /// Handles an end too soon after the last curve: extends the curve straight and bends it to the
  /// end. An end on the straight line needs no bending.
  void GoOn(int from, const PathPoint& leaving) {
    if (!request_.end_wins) {
      lead_.path.rightCols(frames_ - from).colwise() = leaving.position;
      return;
    }
    const int left = frames_ - from;
    const Eigen::Vector3d way = left * leaving.velocity;
    const Eigen::Vector3d wanted = Led(*request_.end).position - leaving.position;
    double share = way.isZero() ? 1 : std::clamp(wanted.dot(way) / way.squaredNorm(), 0.0, 1.0);
    if ((wanted - share * way).norm() > way.norm()) share = 1;
    for (int frame = 0; frame < left; ++frame)
      lead_.path.col(from + frame) = leaving.position + share * (frame + 1) / left * way;
    BendToEnd();
  }

  void BendToEnd() {
    lead_.missed = Led(*request_.end).position - lead_.path.col(frames_ - 1);
    const double detour = DetourFrames(lead_.missed, frames_);
    for (int frame = 0; frame < frames_; ++frame) {
      lead_.path.col(frame) += Smooth(1 - (frames_ - 1 - frame) / detour) * lead_.missed;
    }
  }

  const LeadRequest& request_;
  const int frames_;
  PathPoint here_;  // in the last computed frame
  Lead lead_;
};

}  // namespace

Lead LeadPath(const LeadRequest& request) { return Leader(request).Run(); }

}  // namespace choreo
