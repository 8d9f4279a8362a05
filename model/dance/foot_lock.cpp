#include "model/dance/foot_lock.h"

#include <algorithm>
#include <cmath>

#include "model/core/smooth_step.h"
#include "model/motion/contacts.h"
#include "model/motion/kinematics.h"

namespace choreo {
namespace {

constexpr double kStepSeconds = 0.3;
constexpr double kDrift = 0.12;          // metres the body may leave a planted foot behind
constexpr double kStillSpeed = 0.6;      // m/s: a foot that the model moves slower stands
constexpr double kSameSpot = 0.03;       // metres that need no step of their own
constexpr double kFarthestReach = 1.02;  // of the leg's length: a toe drawn two centimetres
constexpr double kStraightest = 0.99;    // of the leg's length: a step reaches out no farther
constexpr double kArc = 0.03, kArcPerMetre = 0.15, kHighestArc = 0.10;  // metres
constexpr double kSettle = 0.6;  // a frame's share of a planted foot's height above its place
constexpr int kFewestStepFrames = 4;
constexpr int kHalvings = 12;
constexpr double kLandsAhead = 0.1;  // seconds before the key, which a landing would jolt

double Apart(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::hypot(a.x() - b.x(), a.z() - b.z());
}

int StepFrames(double fps, int transition_frames) {
  return static_cast<int>(std::min(kStepSeconds * fps, (transition_frames - 2) / 2.0));
}

}  // namespace

bool FootLock::Fits(const Skeleton& skeleton, double fps, int transition_frames) {
  return Leg::In(skeleton) && StepFrames(fps, transition_frames) >= kFewestStepFrames;
}

FootLock::FootLock(const Skeleton& skeleton, double fps, int transition_frames,
                   const std::vector<Pose>& history, const std::optional<Target>& target)
    : skeleton_(skeleton),
      frames_(transition_frames),
      step_frames_(StepFrames(fps, transition_frames)),
      fps_(fps) {
  const std::array<Leg, 2> legs = Leg::Of(skeleton);
  for (size_t side = 0; side < 2; ++side) feet_[side].leg = legs[side];
  const Eigen::Matrix3Xd rest = JointPositions(skeleton, RestPose(skeleton));
  rest_height_ = std::min(rest(1, feet_[0].leg.toes), rest(1, feet_[1].leg.toes));
  ankle_height_ = std::min(rest(1, feet_[0].leg.ankle), rest(1, feet_[1].leg.ankle));
  const JointPlacement last = ForwardKinematics(skeleton, history.back());
  const Eigen::Matrix3Xd& now = last.positions;
  const Eigen::Matrix3Xd before =
      JointPositions(skeleton, history[history.size() - std::min<size_t>(2, history.size())]);
  for (Foot& foot : feet_) {
    foot.at = foot.from = foot.raw = now.col(foot.leg.toes);
    foot.planted = foot.at.y() < rest_height_ + kDownHeight &&
                   Apart(now.col(foot.leg.toes), before.col(foot.leg.toes)) < kStillSpeed / fps_;
    foot.last_start = frames_;
    foot.bend = KneeBend(foot.leg, last);
  }
  if (target) PlanLastSteps(*target);
}

void FootLock::PlanLastSteps(const Target& target) {
  ends_on_key_ = true;
  std::array<double, 2> way = {0, 0};
  const Eigen::Matrix3Xd key = JointPositions(skeleton_, target.pose);
  const std::vector<bool> known = KnownPlaces(skeleton_, target.mask);
  for (size_t side = 0; side < 2; ++side) {
    Foot& foot = feet_[side];
    if (!target.mask.root_position || !known[static_cast<size_t>(foot.leg.toes)]) continue;
    const Eigen::Vector3d toes = key.col(foot.leg.toes);
    if (toes.y() < rest_height_ + kUpHeight) foot.landing = toes;
    way[side] = Apart(toes, foot.at);
  }
  // The foot with the longer way steps last, so that the other one carries it.
  const size_t last = way[0] > way[1] ? 0 : 1;
  const int room = (frames_ - 1 - 2 * step_frames_) / 2;
  const int ahead = std::clamp(static_cast<int>(kLandsAhead * fps_), 0, room);
  // A foot that does not land is the model's from its last step on.
  const auto start = [&](Foot& foot, int steps) {
    foot.last_start = frames_ - 1 - steps * step_frames_ - (foot.landing ? ahead : 0);
  };
  start(feet_[last], 1);
  start(feet_[1 - last], 2);
}

void FootLock::Lift(Foot* foot) {
  foot->planted = false;
  foot->from = foot->at;
  foot->start = next_;
  foot->duration = step_frames_;
}

bool FootLock::WantsToStep(const Foot& foot, const Eigen::Vector3d& raw, double reach) const {
  if (reach > kFarthestReach || raw.y() > rest_height_ + kUpHeight) return true;
  const Foot& other = &foot == feet_.data() ? feet_[1] : feet_[0];
  const bool in_time = next_ + step_frames_ < foot.last_start;
  return other.planted && in_time && Apart(raw, foot.at) > kDrift;
}

// Where a foot in the air is: on its way from where it left to where the model has it, or to where
// it lands; higher the farther it goes.
Eigen::Vector3d FootLock::Move(Foot* foot, const Eigen::Vector3d& raw) {
  const bool lands = foot->last_step && foot->landing;
  const Eigen::Vector3d goal = lands ? *foot->landing : raw;
  const double arc = std::min(kHighestArc, kArc + kArcPerMetre * Apart(goal, foot->from));
  const double model_lift = std::max(0.0, raw.y() - rest_height_ - kDownHeight);
  const auto at = [&](double u) {
    Eigen::Vector3d place = foot->from + SmoothStep(u) * (goal - foot->from);
    // A quick step, between keys that stand close together, is a low one. It leaves the floor and
    // comes down softly: a parabola would jolt the knee, half of the times on a key. It is higher
    // where the model lifts the foot, and never lower.
    const double shape = foot->duration / (kStepSeconds * fps_) * 8 * std::pow(u * (1 - u), 1.5);
    place.y() =
        std::max(place.y() + std::max(0.0, arc - model_lift) * shape, rest_height_ + arc * shape);
    if (!lands) place.y() = std::max(place.y(), rest_height_);
    return place;
  };
  const auto reaches = [&](double u) {
    return Reach(foot->leg, placement_, at(u)) <= kStraightest;
  };
  double u =
      std::min(1.0, static_cast<double>(next_ - foot->start + 1) / std::max(1, foot->duration));
  if (lands && !reaches(u)) {
    // The body is not there yet: the foot waits in the air, as long as there is time.
    double most = u;
    u = std::clamp(1 - static_cast<double>(frames_ - 1 - next_) / step_frames_, 0.0, u);
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (u + most);
      (reaches(middle) ? u : most) = middle;
    }
  }
  // A step comes down where the floor is; a foot that the model moves by itself stands once it is
  // slow. A key that has the foot in the air, or leaves it open, takes it from the model's hand.
  const bool low = goal.y() < rest_height_ + (foot->landing ? kUpHeight : kDownHeight);
  const bool comes_down = foot->duration > 0 || Apart(raw, foot->raw) < kStillSpeed / fps_;
  foot->planted = u == 1 && low && comes_down && (!foot->last_step || foot->landing);
  return at(u);
}

