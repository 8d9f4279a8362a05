#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "model/fit/sources/sources.h"

namespace choreo {

/// Builds a SourceMapping landmark by landmark, parents first.
class MappingBuilder {
 public:
  MappingBuilder(std::string name, double accuracy_m) {
    mapping_.name = std::move(name);
    mapping_.accuracy_m = accuracy_m;
  }

  /// `parent`: a landmark's name, or "" for the first one.
  void Add(const std::string& name, const std::string& parent, JointBlend source,
           std::vector<OurPoint> ours, double weight = 1, bool rigid = true) {
    const auto above = std::ranges::find(mapping_.landmarks, parent, &Landmark::name);
    const auto index = static_cast<int>(above - mapping_.landmarks.begin());
    mapping_.landmarks.push_back({.name = name,
                                  .source = std::move(source),
                                  .ours = std::move(ours),
                                  .parent = parent.empty() ? -1 : index,
                                  .rigid = rigid,
                                  .weight = weight});
  }

  /// Adds a joint that both skeletons have.
  void AddJoint(const std::string& ours, const std::string& parent, const std::string& source,
                double weight = 1) {
    Add(ours, parent, {{source, 1.0}}, {{.joint = ours}}, weight);
  }

  /// Adds both hips and, as the root landmark, their middle.
  void AddHips(const std::string& left, const std::string& right) {
    Add("hips", "", {{left, 0.5}, {right, 0.5}}, Between("left_hip", "right_hip"));
    AddJoint("left_hip", "hips", left);
    AddJoint("right_hip", "hips", right);
  }

  void AddFoot(const std::string& source_joint) { mapping_.feet.push_back(source_joint); }

  SourceMapping Take() { return std::move(mapping_); }

  /// A point at an offset from one of our joints.
  static OurPoint At(const std::string& joint, double x, double y, double z) {
    return {.joint = joint, .offset = {x, y, z}};
  }
  /// The midpoint of two of our joints.
  static std::vector<OurPoint> Between(const std::string& a, const std::string& b) {
    return {{.joint = a, .weight = 0.5}, {.joint = b, .weight = 0.5}};
  }

 private:
  SourceMapping mapping_;
};

}  // namespace choreo
