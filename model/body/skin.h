#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "model/body/colour.h"
#include "model/body/doll.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// A mesh of one colour. Each vertex is bound to one joint.
struct SkinPatch {
  Colour colour;
  std::vector<Eigen::Vector3f> positions;          ///< in the rest pose on the floor, metres
  std::vector<Eigen::Vector3f> normals;            ///< unit length
  std::vector<uint16_t> joints;                    ///< [vertices]
  std::vector<std::array<uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
};

/// Makes the doll's skin for linear blend skinning: tapered capsules, one patch per colour, in the
/// doll's order. A capsule's end on a joint moves with the bone above the joint, so that limbs keep
/// their shape however far they bend. An end beside a joint moves with the joint. Deterministic.
std::vector<SkinPatch> MakeSkin(const Skeleton& skeleton);

}  // namespace choreo
