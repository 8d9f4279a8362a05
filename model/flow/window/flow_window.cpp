#include "model/flow/window/flow_window.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "model/core/running/each_cpu.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

// How far, in radians, a coordinate may be from the mean. With a key: less than half a turn, beyond
// which the other way round is nearer. Without one: less than a whole turn, where rotation vectors
// are singular.
constexpr double kKeyedReach = 2.8, kFreeReach = 5.5;
// The most, in radians, that a dancer turns in a window without a key. Facing the audience may add
// as much, and networks have seen few turns beyond a whole one.
constexpr double kMaxFreeTurn = std::numbers::pi;
// The time, in frames, for which the history's turn continues.
constexpr double kTurnHorizon = 12;

// The displacement from one pose to another, [dimensions]: of the root, and of each joint in the
// first one's tangent space.
Eigen::VectorXd Displacement(const Pose& from, const Pose& to) {
  Eigen::VectorXd way(3 + 3 * from.rotations.cols());
  way.head<3>() = to.root_position - from.root_position;
  for (Eigen::Index j = 0; j < from.rotations.cols(); ++j)
    way.segment<3>(3 + 3 * j) = RotationDifference(from.rotations.col(j), to.rotations.col(j));
  return way;
}

// The velocities of the history's last steps, [dimensions, kPast], latest first, at most kMaxSpeed.
Eigen::MatrixXd LastVelocities(const MotionPrior& prior, const Eigen::MatrixXd& history) {
  Eigen::MatrixXd velocity = Eigen::MatrixXd::Zero(history.rows(), MotionPrior::kPast);
  const Eigen::Index tau = history.cols();
  for (int p = 0; p < MotionPrior::kPast && p + 1 < tau; ++p)
    velocity.col(p) = history.col(tau - 1 - p) - history.col(tau - 2 - p);
  const Eigen::ArrayXd fastest = MotionPrior::kMaxSpeed * prior.VelocitySpread().array();
  for (auto&& one : velocity.colwise()) one = one.array().min(fastest).max(-fastest);
  return velocity;
}

// The product of a lower triangle, whose columns follow each other with zeros above the diagonal,
// and `by`: each row is a sum over its columns in their order.
CHOREO_EACH_CPU void MultiplyTriangle(const float* triangle, const float* by, Eigen::Index size,
                                      float* out) {
  typedef float Rows __attribute__((vector_size(32), aligned(4), may_alias));
  constexpr Eigen::Index kRows = 8;
  constexpr int kSums = 4;  // at once, because a sum alone waits for each of its additions
  if (size < kRows) {
    for (Eigen::Index row = 0; row < size; ++row) {
      out[row] = 0;
      for (Eigen::Index i = 0; i <= row; ++i) out[row] += by[i] * triangle[i * size + row];
    }
    return;
  }
  for (Eigen::Index at = 0; at < size; at += kSums * kRows) {
    Eigen::Index rows[kSums];
    for (int sum = 0; sum < kSums; ++sum)
      rows[sum] = std::min(at + sum * kRows, size - kRows);  // the last may be computed twice
    Rows sums[kSums] = {};
    Eigen::Index i = 0;
#pragma GCC unroll 4
    for (int first = 0; first < kSums; ++first) {
      for (; i < rows[first] + kRows; ++i) {
#pragma GCC unroll 4
        for (int sum = first; sum < kSums; ++sum)
          sums[sum] += by[i] * *reinterpret_cast<const Rows*>(triangle + i * size + rows[sum]);
      }
    }
    for (int sum = 0; sum < kSums; ++sum)
      std::memcpy(out + rows[sum], &sums[sum], sizeof sums[sum]);
  }
}

}  // namespace

WindowRequest WindowRequest::Part(int from, int count, std::span<const Pose> poses,
                                  const GroundFrame& ground) const {
  WindowRequest part = *this;
  part.frames = count;
  part.history.clear();
  for (const Pose& pose : poses) part.history.push_back(ground.ToLocal(pose));
  if (target) part.target->pose = ground.ToLocal(target->pose);
  part.to_key = to_key - from;
  if (from > 0) {  // frames before this part already follow the request
    part.turn_to_key.reset();
    part.energy_shift.before = energy_shift.now;
  }
  part.controls = controls.Part(from, count);
  part.controls.ToLocal(ground);
  for (double& beat : part.beats) beat -= from;
  if (stage) part.stage = ground.ToLocal(*stage);
  return part;
}

