#include "model/engine/packed_planner.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/engine/time_embedding.h"
#include "model/motion/mirror.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

// As model/flow/planner.cpp has them; the parity test holds both together.
constexpr double kRampFrames = 6;
constexpr float kLeastAlong = 0.25F, kAlongSoftness = 0.1F;
constexpr float kFreeTurn = 0.25F, kRootTurn = 0.15F;
constexpr double kTurnHorizon = 12;
constexpr double kResidualSigma = 2;
constexpr int kResidualReach = 12;  // frames, where a Gaussian is 1e-8 of its peak

using Row = Eigen::Map<Eigen::RowVectorXf>;

// A mirror's image of a rotation's first two columns: M R M with M = diag(-1, 1, 1).
const Eigen::Matrix<float, 1, 6>& MirrorSigns() {
  static const Eigen::Matrix<float, 1, 6> signs{1, -1, -1, -1, 1, 1};
  return signs;
}

Eigen::Vector3f Unit(const Eigen::Vector3f& v) { return v / std::sqrt(v.squaredNorm() + 1e-12F); }

// The nearest rotation's first two columns, in place.
template <typename SixD>
void Straighten(SixD&& columns) {
  const Eigen::Vector3f b = columns.template tail<3>();
  const Eigen::Vector3f x = Unit(columns.template head<3>());
  columns.template head<3>() = x;
  columns.template tail<3>() = Unit(b - x.dot(b) * x);
}

Eigen::Quaterniond QuaternionOf(const Eigen::Matrix<float, 1, 6>& columns) {
  Eigen::Matrix3f r;
  r.col(0) = columns.head<3>();
  r.col(1) = columns.tail<3>();
  r.col(2) = r.col(0).cross(r.col(1));
  return Eigen::Quaterniond(r.cast<double>());
}

// Of two turns that end alike the one that the dancer's own turning leads to.
Eigen::Vector3d WayRound(const Eigen::Vector3d& turn, const TransitionSpec& spec) {
  const size_t history = spec.history.size();
  if (history < 3) return turn;
  const Eigen::Vector3d rate = 0.5 * RotationDifference(spec.history[history - 3].rotations.col(0),
                                                        spec.history[history - 1].rotations.col(0));
  const Eigen::Vector3d expected = std::min<double>(kTurnHorizon, spec.frames) * rate;
  const double angle = std::sqrt(turn.squaredNorm() + 1e-12);
  const Eigen::Vector3d other = turn * (1 - 2 * std::numbers::pi / angle);
  return (other - expected).squaredNorm() < (turn - expected).squaredNorm() ? other : turn;
}

}  // namespace

// Kept by each thread for its memory.
struct PackedPlanner::Scratch {
  PackedTransformer::Scratch network;
  PackedVariety::Scratch variety;
  RowBuffer smooth;     // [frames, pose width]
  RowBuffer rotations;  // [sides * frames, 6 joints]: 6D
  RowBuffer along;      // [sides * frames, 2 joints]
  RowBuffer positions;  // [sides * frames, 3]
  RowBuffer key, fixed, condition;
};

PackedPlanner::PackedPlanner(const Safetensors& content, const FlowConfig& config,
                             const Skeleton& skeleton, const PackedKernels& kernels,
                             const PackedKernels& products)
    : config_(config),
      joints_(skeleton.joints()),
      pairs_(MirrorPairs(skeleton)),
      kernels_(kernels) {
  const PackedTensors tensors(content);
  feature_width_ = static_cast<int>(content.tensors.at("feature_mean").data.size());
  const int key = 3 + 6 * joints_ + joints_ + 1, hidden = config.planner.width;
  if (hidden > 0) transformer_.emplace(tensors, joints_, config, kernels, products);
  if (hidden > 0 && config.planner.variety > 0)
    variety_.emplace(tensors, joints_, config.planner.variety);
  counts_ = TimeEmbeddings(0, config.max_transition_frames, feature_width_);
  if (!config.time_embedding) counts_.setZero();
  if (config.condition_width == 0) return;
  const RowMajorMatrix weight =
      tensors.Get("encode_static.weight", config.condition_width, key + feature_width_ + hidden)
          .transpose();
  encode_key_ = {kernels, weight.topRows(key),
                 tensors.Get("encode_static.bias", config.condition_width)};
  encode_hidden_ = {kernels, weight.bottomRows(hidden),
                    Eigen::VectorXf::Zero(config.condition_width)};
  counts_ = (counts_ * weight.middleRows(key, feature_width_)).eval();
}

