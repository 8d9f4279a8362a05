#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "model/plan/footwork_options.h"

namespace choreo {

/// A foot's stance: its toes stay at `place` in the frames [from, to].
struct Stance {
  int from = 0, to = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< metres; the height is the floor's
};

/// The stance at a frame; null if there is none.
const Stance* StanceAt(const std::vector<Stance>& stances, int frame);

/// One foot of a plan. Metres; the floor is y = 0.
struct FootTrack {
  enum class End {
    kOpen,
    kStands,
    kInAir
  };  ///< whether it stands at a key in the last frame, if any

  Eigen::Vector3d before;             ///< toes in the frame before the first
  bool stood = false;                 ///< whether the toes stand there
  std::vector<Eigen::Vector3d> toes;  ///< per frame, in the plan
  std::vector<double> heights;     ///< per frame: of the foot's lowest joint, relative to where it
                                   ///< is on the floor
  std::vector<double> unbalanced;  ///< per frame: how far the zero moment point is outside
                                   ///< this foot, square metres
  /// Per frame: whether the floor carries the body without feet, because it sits, lies, kneels or
  /// stands on its hands. No foot then needs to be on the floor. Empty: never.
  std::vector<bool> carried = {};
  double height_before = 0;  ///< as `heights`, in the frame before the first
  double fall_before = 0;    ///< least fall from the frame before the first ...
  double rise_before = 0;    ///< ... where it rises at this speed, m/s
  double fall_after = 0;     ///< least fall after a key in the last frame
  End end = End::kOpen;
};

/// Plans when and where each foot stands, for the whole plan. Minimises the sum of the toes'
/// squared distance from the plan (along the floor and down to it), the body's imbalance, and the
/// cost of steps (FootworkOptions). One foot supports the body while the other is in the air,
/// except in flights and where something else carries the body. Optimises the feet in turn, each
/// given the other, by dynamic programming over frames. Deterministic. A plan of F frames takes F *
/// kMaxStance steps.
std::array<std::vector<Stance>, 2> PlanContacts(const std::array<FootTrack, 2>& feet, double fps,
                                                const FootworkOptions& options);

}  // namespace choreo
