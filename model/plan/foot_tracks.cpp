#include "model/plan/foot_tracks.h"

#include <algorithm>
#include <cmath>

#include "model/core/numbers/gaussian_mean.h"
#include "model/motion/floor/contacts.h"
#include "model/motion/floor/floor_clearance.h"
#include "model/motion/floor/support.h"
#include "model/motion/kinematics/body_mass.h"

namespace choreo {
namespace {

constexpr double kStillSpeed = 0.3;    // m/s: a low foot slower than this stands
constexpr double kLandingShare = 0.5;  // a low foot slower than this share of its last speed lands
constexpr double kSmoothFrames = 1.5;  // smoothing of the centre of mass
constexpr int kSmoothReach = 4;

Eigen::Vector2d ZeroMomentPoint(const std::vector<BodyCentre>& centres, int frame, double fps) {
  const auto centre = [&](int i) -> const Eigen::Vector3d& {
    return centres[std::min(static_cast<size_t>(i + 2), centres.size() - 1)].smooth;
  };
  const Eigen::Vector3d& at = centre(frame);
  const Eigen::Vector3d acceleration =
      (centre(frame + 1) - 2 * at + centre(frame - 1)) * (fps * fps);
  const double lever = MomentLever(at.y(), acceleration.y());
  return {at.x() - lever * acceleration.x(), at.z() - lever * acceleration.z()};
}

// Whether a joint near the floor stands there after the history: it hardly moves, or it has just
// landed, as toes do that a step brings to a key's place in the key's frame.
bool Rests(const FootworkContext& context, int joint) {
  const auto at = [&](size_t back) -> Eigen::Vector3d {
    const auto& history = context.history;
    const size_t last = history.size() - 1;
    return JointPositions(context.skeleton, history[last - std::min(back, last)]).col(joint);
  };
  const double speed = (at(0) - at(1)).norm() * context.fps;
  const double before = (at(1) - at(2)).norm() * context.fps;
  return speed < kStillSpeed || speed < kLandingShare * before;
}

FootTrack Track(const FootworkContext& context, const Leg& leg, double toes_rest, double ankle_rest,
                const std::vector<JointPlacement>& placements,
                const std::vector<BodyCentre>& centres) {
  const auto height = [&](const Eigen::Matrix3Xd& at) {
    return std::min(at(1, leg.toes) - toes_rest, at(1, leg.ankle) - ankle_rest);
  };
  FootTrack track;
  for (size_t i = 0; i < placements.size(); ++i) {
    const Eigen::Matrix3Xd& at = placements[i].positions;
    track.toes.push_back(at.col(leg.toes));
    track.heights.push_back(height(at));
    const double outside =
        DistanceToHull(ZeroMomentPoint(centres, static_cast<int>(i), context.fps),
                       {{at(0, leg.toes), at(2, leg.toes)}, {at(0, leg.ankle), at(2, leg.ankle)}});
    const double beyond = std::max(0.0, outside - context.options.sole);
    track.unbalanced.push_back(beyond * beyond);
  }
  const auto& history = context.history;
  const Eigen::Matrix3Xd before = JointPositions(context.skeleton, history.back());
  track.before = before.col(leg.toes);
  track.height_before = track.fall_before = height(before);
  track.fall_after = track.heights.back();
  track.stood = track.before.y() - toes_rest < kUpHeight && Rests(context, leg.toes);
  if (context.keyed) {
    const bool low = track.toes.back().y() - toes_rest < kUpHeight;
    track.end = low ? FootTrack::End::kStands : FootTrack::End::kInAir;
  }
  return track;
}

// A flying body falls no farther than to its standing height, however high its feet are.
void LimitFalls(const FootworkContext& context, const Pose& end, double rise,
                std::array<FootTrack, 2>* feet) {
  const auto fly = [&](double FootTrack::*fall) {
    return std::ranges::all_of(*feet,
                               [&](const FootTrack& foot) { return foot.*fall > kSoleHeight; });
  };
  const auto limit = [&](double FootTrack::*fall, const Pose& from) {
    const double stands = RestPose(context.skeleton).root_position.y();
    for (FootTrack& foot : *feet)
      foot.*fall = std::min(foot.*fall, std::max(0.0, from.root_position.y() - stands));
  };
  if (fly(&FootTrack::fall_before)) {
    for (FootTrack& foot : *feet) foot.rise_before = rise;
    limit(&FootTrack::fall_before, context.history.back());
  }
  if (fly(&FootTrack::fall_after)) limit(&FootTrack::fall_after, end);
}

}  // namespace

FeetAtRest::FeetAtRest(const Skeleton& skeleton)
    : legs(Leg::Of(skeleton)), clearance(FloorClearance(skeleton)) {
  const Eigen::Matrix3Xd rest = JointPositions(skeleton, RestPose(skeleton));
  for (size_t side = 0; side < 2; ++side) {
    toes_rest[side] = rest(1, legs[side].toes);
    ankle_rest[side] = rest(1, legs[side].ankle);
  }
}

std::vector<Eigen::Vector2d> CarriersOf(const Skeleton& skeleton, const FeetAtRest& feet,
                                        const Eigen::Matrix3Xd& joints) {
  std::vector<Eigen::Vector2d> carriers;
  for (const int joint : JointsOnFloor(skeleton, feet.clearance, joints))
    carriers.emplace_back(joints(0, joint), joints(2, joint));
  return carriers;
}

std::vector<BodyCentre> CentresOfMass(const FootworkContext& context,
                                      const std::vector<Pose>& plan) {
  const Eigen::VectorXd masses = MassWeights(context.skeleton);
  std::vector<Eigen::Vector3d> exact;
  const auto add = [&](const Pose& pose) {
    exact.push_back(JointPositions(context.skeleton, pose) * masses);
  };
  add(context.history.front());  // there are two frames before the plan then
  std::ranges::for_each(context.history, add);
  std::ranges::for_each(plan, add);
  const auto last = static_cast<int64_t>(exact.size()) - 1;
  const auto centre = [&](int64_t i) -> const Eigen::Vector3d& {
    return exact[static_cast<size_t>(i)];
  };
  std::vector<BodyCentre> centres;
  for (int64_t at = last - std::ssize(plan) - 1; at <= last; ++at) {
    const int64_t from = std::max<int64_t>(1, at - kSmoothReach);
    const int64_t to = std::min(last, at + kSmoothReach);
    centres.push_back({centre(at), GaussianMean(from, to, at, kSmoothFrames,
                                                Eigen::Vector3d(Eigen::Vector3d::Zero()), centre)});
  }
  return centres;
}

std::array<FootTrack, 2> TrackFeet(const FootworkContext& context, const FeetAtRest& feet,
                                   const std::vector<Pose>& plan,
                                   const std::vector<JointPlacement>& placements,
                                   const std::vector<std::vector<Eigen::Vector2d>>& carriers,
                                   const std::vector<BodyCentre>& centres) {
  const auto track = [&](size_t side) {
    return Track(context, feet.legs[side], feet.toes_rest[side], feet.ankle_rest[side], placements,
                 centres);
  };
  std::array<FootTrack, 2> tracks = {track(0), track(1)};
  for (FootTrack& foot : tracks) {
    for (size_t i = 0; i < carriers.size(); ++i) {
      foot.carried.push_back(!carriers[i].empty());
      if (foot.carried.back()) foot.unbalanced[i] = 0;
    }
  }
  LimitFalls(context, plan.back(), (centres[2].smooth - centres[1].smooth).y() * context.fps,
             &tracks);
  return tracks;
}

}  // namespace choreo