TransitionPlan PackedPlanner::Plan(const TransitionSpec& spec) const {
  thread_local Scratch scratch;
  TransitionPlan plan;
  const int pose = 3 + 6 * joints_;
  // What the key asks for, and the key.
  scratch.network.masks.Resize(PackedTransformer::kSides, joints_ + 1);
  Row mask = scratch.network.masks.Part(0, 0, joints_ + 1);
  mask.setZero();
  scratch.key.Resize(1, pose + joints_ + 1);
  Row key = scratch.key.Part(0, 0, pose + joints_ + 1);
  key.setZero();
  if (spec.target) {
    const PoseMask& asked = spec.target->mask;
    for (int joint = 0; joint < joints_; ++joint) {
      if (!asked.joints.empty() && !asked.joints[static_cast<size_t>(joint)]) continue;
      mask[joint] = 1;
      key.segment<6>(3 + 6 * joint) =
          SixDFromMatrix(ExpMap(spec.target->pose.rotations.col(joint))).cast<float>().transpose();
    }
    mask[joints_] = asked.root_position ? 1.0F : 0.0F;
    key.head<3>() = mask[joints_] * spec.target->pose.root_position.cast<float>().transpose();
    key.tail(joints_ + 1) = mask;
  }
  if (transformer_) {
    Interpolate(spec, &scratch);
    Mirror(config_.history_frames + spec.frames, &scratch);
    transformer_->Run(spec.frames, &scratch.network);
    Bend(spec.frames, &scratch);
    WritePoses(spec, &scratch, &plan.poses);
  }
  WriteCondition(spec, &scratch, &plan.static_condition);
  return plan;
}

// Writes the first side's poses: history, then the line from its last pose to the key. What the key
// does not name stays as it is.
void PackedPlanner::Interpolate(const TransitionSpec& spec, Scratch* s) const {
  const auto history = static_cast<int>(spec.history.size());
  RowBuffer& poses = s->network.poses;
  const Row mask = s->network.masks.Part(0, 0, joints_ + 1);
  poses.Resize(static_cast<long>(PackedTransformer::kSides) * (history + spec.frames),
               3 + 6 * joints_);
  const Pose& last = spec.history.back();
  const Pose& goal = spec.target ? spec.target->pose : last;
  for (int t = 0; t < history; ++t) {
    const Pose& pose = spec.history[static_cast<size_t>(t)];
    poses.Part<3>(t, 0) = pose.root_position.cast<float>();
    for (int joint = 0; joint < joints_; ++joint) {
      poses.Part<6>(t, 3 + 6 * joint) =
          SixDFromMatrix(ExpMap(pose.rotations.col(joint))).cast<float>();
    }
  }
  const Eigen::Vector3d move =
      static_cast<double>(mask[joints_]) * (goal.root_position - last.root_position);
  for (int t = 0; t < spec.frames; ++t) {
    const double u = (t + 1.0) / spec.frames;
    poses.Part<3>(history + t, 0) = (last.root_position + u * move).cast<float>();
  }
  for (int joint = 0; joint < joints_; ++joint) {
    Eigen::Vector3d turn = RotationDifference(last.rotations.col(joint), goal.rotations.col(joint));
    if (joint == 0) turn = WayRound(turn, spec);
    turn *= mask[joint];
    // from exp(u turn) = from + sin(u angle) from K + (1 - cos(u angle)) from K^2, K the axis.
    const double angle = turn.norm();
    const Eigen::Vector3d axis = turn / std::max(angle, 1e-12);
    const Eigen::Matrix3d from = ExpMap(last.rotations.col(joint));
    Eigen::Matrix<double, 3, 2> first, second;  // from K, from K^2
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector3d once = axis.cross(Eigen::Vector3d::Unit(i));
      first.col(i) = from * once;
      second.col(i) = from * axis.cross(once);
    }
    const double step_sine = std::sin(angle / spec.frames),
                 step_cosine = std::cos(angle / spec.frames);
    double sine = 0, cosine = 1;
    for (int t = 0; t < spec.frames; ++t) {
      const double next = sine * step_cosine + cosine * step_sine;
      cosine = cosine * step_cosine - sine * step_sine;
      sine = next;
      auto columns = poses.Part<6>(history + t, 3 + 6 * joint);
      for (int i = 0; i < 2; ++i) {
        columns.segment<3>(3 * i) =
            (from.col(i) + sine * first.col(i) + (1 - cosine) * second.col(i)).cast<float>();
      }
    }
  }
}

