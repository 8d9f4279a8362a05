#include "model/plan/footwork.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/core/gaussian_mean.h"
#include "model/core/smooth_step.h"
#include "model/motion/body_mass.h"
#include "model/motion/contacts.h"
#include "model/motion/kinematics.h"
#include "model/motion/limb.h"
#include "model/motion/support.h"
#include "model/plan/contact_plan.h"
#include "model/plan/pelvis_offset.h"
#include "model/plan/toes_path.h"

namespace choreo {
namespace {

constexpr double kHalfToes =
    0.75;  // share of a foot's length: the height of its ankle on half toes
constexpr double kStillSpeed = 0.3;    // m/s: a low foot slower than this stands
constexpr int kPasses = 2;             // the second one, as moved legs move the centre of mass
constexpr double kSmoothFrames = 1.5;  // smoothing of the centre of mass
constexpr int kSmoothReach = 4;

class PlanStander {
 public:
  PlanStander(const FootworkContext& context, std::vector<Pose>* plan)
      : context_(context),
        skeleton_(context.skeleton),
        legs_(Leg::Of(context.skeleton)),
        masses_(MassWeights(context.skeleton)),
        plan_(*plan),
        frames_(static_cast<int>(plan->size())) {
    const Eigen::Matrix3Xd rest = JointPositions(skeleton_, RestPose(skeleton_));
    for (size_t side = 0; side < 2; ++side) {
      toes_rest_[side] = rest(1, legs_[side].toes);
      ankle_rest_[side] = rest(1, legs_[side].ankle);
    }
    for (const Pose& pose : plan_) planned_.push_back(ForwardKinematics(skeleton_, pose));
  }

  Footwork Run() {
    const std::vector<Pose> proposed = plan_;
    centres_ = Centres();
    std::array<FootTrack, 2> feet = {Track(0), Track(1)};
    LimitFalls(&feet);
    stances_ = PlanContacts(feet, context_.fps, context_.options);
    if (context_.has_path) StepUnder();
    for (size_t side = 0; side < 2; ++side) {
      toes_[side] = ToesPath(feet[side], stances_[side], toes_rest_[side], context_.keyed,
                             context_.fps, context_.options.shortest_step);
      LayDown(side);
    }
    offset_ = Eigen::Matrix3Xd::Zero(3, frames_);
    for (int pass = 0; pass < (context_.held ? 1 : kPasses); ++pass) {
      if (pass > 0) centres_ = Centres();
      // A held pose keeps its balance: a pelvis or feet that moved away and back would tremble.
      if (!context_.held)
        offset_ = PelvisOffset(Supports(), centres_.front() - context_.offset_before.col(1),
                               {.returns = context_.keyed,
                                .heights_alone = context_.has_path,
                                .before = context_.offset_before,
                                .fps = context_.fps,
                                .options = context_.options});
      plan_ = proposed;
      PlaceLegs();
    }
    if (!context_.held && RaiseFromFloor()) {
      plan_ = proposed;
      PlaceLegs();
    }
    Footwork result{.contacts = FinalContacts()};
    result.offset.col(0) = context_.offset_before.col(1);
    result.offset.rightCols(std::min(2, frames_)) = offset_.rightCols(std::min(2, frames_));
    return result;
  }

 private:
  bool Stands(size_t side, int frame) const { return StanceAt(stances_[side], frame) != nullptr; }
  // The share of a change within kSettleSeconds that is done after so many frames.
  double Settled(int frames) const {
    return SmoothStep(std::clamp(frames / (kSettleSeconds * context_.fps), 0.0, 1.0));
  }
  bool IsKey(int frame) const { return context_.keyed && frame == frames_ - 1; }

  // The smoothed centre of mass of the plan as it is now; index 0 is the frame before the first.
  std::vector<Eigen::Vector3d> Centres() const {
    std::vector<Eigen::Vector3d> exact, smooth;
    const auto add = [&](const Pose& pose) {
      exact.push_back(JointPositions(skeleton_, pose) * masses_);
    };
    std::ranges::for_each(context_.history, add);
    std::ranges::for_each(plan_, add);
    const auto last = static_cast<int64_t>(exact.size()) - 1;
    for (int64_t at = last - frames_; at <= last; ++at) {
      smooth.push_back(GaussianMean(
          std::max<int64_t>(0, at - kSmoothReach), std::min(last, at + kSmoothReach), at,
          kSmoothFrames, Eigen::Vector3d(Eigen::Vector3d::Zero()),
          [&](int64_t i) -> const Eigen::Vector3d& { return exact[static_cast<size_t>(i)]; }));
    }
    return smooth;
  }