WindowRequest Mirror(const std::vector<int>& pairs, const WindowRequest& request) {
  WindowRequest mirrored = request;
  for (Pose& pose : mirrored.history) pose = Mirror(pairs, pose);
  if (request.target) {
    mirrored.target->pose = Mirror(pairs, request.target->pose);
    const std::vector<bool>& fixed = request.target->mask.joints;
    for (size_t joint = 0; joint < fixed.size(); ++joint)
      mirrored.target->mask.joints[joint] = fixed[static_cast<size_t>(pairs[joint])];
  }
  // A mirrored rotation vector keeps the component across the mirror; a position flips only that.
  if (request.turn_to_key) mirrored.turn_to_key->tail<2>() *= -1;
  if (request.free_turn) *mirrored.free_turn *= -1;
  mirrored.controls.Mirror();
  if (request.stage) {
    mirrored.stage->origin.x() *= -1;
    mirrored.stage->heading *= -1;
  }
  return mirrored;
}

double FreeTurn(const MotionPrior& prior, const WindowRequest& request, double normal) {
  const std::vector<Pose>& poses = request.history;
  const size_t known = std::min<size_t>(poses.size(), MotionPrior::kPast + 1);
  Eigen::MatrixXd history(prior.dimensions(), known);
  for (size_t i = 0; i < known; ++i)
    history.col(static_cast<Eigen::Index>(i)) =
        Displacement(poses.back(), poses[poses.size() - known + i]);
  const MotionPrior::Bridge& free = (*prior.Bridges(request.frames, 0))[MotionPrior::kTurn];
  const int end = request.frames - 1;
  const Eigen::RowVectorXd turning =
      UpOf(poses.back()).transpose() * LastVelocities(prior, history).middleRows<3>(3);
  return std::clamp(free.past.row(end).dot(turning) + normal * free.spread.row(end).norm(),
                    -kMaxFreeTurn, kMaxFreeTurn);
}

Eigen::MatrixXd LevelCurves(const WindowRequest& request,
                            const std::array<double, kBodyParts>& medians) {
  const ControlCurve& energy = request.controls[kVelocityFactors];
  Eigen::MatrixXd levels = Eigen::MatrixXd::Constant(kBodyParts, request.frames, NAN);
  for (int part = 0; part < kBodyParts; ++part) {
    if (!energy.IsRequested(part)) continue;
    for (int i = 0; i < request.frames; ++i)
      levels(part, i) = EnergyLevel(energy.values(part, i), medians[static_cast<size_t>(part)]);
  }
  return levels;
}

std::array<std::optional<double>, kBodyParts> LevelsOf(
    const WindowRequest& request, const std::array<double, kBodyParts>& medians) {
  const ControlCurve& energy = request.controls[kVelocityFactors];
  std::array<std::optional<double>, kBodyParts> levels;
  for (int part = 0; part < kBodyParts; ++part) {
    const auto at = static_cast<size_t>(part);
    if (energy.IsRequested(part))
      levels[at] = EnergyLevel(energy.values.row(part).mean(), medians[at]);
  }
  return levels;
}

FlowWindow::FlowWindow(const MotionPrior& prior, const WindowRequest& request) {
  const Pose& last = request.history.back();
  const int dimensions = 3 + 3 * static_cast<int>(last.rotations.cols());
  const int tau = static_cast<int>(request.history.size());
  keyed_.assign(static_cast<size_t>(dimensions), false);
  displacement_ = Eigen::VectorXd::Zero(dimensions);
  history_ = Eigen::MatrixXd::Zero(dimensions, tau);
  for (int i = 0; i < tau; ++i)
    history_.col(i) = Displacement(last, request.history[static_cast<size_t>(i)]);
  const Eigen::MatrixXd velocities = LastVelocities(prior, history_);
  velocity_ = velocities.col(0);
  if (request.target) SetKey(prior, request);
  SetMean(prior, request, velocities);
  if (request.FrontCounts() && prior.usual().facing > 0) FaceAudience(prior, request, velocities);
  SetEnergy(prior, request);
  SetBase(last);
}

