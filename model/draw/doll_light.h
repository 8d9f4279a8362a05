#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/body/cone_lanes.h"
#include "model/body/doll.h"

namespace choreo {

/// Computes the light on a doll's parts. Immutable; thread-safe.
class DollLight {
 public:
  /// Keeps references to `doll` and `parts`, which have the same shapes. `lamp`: unit vector
  /// towards the lamp.
  DollLight(const std::vector<PlacedPart>& doll, const std::vector<BoundedCone>& parts,
            const Eigen::Vector3f& lamp);

  /// The linear colour of part `index` at `point`, where a ray of unit direction `ray` hits it.
  /// `normal`: the part's own normal there.
  Eigen::Vector3f At(size_t index, const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
                     const Eigen::Vector3f& ray) const;

 private:
  struct Part {
    Eigen::Vector3f colour;               // linear
    std::vector<const PlacedPart*> skin;  // SkinAround
    std::vector<ConeLanes> shading;       // parts that may stand between it and the lamp
    std::vector<ConeLanes> hiding;        // parts that may hide the sky
  };

  Eigen::Vector3f lamp_;
  std::vector<Part> parts_;
};

}  // namespace choreo