// Writes the second side from the first.
void PackedPlanner::Mirror(int rows, Scratch* s) const {
  RowBuffer& masks = s->network.masks;
  for (int joint = 0; joint < joints_; ++joint)
    masks.Row(1)[joint] = masks.Row(0)[pairs_[static_cast<size_t>(joint)]];
  masks.Row(1)[joints_] = masks.Row(0)[joints_];
  RowBuffer& poses = s->network.poses;
  for (int row = 0; row < rows; ++row) {
    auto position = poses.Part<3>(rows + row, 0);
    position = poses.Part<3>(row, 0);
    position[0] = -position[0];
    for (int joint = 0; joint < joints_; ++joint) {
      const int other = pairs_[static_cast<size_t>(joint)];
      poses.Part<6>(rows + row, 3 + 6 * joint) =
          poses.Part<6>(row, 3 + 6 * other).cwiseProduct(MirrorSigns());
    }
  }
}

// Bends each side's line by what the network adds, and joins the two in the first side's rotations
// and positions.
void PackedPlanner::Bend(int frames, Scratch* s) const {
  constexpr int kSides = PackedTransformer::kSides;
  const int pose = 3 + 6 * joints_, history = config_.history_frames;
  s->smooth.Resize(frames, pose);
  s->rotations.Resize(static_cast<long>(kSides) * frames, 6 * joints_);
  s->along.Resize(static_cast<long>(kSides) * frames, 2 * joints_);
  s->positions.Resize(static_cast<long>(kSides) * frames, 3);
  float weights[kResidualReach + 1];
  for (int i = 0; i <= kResidualReach; ++i)
    weights[i] = static_cast<float>(std::exp(-0.5 * std::pow(i / kResidualSigma, 2)));

  const auto line = [&](int side, int frame, int first) {
    return s->network.poses.Part<3>(side * (history + frames) + history + frame, first);
  };
  for (int side = 0; side < kSides; ++side) {
    const Row mask = s->network.masks.Part(side, 0, joints_ + 1);
    for (int frame = 0; frame < frames; ++frame) {
      const int row = side * frames + frame;
      auto residual = s->smooth.Part(frame, 0, pose);
      residual.setZero();
      float sum = 0;
      const int from = std::max(0, frame - kResidualReach);
      const int to = std::min(frames - 1, frame + kResidualReach);
      for (int other = from; other <= to; ++other) {
        const float weight = weights[std::abs(other - frame)];
        residual += weight * s->network.residual.Part(side * frames + other, 0, pose);
        sum += weight;
      }
      residual = residual.cwiseProduct(transformer_->pose_std.transpose()) / sum;

      // It grows from zero behind the history and, for what the key fixes, shrinks to zero at it.
      const auto from_start = static_cast<float>(std::min((frame + 1) / kRampFrames, 1.0));
      const auto to_key = static_cast<float>(std::min((frames - 1 - frame) / kRampFrames, 1.0));
      const auto ramp = [&](int what) {
        return from_start * (1 - mask[what] + mask[what] * to_key);
      };
      s->positions.Part<3>(row, 0) = line(side, frame, 0) + ramp(joints_) * residual.head<3>();
      float* along = s->along.Row(row);
      for (int joint = 0; joint < joints_; ++joint) {
        const float share = ramp(joint);
        for (int i = 0; i < 2; ++i, ++along) {
          const int at = 6 * joint + 3 * i;
          const Eigen::Vector3f column = line(side, frame, 3 + at);
          Eigen::Vector3f turn = share * residual.segment<3>(3 + at);
          if (joint == 0) {
            const float size = std::sqrt(turn.squaredNorm() + 1e-12F);
            if (size >= kFreeTurn) {
              const float bounded =
                  kFreeTurn + kRootTurn * std::tanh((size - kFreeTurn) / kRootTurn);
              turn *= bounded / size;
            }
          }
          turn += column;
          s->rotations.Part<3>(row, at) = turn;
          *along = (column.dot(turn) - kLeastAlong) / kAlongSoftness;
        }
      }
    }
  }
  // A column's share along the line's own stays positive, softly: docs/decisions.md, 20.
  s->condition.Resize(1, static_cast<long>(kSides) * frames * 2 * joints_);
  const long count = s->condition.stride();
  std::copy_n(s->along.Row(0), count, s->condition.Row(0));
  kernels_.softplus(s->condition.Row(0), count);
  const float *bounded = s->condition.Row(0), *along = s->along.Row(0);
  for (int side = 0; side < kSides; ++side) {
    for (int frame = 0; frame < frames; ++frame) {
      for (int joint = 0; joint < joints_; ++joint) {
        auto columns = s->rotations.Part<6>(side * frames + frame, 6 * joint);
        for (int i = 0; i < 2; ++i, ++bounded, ++along) {
          columns.segment<3>(3 * i) +=
              kAlongSoftness * (*bounded - *along) * line(side, frame, 3 + 6 * joint + 3 * i);
        }
        Straighten(columns);
      }
    }
  }
  for (int frame = 0; frame < frames; ++frame) {
    const auto other = s->positions.Part<3>(frames + frame, 0);
    auto position = s->positions.Part<3>(frame, 0);
    position = 0.5F * (position + Eigen::RowVector3f(-other[0], other[1], other[2]));
    for (int joint = 0; joint < joints_; ++joint) {
      auto columns = s->rotations.Part<6>(frame, 6 * joint);
      const int pair = pairs_[static_cast<size_t>(joint)];
      columns += s->rotations.Part<6>(frames + frame, 6 * pair).cwiseProduct(MirrorSigns());
      Straighten(columns);
    }
  }
}