  Eigen::Vector2d ZeroMomentPoint(int frame) const {
    const auto centre = [&](int i) -> const Eigen::Vector3d& {
      return centres_[static_cast<size_t>(std::min(i, frames_ - 1) + 1)];
    };
    const Eigen::Vector3d& at = centre(frame);
    const Eigen::Vector3d acceleration =
        (centre(frame + 1) - 2 * at + centre(frame - 1)) * (context_.fps * context_.fps);
    const double lever = MomentLever(at.y(), acceleration.y());
    return {at.x() - lever * acceleration.x(), at.z() - lever * acceleration.z()};
  }

  FootTrack Track(size_t side) const {
    const Leg& leg = legs_[side];
    const auto height = [&](const Eigen::Matrix3Xd& at) {
      return std::min(at(1, leg.toes) - toes_rest_[side], at(1, leg.ankle) - ankle_rest_[side]);
    };
    FootTrack track;
    for (int frame = 0; frame < frames_; ++frame) {
      const Eigen::Matrix3Xd& at = planned_[static_cast<size_t>(frame)].positions;
      track.toes.push_back(at.col(leg.toes));
      track.heights.push_back(height(at));
      const double outside = DistanceToHull(
          ZeroMomentPoint(frame),
          {{at(0, leg.toes), at(2, leg.toes)}, {at(0, leg.ankle), at(2, leg.ankle)}});
      const double beyond = std::max(0.0, outside - context_.options.sole);
      track.unbalanced.push_back(beyond * beyond);
    }
    const auto& history = context_.history;
    const Eigen::Matrix3Xd before = JointPositions(skeleton_, history.back());
    const Eigen::Matrix3Xd earlier =
        JointPositions(skeleton_, history[history.size() - std::min<size_t>(2, history.size())]);
    track.before = before.col(leg.toes);
    track.fall_before = height(before);
    track.fall_after = track.heights.back();
    const double speed = (track.before - earlier.col(leg.toes)).norm() * context_.fps;
    track.stood = track.before.y() - toes_rest_[side] < kUpHeight && speed < kStillSpeed;
    if (context_.keyed) {
      const bool low = track.toes.back().y() - toes_rest_[side] < kUpHeight;
      track.end = low ? FootTrack::End::kStands : FootTrack::End::kInAir;
    }
    return track;
  }

  // A flying body falls no farther than to where it stands, however high its feet are.
  void LimitFalls(std::array<FootTrack, 2>* feet) const {
    const auto fly = [&](double FootTrack::*fall) {
      return std::ranges::all_of(*feet,
                                 [&](const FootTrack& foot) { return foot.*fall > kSoleHeight; });
    };
    const auto limit = [&](double FootTrack::*fall, const Pose& from) {
      const double stands = RestPose(skeleton_).root_position.y();
      for (FootTrack& foot : *feet)
        foot.*fall = std::min(foot.*fall, std::max(0.0, from.root_position.y() - stands));
    };
    if (fly(&FootTrack::fall_before)) {
      const double rise = (centres_[1] - centres_[0]).y() * context_.fps;
      for (FootTrack& foot : *feet) foot.rise_before = rise;
      limit(&FootTrack::fall_before, context_.history.back());
    }
    if (fly(&FootTrack::fall_after)) limit(&FootTrack::fall_after, plan_.back());
  }

  // The way from the feet that stand in a frame to the centre of mass, without the sole.
  Eigen::Vector2d Beyond(int frame) const {
    std::vector<Eigen::Vector2d> hull;
    for (size_t side = 0; side < 2; ++side) {
      const Stance* stance = StanceAt(stances_[side], frame);
      if (stance == nullptr) continue;
      const Eigen::Matrix3Xd& at = planned_[static_cast<size_t>(frame)].positions;
      const Eigen::Vector3d ankle =
          stance->place + at.col(legs_[side].ankle) - at.col(legs_[side].toes);
      hull.emplace_back(stance->place.x(), stance->place.z());
      hull.emplace_back(ankle.x(), ankle.z());
    }
    const Eigen::Vector3d& centre = centres_[static_cast<size_t>(frame) + 1];
    const Eigen::Vector2d point(centre.x(), centre.z());
    return -WayToHull(point, std::move(hull), context_.options.sole);
  }

