#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/body/cone_lanes.h"
#include "model/body/doll.h"

namespace choreo {

/// Light on a figure's parts.
class FigureLight {
 public:
  /// Keeps references to `figure` and `parts` (the same shapes). `lamp`: unit vector towards it.
  FigureLight(const std::vector<PlacedPart>& figure, const std::vector<BoundedCone>& parts,
              const Eigen::Vector3f& lamp);

  /// Linear colour at the point of part `index` that a ray of unit direction `ray` hits. `normal`:
  /// the part's own there.
  Eigen::Vector3f At(size_t index, const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
                     const Eigen::Vector3f& ray) const;

 private:
  struct Part {
    Eigen::Vector3f colour;               // linear
    std::vector<const PlacedPart*> skin;  // parts that may form one piece with it
    std::vector<ConeLanes> shading;       // parts that may stand between it and the lamp
    std::vector<ConeLanes> hiding;        // parts that may hide the sky
  };

  Eigen::Vector3f lamp_;
  std::vector<Part> parts_;
};

}  // namespace choreo