void FlowWindow::SetKey(const MotionPrior& prior, const WindowRequest& request) {
  const Target& key = *request.target;
  keyed_[0] = keyed_[2] = key.mask.root_position;
  keyed_[1] = key.mask.root_position || key.height;
  displacement_ = Displacement(request.history.back(), key.pose);
  const Eigen::Vector3d ahead =
      std::min<double>(kTurnHorizon, request.to_key) * velocity_.segment<3>(3);
  displacement_.segment<3>(3) =
      NearerWayRound(displacement_.segment<3>(3), request.turn_to_key.value_or(ahead));
  const auto dimensions = static_cast<int>(displacement_.size());
  for (int d = 3; d < dimensions; ++d)
    keyed_[static_cast<size_t>(d)] = key.mask.Constrains(d / 3 - 1);
  for (int d = 0; d < dimensions; ++d) {
    if (!keyed_[static_cast<size_t>(d)]) displacement_[d] = 0;
  }
  to_key_ = prior.Bridges(request.frames, request.to_key);
}

void FlowWindow::SetMean(const MotionPrior& prior, const WindowRequest& request,
                         const Eigen::MatrixXd& velocities) {
  const Pose& last = request.history.back();
  const auto dimensions = static_cast<int>(displacement_.size());
  const bool whole = std::ranges::find(keyed_, false) == keyed_.end();
  if (!whole) free_ = prior.Bridges(request.frames, 0);
  Eigen::VectorXd way = displacement_;  // to the key or to the usual pose
  if (const Pose& usual = prior.usual().pose;
      !whole && usual.rotations.cols() == last.rotations.cols()) {
    Pose home = usual;
    if (request.StageCounts()) {
      stage_ = prior.StageBridges(request.frames);
      home.root_position.x() += request.stage->origin.x();
      home.root_position.z() += request.stage->origin.z();
    }
    const Eigen::VectorXd back = Displacement(last, home);
    for (int d = 0; d < dimensions; ++d) {
      if (!keyed_[static_cast<size_t>(d)]) way[d] = back[d];
    }
  }

  mean_.resize(dimensions, request.frames);
  double squares = 0, known = 0;
  for (int d = 0; d < dimensions; ++d) {
    const MotionPrior::Bridge& bridge = BridgeOf(d);
    // A history generated by the dance does not predict its keys' energy well.
    const bool keyed = keyed_[static_cast<size_t>(d)];
    if (prior.Moves(d) && keyed) {
      squares += displacement_[d] * displacement_[d] / bridge.expected[MotionPrior::kPast];
      ++known;
    } else if (prior.Moves(d) && !request.target) {
      squares += velocities.row(d)
                     .transpose()
                     .cwiseAbs2()
                     .cwiseQuotient(bridge.expected.head<MotionPrior::kPast>())
                     .sum();
      known += MotionPrior::kPast;
    }
    mean_.row(d) = (bridge.past * velocities.row(d).transpose() + bridge.key * way[d]).transpose();
  }
  if (known > 0) surprise_ = squares / known;
}

// Turns about the vertical. A turn about the body's own axis would make a dancer who bends forwards
// bend backwards half a turn later.
void FlowWindow::FaceAudience(const MotionPrior& prior, const WindowRequest& request,
                              const Eigen::MatrixXd& velocities) {
  facing_ = prior.FacingBridge(request.frames);
  const Eigen::Vector3d up = UpOf(request.history.back());
  const double turn = request.free_turn ? *request.free_turn : FreeTurn(prior, request, 0);
  const Eigen::VectorXd turned = facing_->key * (turn + WrapAngle(request.stage->heading - turn)) +
                                 (facing_->past - (*free_)[MotionPrior::kTurn].past) *
                                     (velocities.middleRows<3>(3).transpose() * up);
  mean_.middleRows<3>(3) += up * turned.transpose();
}