  // The pelvis cannot sway over the feet on a path, so the feet move under the body: each stance
  // moves by its mean distance from there. Stances of the history and of a key stay.
  void StepUnder() {
    for (size_t side = 0; side < 2; ++side) {
      for (Stance& stance : stances_[side]) {
        const bool kept = stance.from == 0 || (context_.keyed && stance.to == frames_ - 1);
        if (kept) continue;
        Eigen::Vector2d sum = Eigen::Vector2d::Zero();
        for (int frame = stance.from; frame <= stance.to; ++frame) sum += Beyond(frame);
        sum /= stance.to - stance.from + 1;
        stance.place.x() += sum.x();
        stance.place.z() += sum.y();
      }
    }
  }

  // How much a foot supports in a frame, 0 to 1: it changes within kSettleSeconds, starting from
  // the support before.
  double Bears(size_t side, int frame) const {
    const Stance* stance = StanceAt(stances_[side], frame);
    if (stance == nullptr) return 0;
    const int since = stance->from == 0 ? frames_ : frame - stance->from;
    const int until = stance->to == frames_ - 1 && !context_.keyed ? frames_ : stance->to - frame;
    return Settled(std::min(since, until));
  }

  // Limits ankles: none is lower than in a flat foot, and that of a supporting foot is at most as
  // high as on half toes. The foot turns about its toes for that. What the previous pose and a key
  // do beyond these limits fades out, or in, within kSettleSeconds; a held pose keeps it.
  void LayDown(size_t side) {
    const Leg& leg = legs_[side];
    const auto sunk = [&](const Eigen::Matrix3Xd& at) {
      return std::max(0.0, ankle_rest_[side] - at(1, leg.ankle));
    };
    const auto steep = [&](const Eigen::Matrix3Xd& at) {
      return std::abs(at(1, leg.toes) - at(1, leg.ankle));
    };
    const Eigen::Matrix3Xd before = JointPositions(skeleton_, context_.history.back());
    const Eigen::Matrix3Xd& end = planned_.back().positions;
    // Of a measure of the foot, what is left of the previous pose's and the key's in a frame.
    const auto own = [&](const auto& measure, int frame) {
      const double first = measure(before), last = context_.keyed ? measure(end) : 0;
      if (context_.held) return std::max(first, last);
      return std::max((1 - Settled(frame + 1)) * first, (1 - Settled(frames_ - 1 - frame)) * last);
    };
    for (int frame = 0; frame < frames_; ++frame) {
      if (IsKey(frame)) return;
      const auto i = static_cast<size_t>(frame);
      const double least = ankle_rest_[side] - own(sunk, frame);
      JointPlacement& at = planned_[i];
      const Eigen::Vector3d ankle = at.positions.col(leg.ankle);
      const Eigen::Vector3d foot = at.positions.col(leg.toes) - ankle;
      const double length = foot.norm(), along = std::hypot(foot.x(), foot.z());
      if (along < 1e-6) continue;
      const double half_toes = length * (1 - (1 - kHalfToes) * Bears(side, frame));
      const double steepest = std::max(half_toes, own(steep, frame));
      const double highest = std::max(toes_[side][i].y() - least, -length);
      const double rise = std::clamp(foot.y(), std::min(-steepest, highest), highest);
      if (rise == foot.y()) continue;
      const double flat = std::sqrt(std::max(0.0, length * length - rise * rise)) / along;
      const Eigen::Vector3d laid(flat * foot.x(), rise, flat * foot.z());
      at.rotations[static_cast<size_t>(leg.ankle)] =
          Eigen::Quaterniond::FromTwoVectors(foot, laid).toRotationMatrix() *
          at.rotations[static_cast<size_t>(leg.ankle)];
      at.positions.col(leg.toes) = ankle + laid;
    }
  }

  std::vector<SupportFrame> Supports() const {
    std::vector<SupportFrame> supports(plan_.size());
    for (int frame = 0; frame < frames_; ++frame) {
      const auto i = static_cast<size_t>(frame);
      SupportFrame& support = supports[i];
      support.centre = centres_[i + 1] - offset_.col(frame);
      const Eigen::Matrix3Xd& at = planned_[i].positions;
      for (size_t side = 0; side < 2; ++side) {
        if (!Stands(side, frame)) continue;
        const Leg& leg = legs_[side];
        const Eigen::Vector3d toes = toes_[side][i];
        const Eigen::Vector3d ankle = toes + at.col(leg.ankle) - at.col(leg.toes);
        support.legs.push_back(
            {ankle - at.col(leg.hip), (at.col(leg.knee) - at.col(leg.hip)).norm() +
                                          (at.col(leg.ankle) - at.col(leg.knee)).norm()});
        support.support.emplace_back(toes.x(), toes.z());
        support.support.emplace_back(ankle.x(), ankle.z());
      }
    }
    return supports;
  }

