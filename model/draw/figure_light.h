#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/body/cone_lanes.h"
#include "model/body/doll.h"

namespace choreo {

/// Light on a figure's parts.
class FigureLight {
 public:
  /// Keeps `figure` and `parts`, which are the same shapes. `lamp`: unit, towards it.
  FigureLight(const std::vector<PlacedPart>& figure, const std::vector<BoundedCone>& parts,
              const Eigen::Vector3f& lamp);

  /// Linear colour of a point of the surface of part `index` where a ray of unit direction `ray`
  /// meets it. `normal`: the part's own there.
  Eigen::Vector3f At(size_t index, const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
                     const Eigen::Vector3f& ray) const;

 private:
  struct Part {
    Eigen::Vector3f colour;               // linear
    std::vector<const PlacedPart*> skin;  // what it may be one piece with
    std::vector<ConeLanes> shading;       // what may stand between it and the lamp
    std::vector<ConeLanes> hiding;        // or the sky
  };

  Eigen::Vector3f lamp_;
  std::vector<Part> parts_;
};

}  // namespace choreo
