#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "model/formats/gltf_nodes.h"

namespace choreo {

/// The nodes of a glTF file and how its first animation moves them. Immutable. Private to this
/// folder.
class GltfScene {
 public:
  /// Throws Error(kInvalidArgument) naming the part, for what gltf.h says.
  explicit GltfScene(const tinygltf::Model& model);

  double fps() const { return fps_; }
  int64_t frames() const { return frames_; }
  const GltfNodes& nodes() const { return nodes_; }

  /// Where all nodes are in the world.
  std::vector<Eigen::Affine3d> Frame(int64_t frame) const;

 private:
  struct Channel {
    enum class Path { kTranslation, kRotation, kScale };
    size_t node;
    Path path;
    bool step;
    Eigen::RowVectorXd times;  // [keys] ascending, seconds
    Eigen::MatrixXd values;    // [3 or 4, keys]

    // Sets what it drives to its value at `time`; before the first and after the last key it holds.
    void Drive(double time, GltfPlacement& placement) const;
  };

  void AddChannel(const tinygltf::Model& model, const tinygltf::AnimationChannel& channel);
  void ChooseTimes(const tinygltf::Animation& animation);

  GltfNodes nodes_;
  std::vector<Channel> channels_;
  double fps_ = 0;
  double start_ = 0;
  int64_t frames_ = 0;
};

}  // namespace choreo