  void PlaceLegs() {
    const JointPlacement before = ForwardKinematics(skeleton_, context_.history.back());
    std::array<double, 2> bends = {KneeBend(legs_[0], before), KneeBend(legs_[1], before)};
    for (int frame = 0; frame < frames_; ++frame) {
      if (IsKey(frame)) return;
      const auto i = static_cast<size_t>(frame);
      plan_[i].root_position += offset_.col(frame);
      JointPlacement at = planned_[i];
      at.positions.colwise() += Eigen::Vector3d(offset_.col(frame));
      for (size_t side = 0; side < 2; ++side) {
        Eigen::Vector3d toes = toes_[side][i];
        if (!Stands(side, frame)) toes = WithinReach(legs_[side], at, toes, kStraightestLeg);
        bends[side] = PlaceToes(legs_[side], skeleton_, at, toes, &plan_[i],
                                NextBend(bends[side], 1 / context_.fps));
      }
    }
  }

  // Raises the pelvis around frames in which another joint than the feet's is under the floor, as
  // knees are on the way to and from the floor. True if there are any.
  bool RaiseFromFloor() {
    const double lowest = std::min(toes_rest_[0], toes_rest_[1]);
    std::vector<double> sunk(plan_.size());
    for (int frame = 0; frame < frames_; ++frame) {
      if (IsKey(frame)) continue;
      const auto i = static_cast<size_t>(frame);
      Eigen::RowVectorXd heights = JointPositions(skeleton_, plan_[i]).row(1);
      for (const int foot : skeleton_.feet) heights[foot] = lowest;
      sunk[i] = lowest - heights.minCoeff();
    }
    if (std::ranges::max(sunk) <= 0) return false;
    for (int frame = 0; frame < frames_; ++frame) {
      double most = 0;
      for (int at = 0; at < frames_; ++at)
        most = std::max(most, (1 - Settled(std::abs(at - frame))) * sunk[static_cast<size_t>(at)]);
      const int from_end = context_.keyed ? frames_ - 1 - frame : frames_;
      offset_(1, frame) += Settled(std::min(frame + 1, from_end)) * most;
    }
    return true;
  }

  // The foot keeps its rotation, so its ankle moves with its toes.
  std::vector<Contacts> FinalContacts() const {
    std::vector<Contacts> contacts(plan_.size());
    for (int frame = 0; frame < frames_; ++frame) {
      const auto i = static_cast<size_t>(frame);
      for (size_t side = 0; side < 2; ++side) {
        if (!Stands(side, frame)) continue;
        const Eigen::Matrix3Xd& at = planned_[i].positions;
        const double ankle =
            toes_[side][i].y() + at(1, legs_[side].ankle) - at(1, legs_[side].toes);
        contacts[i][2 * side] = ankle < ankle_rest_[side] + kDownHeight ? 1.0F : 0.0F;
        contacts[i][2 * side + 1] = 1.0F;
      }
    }
    return contacts;
  }

  const FootworkContext& context_;
  const Skeleton& skeleton_;
  const std::array<Leg, 2> legs_;
  const Eigen::VectorXd masses_;
  std::vector<Pose>& plan_;
  const int frames_;
  std::array<double, 2> toes_rest_, ankle_rest_;  // heights at rest
  std::vector<JointPlacement> planned_;           // the plan as proposed
  std::vector<Eigen::Vector3d> centres_;
  std::array<std::vector<Stance>, 2> stances_;
  std::array<std::vector<Eigen::Vector3d>, 2> toes_;
  Eigen::Matrix3Xd offset_;  // of the pelvis
};

}  // namespace

Footwork StandOnFeet(const FootworkContext& context, std::vector<Pose>* plan) {
  if (plan->empty() || !Leg::In(context.skeleton) || MassWeights(context.skeleton).size() == 0)
    return {};
  return PlanStander(context, plan).Run();
}

}  // namespace choreo
