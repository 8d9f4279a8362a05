#include "model/plan/footwork.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/core/numbers/smooth_step.h"
#include "model/motion/floor/contacts.h"
#include "model/motion/floor/support.h"
#include "model/motion/kinematics/body_mass.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/limb.h"
#include "model/motion/rotation.h"
#include "model/plan/contact_plan.h"
#include "model/plan/foot_tracks.h"
#include "model/plan/pelvis_offset.h"
#include "model/plan/toes_path.h"

namespace choreo {
namespace {

constexpr double kHalfToes =
    0.75;                         // share of a foot's length: the height of its ankle on half toes
constexpr double kLeanSpeed = 6;  // rad/s
constexpr int kPasses = 2;        // twice, because moving the legs moves the centre of mass

class PlanStander {
 public:
  PlanStander(const FootworkContext& context, std::vector<Pose>* plan)
      : context_(context),
        skeleton_(context.skeleton),
        feet_(context.skeleton),
        plan_(*plan),
        frames_(static_cast<int>(plan->size())) {
    for (const Pose& pose : plan_) {
      planned_.push_back(ForwardKinematics(skeleton_, pose));
      carriers_.push_back(CarriersOf(skeleton_, feet_, planned_.back().positions));
    }
  }

  Footwork Run() {
    RaisePlan();
    const std::vector<Pose> proposed = plan_;
    centres_ = CentresOfMass(context_, plan_);
    const std::array<FootTrack, 2> feet =
        TrackFeet(context_, feet_, plan_, planned_, carriers_, centres_);
    stances_ = PlanContacts(feet, context_.fps, context_.options);
    if (context_.has_path) StepUnder();
    for (size_t side = 0; side < 2; ++side) {
      toes_[side] = ToesPath(feet[side], stances_[side], feet_.toes_rest[side], context_.keyed,
                             context_.fps, context_.options.shortest_step);
      LayDown(side);
    }
    offset_ = Eigen::Matrix3Xd::Zero(3, frames_);
    for (int pass = 0; pass < (context_.held ? 1 : kPasses); ++pass) {
      if (pass > 0) centres_ = CentresOfMass(context_, plan_);
      // A held pose keeps its balance, because moving pelvis or feet away and back would look like
      // trembling.
      if (!context_.held)
        offset_ = PelvisOffset(Supports(),
                               {WithoutOffset(centres_[0], context_.offset_before.col(0)),
                                WithoutOffset(centres_[1], context_.offset_before.col(1))},
                               {.returns = context_.keyed,
                                .heights_alone = context_.has_path,
                                .since_carried = SinceCarried(),
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
  // The completed share of a change over kSettleSeconds after `frames` frames.
  double Settled(int frames) const {
    return SmoothStep(std::clamp(frames / (kSettleSeconds * context_.fps), 0.0, 1.0));
  }
  // How many frames before the first one other joints than the feet's carried the body.
  int SinceCarried() const {
    const auto carries = [this](const Pose& pose) {
      return !CarriersOf(skeleton_, feet_, JointPositions(skeleton_, pose)).empty();
    };
    const auto& history = context_.history;
    const auto last = std::find_if(history.rbegin(), history.rend(), carries);
    return last == history.rend() ? std::numeric_limits<int>::max()
                                  : static_cast<int>(last - history.rbegin()) + 1;
  }
  bool IsKey(int frame) const { return context_.keyed && frame == frames_ - 1; }

  // The vector from the body's support in a frame to its centre of mass, not counting the sole.
  Eigen::Vector2d Beyond(int frame) const {
    std::vector<Eigen::Vector2d> hull = carriers_[static_cast<size_t>(frame)];
    for (size_t side = 0; side < 2; ++side) {
      const Stance* stance = StanceAt(stances_[side], frame);
      if (stance == nullptr) continue;
      const Eigen::Matrix3Xd& at = planned_[static_cast<size_t>(frame)].positions;
      const Eigen::Vector3d ankle =
          stance->place + at.col(feet_.legs[side].ankle) - at.col(feet_.legs[side].toes);
      hull.emplace_back(stance->place.x(), stance->place.z());
      hull.emplace_back(ankle.x(), ankle.z());
    }
    const Eigen::Vector3d& centre = centres_[static_cast<size_t>(frame) + 2].smooth;
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

  // The rotation vector from one direction to another.
  static Eigen::Vector3d TurnTo(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const Eigen::AngleAxisd turn(Eigen::Quaterniond::FromTwoVectors(from, to));
    return turn.angle() * turn.axis();
  }
  // `foot`, turned up or down so that it rises by `rise`, at most its length. An upright foot
  // stays.
  static Eigen::Vector3d WithHeight(const Eigen::Vector3d& foot, double rise) {
    const double along = std::hypot(foot.x(), foot.z());
    if (rise == foot.y() || along < 1e-6) return foot;
    const double flat = std::sqrt(std::max(0.0, foot.squaredNorm() - rise * rise)) / along;
    return {flat * foot.x(), rise, flat * foot.z()};
  }

  // Limits ankles: none is lower than in a flat foot, and a supporting foot's is at most as high as
  // on half toes. The foot turns about its toes for that. What the previous pose and a key do
  // beyond these limits fades out, or in, within kSettleSeconds; a held pose keeps it. A foot that
  // tips over its toes is to be turned one way before and the other way after: kLeanSpeed lets it
  // tip, without a snap.
  void LayDown(size_t side) {
    const Leg& leg = feet_.legs[side];
    const auto sunk = [&](const Eigen::Matrix3Xd& at) {
      return std::max(0.0, feet_.ankle_rest[side] - at(1, leg.ankle));
    };
    const auto steep = [&](const Eigen::Matrix3Xd& at) {
      return std::abs(at(1, leg.toes) - at(1, leg.ankle));
    };
    const Eigen::Matrix3Xd before = JointPositions(skeleton_, context_.history.back());
    const Eigen::Matrix3Xd& end = planned_.back().positions;
    // The part of the previous pose's and the key's measure that remains in a frame.
    const auto own = [&](const auto& measure, int frame) {
      const double first = measure(before), last = context_.keyed ? measure(end) : 0;
      if (context_.held) return std::max(first, last);
      return std::max((1 - Settled(frame + 1)) * first, (1 - Settled(frames_ - 1 - frame)) * last);
    };
    Eigen::Vector3d lean = Eigen::Vector3d::Zero();  // how the foot is turned to be less steep
    for (int frame = 0; frame < frames_; ++frame) {
      if (IsKey(frame)) return;
      const auto i = static_cast<size_t>(frame);
      const double least = feet_.ankle_rest[side] - own(sunk, frame);
      JointPlacement& at = planned_[i];
      const Eigen::Vector3d ankle = at.positions.col(leg.ankle);
      const Eigen::Vector3d foot = at.positions.col(leg.toes) - ankle;
      const double length = foot.norm();
      const double half_toes = length * (1 - (1 - kHalfToes) * Bears(side, frame));
      const double steepest = std::max(half_toes, own(steep, frame));
      const Eigen::Vector3d change =
          TurnTo(foot, WithHeight(foot, std::max(foot.y(), -steepest))) - lean;
      // Continues from the pose before, as `own` has it.
      const double most = frame == 0 ? INFINITY : kLeanSpeed / context_.fps;
      lean += change * std::min(1.0, most / std::max(1e-9, change.norm()));
      const Eigen::Vector3d leant = ExpMap(lean) * foot;
      const double highest = std::max(toes_[side][i].y() - least, -length);
      const Eigen::Vector3d laid = WithHeight(leant, std::min(leant.y(), highest));
      if (laid == foot) continue;
      at.rotations[static_cast<size_t>(leg.ankle)] =
          ExpMap(TurnTo(foot, laid)) * at.rotations[static_cast<size_t>(leg.ankle)];
      at.positions.col(leg.toes) = ankle + laid;
    }
  }

  static BodyCentre WithoutOffset(const BodyCentre& danced, const Eigen::Vector3d& offset) {
    return {danced.exact - offset, danced.smooth - offset};
  }
  std::vector<SupportFrame> Supports() const {
    std::vector<SupportFrame> supports(plan_.size());
    for (int frame = 0; frame < frames_; ++frame) {
      const auto i = static_cast<size_t>(frame);
      SupportFrame& support = supports[i];
      support.centre = WithoutOffset(centres_[i + 2], offset_.col(frame));
      support.support = carriers_[i];
      support.carried = !carriers_[i].empty();
      const Eigen::Matrix3Xd& at = planned_[i].positions;
      for (size_t side = 0; side < 2; ++side) {
        if (!Stands(side, frame)) continue;
        const Leg& leg = feet_.legs[side];
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
    std::array<double, 2> bends = {KneeBend(feet_.legs[0], before),
                                   KneeBend(feet_.legs[1], before)};
    for (int frame = 0; frame < frames_; ++frame) {
      if (IsKey(frame)) return;
      const auto i = static_cast<size_t>(frame);
      plan_[i].root_position += offset_.col(frame);
      JointPlacement at = planned_[i];
      at.positions.colwise() += Eigen::Vector3d(offset_.col(frame));
      for (size_t side = 0; side < 2; ++side) {
        Eigen::Vector3d toes = toes_[side][i];
        if (!Stands(side, frame)) toes = WithinReach(feet_.legs[side], at, toes, kStraightestLeg);
        bends[side] = PlaceToes(feet_.legs[side], skeleton_, at, toes, &plan_[i],
                                NextBend(bends[side], 1 / context_.fps));
      }
    }
  }

  // The share that `frame` has of a raise by so many metres in the frame `at`. A raise begins with
  // the plan at the earliest.
  double Share(int frame, int at, double raise) const {
    const double usual =
        context_.fps * std::max(kSettleSeconds, StepSeconds(raise, context_.options.acceleration));
    const double most = frame < at ? at + 1 : frames_;
    const double reach = std::max(kSettleSeconds * context_.fps, std::min(usual, most));
    return 1 - SmoothStep(std::min(1.0, std::abs(frame - at) / reach));
  }

  // By how much to raise frames: at least as much as each has `sunk`, and no frame higher than the
  // one that needs it. The ends keep their height; next to them a raise takes kSettleSeconds.
  std::vector<double> Raises(const std::vector<double>& sunk) const {
    std::vector<double> raises(sunk.size());
    for (int frame = 0; frame < frames_; ++frame) {
      double most = 0;
      for (size_t at = 0; at < sunk.size(); ++at) {
        const double needed = plan_[at].root_position.y() + sunk[at] -
                              plan_[static_cast<size_t>(frame)].root_position.y();
        const double share = Share(frame, static_cast<int>(at), sunk[at]);
        most = std::max(most, std::min(needed, share * sunk[at]));
      }
      const int from_end = context_.keyed ? frames_ - 1 - frame : frames_;
      raises[static_cast<size_t>(frame)] = Settled(std::min(frame + 1, from_end)) * most;
    }
    return raises;
  }

  // Raises the plan where the body leaves or reaches the floor, because its legs would swing
  // through the floor. Elsewhere legs under the floor bend.
  void RaisePlan() {
    if (context_.held || context_.has_heights) return;
    std::vector<double> sunk(plan_.size());
    for (size_t i = 0; i < plan_.size(); ++i) {
      if (carriers_[i].empty() || IsKey(static_cast<int>(i))) continue;
      sunk[i] = std::max(0.0, (feet_.clearance - planned_[i].positions.row(1)).maxCoeff());
    }
    if (std::ranges::max(sunk) <= 0) return;
    const std::vector<double> raises = Raises(sunk);
    for (size_t i = 0; i < plan_.size(); ++i) {
      plan_[i].root_position.y() += raises[i];
      planned_[i].positions.row(1).array() += raises[i];
      carriers_[i] = CarriersOf(skeleton_, feet_, planned_[i].positions);
    }
  }

  // Raises the pelvis around frames in which another joint than the feet's is under the floor, as
  // knees are on the way to and from the floor. True if there are any.
  bool RaiseFromFloor() {
    const double lowest = std::min(feet_.toes_rest[0], feet_.toes_rest[1]);
    std::vector<double> sunk(plan_.size());
    for (int frame = 0; frame < frames_; ++frame) {
      if (IsKey(frame)) continue;
      const auto i = static_cast<size_t>(frame);
      Eigen::RowVectorXd heights = JointPositions(skeleton_, plan_[i]).row(1);
      for (const int foot : skeleton_.feet) heights[foot] = lowest;
      sunk[i] = lowest - heights.minCoeff();
    }
    if (std::ranges::max(sunk) <= 0) return false;
    const std::vector<double> raises = Raises(sunk);
    for (int frame = 0; frame < frames_; ++frame)
      offset_(1, frame) += raises[static_cast<size_t>(frame)];
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
            toes_[side][i].y() + at(1, feet_.legs[side].ankle) - at(1, feet_.legs[side].toes);
        contacts[i][2 * side] = ankle < feet_.ankle_rest[side] + kDownHeight ? 1.0F : 0.0F;
        contacts[i][2 * side + 1] = 1.0F;
      }
    }
    return contacts;
  }

  const FootworkContext& context_;
  const Skeleton& skeleton_;
  const FeetAtRest feet_;
  std::vector<Pose>& plan_;
  const int frames_;
  std::vector<JointPlacement> planned_;                 // the plan as proposed
  std::vector<std::vector<Eigen::Vector2d>> carriers_;  // by frame
  std::vector<BodyCentre> centres_;                     // from two frames before the first on
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
