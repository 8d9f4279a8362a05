#include "model/formats/arrays/joint_arrays.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "model/core/error.h"
#include "model/fit/solver/fit_clip.h"
#include "model/fit/sources/sources.h"
#include "model/formats/reading/motion_check.h"
#include "model/formats/reading/people.h"
#include "model/motion/skeleton.h"

namespace choreo {
namespace {

constexpr const char* kPlacesNames[] = {"joints",    "joints3d",      "joint_positions",
                                        "positions", "pred_position", "motion"};
constexpr int64_t kPlacedBody = 22;
// Relative tolerance of limb lengths, because networks stretch bones a little.
constexpr double kStretch = 0.1;
// Missing hands extend the forearms by this share of the forearm's length, with a small weight.
constexpr double kHand = 0.33, kHandWeight = 0.05;

const Skeleton& PlacedBody() { return Skeleton::Smpl24(); }

bool IsPlacedFrame(int64_t width) {
  return width == 3 * kPlacedBody || width == 3 * PlacedBody().joints();
}

/// The joints of all frames, [3, joints] each. Empty for other shapes.
std::vector<Eigen::Matrix3Xd> PlacesOfFrames(const NpyArray& array) {
  std::vector<int64_t> shape = array.shape;
  if (shape.size() == 4 && shape[0] == 1) shape.erase(shape.begin());
  std::vector<Eigen::Matrix3Xd> frames;
  if (shape.size() != 3 || shape[2] != 3 || !IsPlacedFrame(3 * shape[1])) return frames;
  const std::vector<double> values = array.As<double>();
  for (int64_t frame = 0; frame < shape[0]; ++frame)
    frames.emplace_back(
        Eigen::Map<const Eigen::Matrix3Xd>(values.data() + 3 * shape[1] * frame, 3, shape[1]));
  return frames;
}

// Reorders MDM's [people, joints, 3, frames].
NpyArray FramesFirst(const NpyArray& array) {
  const int64_t people = array.shape[0], width = 3 * array.shape[1], frames = array.shape[3];
  const std::vector<double> values = array.As<double>();
  std::vector<double> turned(values.size());
  for (int64_t person = 0; person < people; ++person) {
    const auto from = person * width * frames;
    Eigen::Map<Eigen::MatrixXd>(turned.data() + from, width, frames) =
        Eigen::Map<const Eigen::MatrixXd>(values.data() + from, frames, width).transpose();
  }
  return {{people, frames, array.shape[1], 3}, std::move(turned)};
}

bool KeepLengths(const std::vector<Eigen::Matrix3Xd>& frames) {
  const Skeleton& body = PlacedBody();
  for (const int joint : {body.left_knee, body.right_knee, body.feet[0], body.feet[2],
                          body.left_elbow, body.right_elbow}) {
    double sum = 0, squares = 0;
    for (const Eigen::Matrix3Xd& places : frames) {
      const double length = (places.col(joint) - places.col(body.parents[joint])).norm();
      sum += length;
      squares += length * length;
    }
    const double mean = sum / static_cast<double>(frames.size());
    const double variance = squares / static_cast<double>(frames.size()) - mean * mean;
    if (!(mean > 0) || !(variance < kStretch * kStretch * mean * mean)) return false;
  }
  return true;
}

// Whether toes point backwards in most frames, as if left and right were exchanged.
bool IsMirrored(const std::vector<Eigen::Matrix3Xd>& frames) {
  const Skeleton& body = PlacedBody();
  size_t backwards = 0;
  for (const Eigen::Matrix3Xd& at : frames) {
    const auto way = [&](int from, int to) -> Eigen::Vector3d { return at.col(to) - at.col(from); };
    const Eigen::Vector3d trunk = way(body.left_hip, body.left_shoulder) +
                                  way(body.right_hip, body.right_shoulder),
                          ahead = way(body.right_hip, body.left_hip).cross(trunk),
                          toes = way(body.feet[0], body.feet[1]) + way(body.feet[2], body.feet[3]);
    backwards += ahead.dot(toes) < 0 ? 1 : 0;
  }
  return 10 * backwards > 9 * frames.size();
}

void ExchangeSides(std::vector<Eigen::Matrix3Xd>* frames) {
  const Skeleton& body = PlacedBody();
  for (Eigen::Matrix3Xd& at : *frames) {
    for (int left = 0; left < at.cols(); ++left) {
      const std::string& name = body.joint_names[left];
      if (!name.starts_with("left_")) continue;
      const int right = body.Find("right_" + name.substr(5));
      at.col(left).swap(at.col(right));
    }
  }
}

}  // namespace

std::optional<NpyArray> FindJointArray(const NpzArchive& npz) {
  for (const char* name : kPlacesNames) {
    if (!npz.Has(name)) continue;
    NpyArray array = npz.Array(name);
    if (array.shape.size() == 4 && array.shape[2] == 3 && IsPlacedFrame(3 * array.shape[1]))
      array = FramesFirst(array);
    // Flat rows, like Bailando's.
    if (array.shape.size() > 1 && array.shape.back() > 3 && array.shape.back() % 3 == 0) {
      array.shape.back() /= 3;
      array.shape.push_back(3);
    }
    return array;
  }
  return std::nullopt;
}

bool AreJointPlaces(const NpyArray& array) {
  if (const int64_t people = PeopleIn(array, IsPlacedFrame); people > 1)
    return AreJointPlaces(PersonOf(array, people, 0));
  const std::vector<Eigen::Matrix3Xd> frames = PlacesOfFrames(array);
  // A single frame cannot show whether lengths are constant.
  return frames.size() > 1 && KeepLengths(frames);
}

Motion ReadJointPlaces(const NpyArray& array, double fps, const MotionReading& reading) {
  if (const int64_t people = PeopleIn(array, IsPlacedFrame); people > 1) {
    MotionReading inner = reading;
    inner.body.clear();
    const int64_t person = ChoosePerson(people, "joints", reading);
    return ReadJointPlaces(PersonOf(array, people, person), fps, inner);
  }
  reading.RefuseBody();
  std::vector<Eigen::Matrix3Xd> frames = PlacesOfFrames(array);
  if (frames.empty() || !AreJointPlaces(array)) {
    throw InvalidArgument("joints",
                          "are not places [frames, 22 or 24, 3] of SMPL's joints, whose limbs keep "
                          "their lengths, in several frames");
  }
  const Skeleton& body = PlacedBody();
  if (IsMirrored(frames)) {
    reading.Note(
        "its left and right are exchanged, as in a mirror: limbs are assigned by the direction of "
        "toes");
    ExchangeSides(&frames);
  }
  PositionClip clip{.fps = fps, .joint_names = body.joint_names, .frames = {}};
  for (const Eigen::Matrix3Xd& places : frames) {
    Eigen::Matrix3Xd& all = clip.frames.emplace_back(3, body.joints());
    all.leftCols(places.cols()) = places;
    for (Eigen::Index hand = places.cols(); hand < all.cols(); ++hand) {
      const int wrist = body.parents[static_cast<size_t>(hand)];
      const int elbow = body.parents[static_cast<size_t>(wrist)];
      all.col(hand) = all.col(wrist) + kHand * (all.col(wrist) - all.col(elbow));
    }
  }
  Motion motion = FitClip(clip, IdentitySource(body, kHandWeight), body, {.ground = false}).motion;
  reading.Note(
      "joints alone do not determine the rotations of head, hands and feet, which are guesses");
  return CorrectMotion({.skeleton = body, .motion = std::move(motion), .has_floor = false},
                       reading);
}

}  // namespace choreo