void FlowWindow::SetBase(const Pose& last) {
  const auto joints = static_cast<int>(last.rotations.cols());
  base_.resize(static_cast<size_t>(frames()), last);
  base_turns_.resize(static_cast<size_t>(frames() * joints));
  for (int i = 0; i < frames(); ++i)
    base_[static_cast<size_t>(i)].root_position += mean_.col(i).head<3>();
  for (int j = 0; j < joints; ++j) {
    const Eigen::Quaterniond from = QuaternionFromExp(last.rotations.col(j));
    for (int i = 0; i < frames(); ++i) {
      Eigen::Quaterniond& turn = base_turns_[static_cast<size_t>(i * joints + j)];
      turn = from * QuaternionFromExp(mean_.col(i).segment<3>(3 + 3 * j));
      base_[static_cast<size_t>(i)].rotations.col(j) =
          NearestBranch(ExpFromQuaternion(turn), last.rotations.col(j));
    }
  }
}

Eigen::Quaterniond FlowWindow::RotationOf(const Eigen::MatrixXd& x, int frame, int joint) const {
  const auto at = static_cast<size_t>(frame * (x.rows() / 3 - 1) + joint);
  return base_turns_[at] * QuaternionFromExp(x.col(frame).segment<3>(3 + 3 * joint));
}

void FlowWindow::SetEnergy(const MotionPrior& prior, const WindowRequest& request) {
  scales_ = prior.Scales(surprise_, LevelCurves(request, prior.powers().medians));
}

std::optional<Eigen::MatrixXd> FlowWindow::Encode(std::span<const Pose> poses) const {
  Eigen::MatrixXd x(mean_.rows(), mean_.cols());
  for (int i = 0; i < frames(); ++i) {
    x.col(i) = Displacement(base_[static_cast<size_t>(i)], poses[static_cast<size_t>(i)]);
    for (Eigen::Index j = 0; 3 + 3 * j < x.rows(); ++j) {
      Eigen::Vector3d turn = x.col(i).segment<3>(3 + 3 * j);
      if (i > 0) turn = NearestBranch(turn, x.col(i - 1).segment<3>(3 + 3 * j));
      const bool keyed = keyed_[static_cast<size_t>(3 + 3 * j)];
      if (turn.norm() > (keyed ? kKeyedReach : kFreeReach)) return std::nullopt;
      x.col(i).segment<3>(3 + 3 * j) = turn;
    }
  }
  return x;
}

std::vector<Pose> FlowWindow::Decode(const Eigen::MatrixXd& x) const {
  std::vector<Pose> poses = base_;
  for (int i = 0; i < frames(); ++i) {
    Pose& pose = poses[static_cast<size_t>(i)];
    pose.root_position += x.col(i).head<3>();
    for (int j = 0; j < pose.rotations.cols(); ++j) {
      pose.rotations.col(j) =
          NearestBranch(ExpFromQuaternion(RotationOf(x, i, j)), pose.rotations.col(j));
    }
  }
  return poses;
}

Eigen::MatrixXf FlowWindow::PlaceJoints(const Skeleton& skeleton, const Eigen::MatrixXd& x) const {
  const int joints = skeleton.joints();
  Eigen::MatrixXf places(3 * joints, frames());
  Eigen::Matrix3Xd local(3, 3 * joints);
  JointPlacement placement;
  for (int i = 0; i < frames(); ++i) {
    for (int j = 0; j < joints; ++j)
      local.middleCols<3>(3 * j) = RotationOf(x, i, j).toRotationMatrix();
    const Eigen::Vector3d root = base_[static_cast<size_t>(i)].root_position + x.col(i).head<3>();
    ForwardKinematics(skeleton, root, local, placement);
    places.col(i) = placement.positions.reshaped().cast<float>();
  }
  return places;
}

Eigen::MatrixXd FlowWindow::Colour(const Eigen::MatrixXd& z) const {
  const Eigen::MatrixXf by_time = scales_.cwiseProduct(z).cast<float>().transpose();
  Eigen::MatrixXf x(z.cols(), z.rows());
  for (int d = 0; d < z.rows(); ++d)
    MultiplyTriangle(BridgeOf(d).spread.data(), by_time.col(d).data(), z.cols(), x.col(d).data());
  return x.transpose().cast<double>();
}

Eigen::VectorXd FlowWindow::Whiten(int dimension, const Eigen::VectorXd& x) const {
  const Eigen::MatrixXd spread = BridgeOf(dimension).spread.cast<double>();
  const Eigen::VectorXd white = spread.triangularView<Eigen::Lower>().solve(x);
  return white.cwiseQuotient(scales_.row(dimension).transpose());
}

}  // namespace choreo
