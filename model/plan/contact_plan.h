#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "model/plan/footwork_options.h"

namespace choreo {

/// A standing foot: its toes stay at `place` in the frames [from, to].
struct Stance {
  int from = 0, to = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< metres; the height is the floor's
};

/// The stance at a frame, or null.
const Stance* StanceAt(const std::vector<Stance>& stances, int frame);

/// One foot of a plan. Metres; the floor is y = 0.
struct FootTrack {
  enum class End {
    kOpen,
    kStands,
    kInAir
  };  ///< whether it stands at a key in the last frame, if any

  Eigen::Vector3d before;             ///< toes in the frame before the first
  bool stood = false;                 ///< whether they stand there
  std::vector<Eigen::Vector3d> toes;  ///< per frame, in the plan
  std::vector<double> heights;     ///< per frame: of the foot's lowest joint, relative to where it
                                   ///< is on the floor
  std::vector<double> unbalanced;  ///< per frame: how far the zero moment point is outside
                                   ///< this foot, square metres
  /// Per frame: whether the floor carries the body without feet: it sits, lies, kneels, or stands
  /// on its hands. It then needs no foot on the floor. Empty: never.
  std::vector<bool> carried = {};
  double fall_before = 0;  ///< how far it falls from the frame before the first, at least, ...
  double rise_before = 0;  ///< ... where it rises at this speed, m/s
  double fall_after = 0;   ///< how far it falls after a key in the last frame, at least
  End end = End::kOpen;
};

/// Decides when each foot stands and where, for the whole plan. It minimises how far toes move from
/// the plan (squares, along the floor and down to it), how badly the body is balanced, and the cost
/// of each step (FootworkOptions). One foot supports the body while the other is in the air, except
/// in flights and where something else carries it. Optimises each foot given the other (dynamic
/// programming over frames), in turn. Deterministic. A plan of F frames takes F * kMaxStance steps.
std::array<std::vector<Stance>, 2> PlanContacts(const std::array<FootTrack, 2>& feet, double fps,
                                                const FootworkOptions& options);

}  // namespace choreo