// A planted foot stays, settles onto the floor, and at the end shifts the little that the key asks.
Eigen::Vector3d FootLock::Stand(const Foot& foot) const {
  Eigen::Vector3d at = foot.at;
  const int left = frames_ - next_;  // this frame included
  if (foot.landing && left <= step_frames_) {
    return at + (*foot.landing - at) / left;
  }
  at.y() = rest_height_ + kSettle * (at.y() - rest_height_);
  return at;
}

Pose FootLock::Apply(const Pose& steered) {
  ForwardKinematics(skeleton_, steered, placement_);
  Pose emitted = steered;
  for (size_t side = 0; side < 2; ++side) {
    Foot& foot = feet_[side];
    const Eigen::Vector3d raw = placement_.positions.col(foot.leg.toes);
    if (next_ == foot.last_start) {
      // A foot that is there already stays; any other takes its last step now.
      const bool there = foot.planted && foot.landing && Apart(*foot.landing, foot.at) < kSameSpot;
      if (!there) {
        Lift(&foot);
        foot.last_step = true;
      }
    } else if (foot.planted && next_ < foot.last_start &&
               WantsToStep(foot, raw, Reach(foot.leg, placement_, foot.at))) {
      Lift(&foot);
    }
    foot.at = foot.planted ? Stand(foot) : Move(&foot, raw);
    // The body may not be where the step leads yet.
    if (!foot.planted || foot.last_step)
      foot.at = WithinReach(foot.leg, placement_, foot.at, kStraightest);
    foot.raw = raw;
    // On the key itself the steered pose is the key: nothing may touch it.
    if (ends_on_key_ && next_ == frames_ - 1) {
      foot.at = raw;
    } else {
      const BendRange range = NextBend(foot.bend, 1 / fps_);
      foot.bend = KneeBend(foot.leg, placement_);
      if (foot.at != raw || foot.bend < range.least || foot.bend > range.most)
        foot.bend = PlaceToes(foot.leg, skeleton_, placement_, foot.at, &emitted, range);
    }
    // The foot keeps its turn, so its ankle moves with its toes.
    const double ankle = placement_.positions(1, foot.leg.ankle) + foot.at.y() - raw.y();
    contacts_[2 * side] = foot.planted && ankle < ankle_height_ + kDownHeight ? 1.0F : 0.0F;
    contacts_[2 * side + 1] = foot.planted ? 1.0F : 0.0F;
  }
  ++next_;
  return emitted;
}

}  // namespace choreo
