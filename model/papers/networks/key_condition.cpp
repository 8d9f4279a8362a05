#include "model/papers/networks/key_condition.h"

#include "model/flow/window/time_embedding.h"
#include "model/motion/rotation.h"

namespace choreo {

int KeyConditionWidth(const FlowConfig& config, int joints, int feature_width) {
  return 3 + 3 * joints + joints + 1 + feature_width + (config.innovations ? 1 : 0);
}

Eigen::MatrixXf KeyConditions(const FlowConfig& config, int joints, int feature_width, int frames,
                              const Pose* key, const PoseMask& mask) {
  Eigen::MatrixXf conditions =
      Eigen::MatrixXf::Zero(KeyConditionWidth(config, joints, feature_width), frames);
  if (key == nullptr || !config.keys) return conditions;
  const int pose = 3 + 3 * joints;
  Eigen::VectorXf condition = Eigen::VectorXf::Zero(pose + joints + 1);
  for (int joint = 0; joint < joints; ++joint) {
    if (!mask.Constrains(joint)) continue;
    // Takes the branch of least angle, even if the pose is wound up.
    condition.segment<3>(3 + 3 * joint) = LogMap(ExpMap(key->rotations.col(joint))).cast<float>();
    condition[pose + joint] = 1;
  }
  if (mask.root_position) {
    condition.head<3>() = key->root_position.cast<float>();
    condition[pose + joints] = 1;
  }
  conditions.topRows(condition.size()).colwise() = condition;
  if (!config.time_embedding || condition.tail(joints + 1).isZero()) return conditions;
  const CountEmbedding embedding(static_cast<size_t>(feature_width));
  for (int frame = 0; frame < frames; ++frame) {
    const int count = config.forward_embedding ? frame : frames - 1 - frame;
    embedding.Fill(count, {conditions.col(frame).data() + condition.size(),
                           static_cast<size_t>(feature_width)});
    if (config.innovations && !config.forward_embedding)
      conditions(conditions.rows() - 1, frame) = static_cast<float>(frames - frame);
  }
  return conditions;
}

}  // namespace choreo
