#include "model/engine/packed_planner.h"

#include <algorithm>

#include "model/engine/time_embedding.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

using Row = Eigen::Map<Eigen::RowVectorXf>;

Eigen::Quaterniond QuaternionOf(const Eigen::Matrix<float, 1, 6>& columns) {
  Eigen::Matrix3f r;
  r.col(0) = columns.head<3>();
  r.col(1) = columns.tail<3>();
  r.col(2) = r.col(0).cross(r.col(1));
  return Eigen::Quaterniond(r.cast<double>());
}

}  // namespace

// Kept by each thread for its memory.
struct PackedPlanner::Scratch {
  PackedTransformer::Scratch network;
  PackedVariety::Scratch variety;
  PlanBender::Scratch bent;
  RowBuffer key, fixed, condition;
};

PackedPlanner::PackedPlanner(const Safetensors& content, const FlowConfig& config,
                             const Skeleton& skeleton, const PackedKernels& kernels,
                             const PackedKernels& products)
    : config_(config),
      joints_(skeleton.joints()),
      bender_(skeleton, config.history_frames, config.planner.root_turn, kernels) {
  const PackedTensors tensors(content);
  feature_width_ = static_cast<int>(content.tensors.at("feature_mean").data.size());
  const int key = 3 + 6 * joints_ + joints_ + 1, hidden = config.planner.width;
  if (hidden > 0) transformer_.emplace(tensors, joints_, config, kernels, products);
  if (hidden > 0 && config.planner.variety > 0)
    variety_.emplace(tensors, skeleton, config.planner.variety);
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

TransitionPlan PackedPlanner::PlanTurning(const TransitionSpec& spec,
                                          const Eigen::Vector3d& turn) const {
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
      if (!asked.Asks(joint)) continue;
      mask[joint] = 1;
      key.segment<6>(3 + 6 * joint) =
          SixDFromMatrix(ExpMap(spec.target->pose.rotations.col(joint))).cast<float>().transpose();
    }
    mask[joints_] = asked.root_position ? 1.0F : 0.0F;
    key.head<3>() = mask[joints_] * spec.target->pose.root_position.cast<float>().transpose();
    key.tail(joints_ + 1) = mask;
  }
  if (transformer_) {
    bender_.Interpolate(spec, turn, &scratch.network);
    transformer_->Run(spec.frames, &scratch.network);
    bender_.Bend(spec.frames, scratch.network, transformer_->pose_std, &scratch.bent);
    WritePoses(spec, &scratch, &plan.poses);
  }
  WriteCondition(spec, &scratch, &plan.static_condition);
  return plan;
}

void PackedPlanner::WritePoses(const TransitionSpec& spec, Scratch* s,
                               std::vector<Pose>* poses) const {
  const bool varies = variety_ && variety_->Sample(spec, feature_width_, &s->variety);
  poses->resize(static_cast<size_t>(spec.frames));
  const Pose* before = &spec.history.back();
  for (int frame = 0; frame < spec.frames; ++frame) {
    Pose& pose = (*poses)[static_cast<size_t>(frame)];
    pose.root_position = s->bent.positions.Part<3>(frame, 0).cast<double>();
    pose.rotations.resize(3, joints_);
    const RowBuffer& difference = s->variety.difference;
    if (varies) pose.root_position += difference.Part<3>(frame, 0).cast<double>();
    for (int joint = 0; joint < joints_; ++joint) {
      Eigen::Quaterniond rotation = QuaternionOf(s->bent.rotations.Part<6>(frame, 6 * joint));
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