void PackedPlanner::WritePoses(const TransitionSpec& spec, Scratch* s,
                               std::vector<Pose>* poses) const {
  const bool varies = variety_ && variety_->Sample(spec, feature_width_, &s->variety);
  poses->resize(static_cast<size_t>(spec.frames));
  const Pose* before = &spec.history.back();
  for (int frame = 0; frame < spec.frames; ++frame) {
    Pose& pose = (*poses)[static_cast<size_t>(frame)];
    pose.root_position = s->positions.Part<3>(frame, 0).cast<double>();
    pose.rotations.resize(3, joints_);
    const RowBuffer& difference = s->variety.difference;
    if (varies) pose.root_position += difference.Part<3>(frame, 0).cast<double>();
    for (int joint = 0; joint < joints_; ++joint) {
      Eigen::Quaterniond rotation = QuaternionOf(s->rotations.Part<6>(frame, 6 * joint));
      if (varies) {
        const Eigen::Vector3d turn = difference.Part<3>(frame, 3 + 3 * joint).cast<double>();
        rotation = rotation * QuaternionFromExp(turn);
      }
      pose.rotations.col(joint) =
          NearestBranch(ExpFromQuaternion(rotation), before->rotations.col(joint));
    }
    before = &pose;
  }
}

// Key, frames left, and what the planner knows of each frame.
void PackedPlanner::WriteCondition(const TransitionSpec& spec, Scratch* s,
                                   std::vector<float>* condition) const {
  const long key_width = s->key.stride();
  if (!config_.keys) s->key.Part(0, 0, key_width).setZero();
  const Row key = s->key.Part(0, 0, key_width);
  const float present = key.tail(joints_ + 1).maxCoeff();
  const auto counted = [&](int frame) {
    return present * counts_.row(config_.forward_embedding ? frame : spec.frames - 1 - frame);
  };
  const long hidden = config_.planner.width;
  if (config_.condition_width == 0) {
    const long width = key_width + feature_width_ + hidden;
    condition->resize(static_cast<size_t>(spec.frames * width));
    for (int frame = 0; frame < spec.frames; ++frame) {
      Row row(condition->data() + frame * width, width);
      row.head(key_width) = key;
      row.segment(key_width, feature_width_) = counted(frame);
      if (hidden > 0) row.tail(hidden) = s->network.hidden.Part(frame, 0, hidden);
    }
    return;
  }
  const long width = config_.condition_width;
  s->fixed.Resize(1, encode_key_.padded());
  encode_key_.Run(key.data(), key_width, s->fixed.Row(0), s->fixed.stride(), 1);
  s->condition.Resize(spec.frames, encode_key_.padded());
  for (int frame = 0; frame < spec.frames; ++frame)
    s->condition.Part(frame, 0, width) = s->fixed.Part(0, 0, width) + counted(frame);
  if (hidden > 0) {
    encode_hidden_.Add(s->network.hidden.Row(0), s->network.hidden.stride(), s->condition.Row(0),
                       s->condition.stride(), spec.frames);
  }
  condition->resize(static_cast<size_t>(spec.frames * width));
  for (int frame = 0; frame < spec.frames; ++frame)
    std::copy_n(s->condition.Row(frame), width, condition->data() + frame * width);
}

}  // namespace choreo
