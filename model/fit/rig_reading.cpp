#include "model/fit/rig_reading.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "model/core/error.h"
#include "model/core/numbers/quantile.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "model/motion/skeleton.h"

namespace choreo {
namespace {

constexpr int64_t kSamples = 200;  // frames sampled to find what is constant
// The largest deviation of a rest pose's limbs from SMPL's, radians. Legs hang; arms are anywhere
// between hanging and held out.
constexpr double kLegsAside = 50 / kDegrees, kArmsAside = 115 / kDegrees;
constexpr double kTrunkAside = 35 / kDegrees;
// In its own frame, a bone that moves the next one keeps it in the same place, within kLooseBone
// radians, except for kMaxLoose bones.
constexpr double kLooseBone = 15 / kDegrees;
constexpr int kMaxLoose = 2;

const Skeleton& OurBody() { return Skeleton::Smpl24(); }

double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// The nearest of the six axes.
Eigen::Vector3d NearestAxis(const Eigen::Vector3d& way) {
  Eigen::Index axis = 0;
  way.cwiseAbs().maxCoeff(&axis);
  return Eigen::Vector3d::Unit(axis) * (way[axis] < 0 ? -1 : 1);
}

// The placement as a CharacterBody, if it is a standing body with arms hanging or held out.
std::optional<CharacterBody> RestBody(const HumanBones& bones, const Eigen::Matrix3Xd& places) {
  std::optional<CharacterBody> body;
  try {
    body = MakeCharacterBody(bones, places);
  } catch (const Error&) {
    return std::nullopt;
  }
  const Eigen::Matrix3d upright = body->turns[0];
  const auto place = [&](const std::string& bone) -> Eigen::Vector3d {
    return upright * places.col(bones.Find(bone));
  };
  const Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d trunk =
      place("left_shoulder") + place("right_shoulder") - place("left_hip") - place("right_hip");
  if (AngleBetween(trunk, up) > kTrunkAside) return std::nullopt;
  const Eigen::Matrix3Xd rest = JointPositions(OurBody(), RestPose(OurBody()));
  for (const LimbSegment& segment : LimbSegments()) {
    const Eigen::Vector3d ours =
        rest.col(OurBody().Find(segment.to)) - rest.col(OurBody().Find(segment.from));
    const bool leg = segment.to.ends_with("knee") || segment.to.ends_with("ankle");
    const double aside = AngleBetween(place(segment.to) - place(segment.from), ours);
    if (aside > (leg ? kLegsAside : kArmsAside)) return std::nullopt;
  }
  for (const std::string joint : {"hip", "shoulder"})
    if ((place("left_" + joint) - place("right_" + joint)).x() < 0) return std::nullopt;
  // A body at rest is symmetric; one in the middle of a dance is not.
  for (size_t i = 0; i < LimbSegments().size() / 2; ++i) {
    const LimbSegment &left = LimbSegments()[i],
                      &right = LimbSegments()[i + LimbSegments().size() / 2];
    const Eigen::Vector3d mirrored =
        Eigen::Vector3d(-1, 1, 1).asDiagonal() * (place(right.to) - place(right.from));
    if (AngleBetween(place(left.to) - place(left.from), mirrored) > 2 * kLooseBone)
      return std::nullopt;
  }
  if (bones.Find("head") >= 0 && bones.Find("neck") >= 0 &&
      (place("head") - place("neck")).dot(up) < 0)
    return std::nullopt;
  return body;
}

}  // namespace

const std::vector<LimbSegment>& LimbSegments() {
  static const std::vector<LimbSegment> segments = [] {
    std::vector<LimbSegment> all;
    for (const std::string side : {"left_", "right_"}) {
      for (const auto& [from, to] : {std::pair("hip", "knee"), std::pair("knee", "ankle"),
                                     std::pair("shoulder", "elbow"), std::pair("elbow", "wrist")})
        all.push_back({side + from, side + to});
    }
    return all;
  }();
  return segments;
}

RigReading::RigReading(const RigMotion& rig) : rig_(rig) {
  if (rig.count < 1) throw InvalidArgument("", "has no frames");
  if (const std::string missing = MissingBones(rig.bones); !missing.empty())
    throw InvalidArgument("bones", "none of them is the " + missing);
  const int64_t step = std::max<int64_t>(1, rig.count / kSamples);
  for (int64_t frame = 0; frame < rig.count; frame += step) samples_.push_back(rig.frame(frame));
  for (const RigPlacement& sample : samples_) {
    const bool finite =
        sample.places.allFinite() &&
        std::ranges::all_of(sample.turns, [](const auto& t) { return t.allFinite(); });
    if (!finite) throw InvalidArgument("bones", "stand or turn in ways that are not finite");
  }
}

Eigen::Vector3d RigReading::Bone(const RigPlacement& placement, const LimbSegment& segment) const {
  return placement.places.col(Find(segment.to)) - placement.places.col(Find(segment.from));
}

double RigReading::Scale() const {
  double ours = 0, theirs = 0;
  for (const LimbSegment& segment : LimbSegments()) {
    if (!segment.to.ends_with("knee") && !segment.to.ends_with("ankle")) continue;
    std::vector<double> lengths;
    for (const RigPlacement& sample : samples_) lengths.push_back(Bone(sample, segment).norm());
    theirs += Median(std::move(lengths));
    ours += OurBody().offsets.col(OurBody().Find(segment.to)).norm();
  }
  if (!(theirs > 1e-9) || !std::isfinite(ours / theirs))
    throw InvalidArgument("bones", "its legs have no length: are all in one place");
  return ours / theirs;
}

std::vector<std::string> RigReading::Missing() const {
  std::vector<std::string> missing;
  if (Find("neck") < 0) missing.emplace_back("neck");
  if (Find("head") < 0) missing.emplace_back("head");
  if (Find("left_collar") < 0 || Find("right_collar") < 0) missing.emplace_back("collars");
  if (Find("left_foot") < 0 || Find("right_foot") < 0) missing.emplace_back("toes");
  if (rig_.bones.Spine().empty()) missing.emplace_back("spine");
  return missing;
}

// Direction of a bone in its own frame.
Eigen::Vector3d RigReading::Inside(const RigPlacement& placement,
                                   const LimbSegment& segment) const {
  const Eigen::Vector3d bone = Bone(placement, segment);
  return (placement.turns[Find(segment.from)].transpose() * bone).normalized();
}

// Whether, in most frames, nearly all limbs point in the direction `expected`, seen in their own
// frames.
bool RigReading::Point(const std::function<Eigen::Vector3d(const LimbSegment&)>& expected,
                       double share) const {
  int loose = 0;
  for (const LimbSegment& segment : LimbSegments()) {
    const Eigen::Vector3d there = expected(segment);
    std::vector<double> angles;
    for (const RigPlacement& sample : samples_)
      angles.push_back(AngleBetween(Inside(sample, segment), there));
    loose += Quantile(std::move(angles), share) > kLooseBone ? 1 : 0;
  }
  return loose <= kMaxLoose;
}

bool RigReading::TurnsCarry() const {
  return Point(
      [&](const LimbSegment& segment) {
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        for (const RigPlacement& sample : samples_) mean += Inside(sample, segment);
        return mean;
      },
      kRuleShare);
}

// Whether the rest pose belongs to the bones that move.
bool RigReading::Agrees(const RigPlacement& rest) const {
  return Point([&](const LimbSegment& segment) { return Inside(rest, segment); }, 0.5);
}

// Whether arms and legs are straight and the arms held out.
bool RigReading::IsHeldOut(const RigPlacement& placement) const {
  for (const std::string side : {"left_", "right_"}) {
    for (const auto& [upper, middle, end] :
         {std::tuple("hip", "knee", "ankle"), std::tuple("shoulder", "elbow", "wrist")}) {
      if (AngleBetween(Bone(placement, {side + upper, side + middle}),
                       Bone(placement, {side + middle, side + end})) > kLooseBone)
        return false;
    }
  }
  return AngleBetween(Bone(placement, {"left_shoulder", "left_elbow"}),
                      Bone(placement, {"right_elbow", "right_shoulder"})) < 2 * kLooseBone;
}

// The file's axis along which a rest pose stands.
std::optional<Eigen::Vector3d> RigReading::Up() const {
  for (size_t i = rig_.rests_apart; i < rig_.rests.size(); ++i) {
    if (!Agrees(rig_.rests[i])) continue;
    if (const auto body = RestBody(rig_.bones, rig_.rests[i].places))
      return NearestAxis(body->turns[0].row(1).transpose());
  }
  return std::nullopt;
}

bool RigReading::Stands() const {
  return std::ranges::any_of(rig_.rests, [&](const RigPlacement& rest) {
    return Agrees(rest) && RestBody(rig_.bones, rest.places).has_value();
  });
}

std::optional<RigReading::Rest> RigReading::FindRest() const {
  for (const RigPlacement& rest : rig_.rests) {
    if (!Agrees(rest)) continue;
    if (auto body = RestBody(rig_.bones, rest.places)) return Rest{*std::move(body), &rest};
  }
  if (!IsHeldOut(samples_[0])) return std::nullopt;
  // Some clips begin with other rigs' rest pose.
  auto body = RestBody(rig_.bones, samples_[0].places);
  if (!body) return std::nullopt;
  return Rest{*std::move(body), &samples_[0]};
}

}  // namespace choreo
