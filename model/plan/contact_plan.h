#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "model/flow/footwork_options.h"

namespace choreo {

/// A foot that stands: its toes stay at `place` in the frames [from, to].
struct Stance {
  int from = 0, to = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< metres; the height is the floor's
};

/// The stance that a frame is in, or null.
const Stance* StanceAt(const std::vector<Stance>& stances, int frame);

/// What is known of one foot of a plan. Metres; the floor is y = 0.
struct FootTrack {
  enum class End { kOpen, kStands, kInAir };  ///< what the key in the last frame says, if any

  Eigen::Vector3d before;             ///< the toes in the frame before the first
  bool stood = false;                 ///< they stand there
  std::vector<Eigen::Vector3d> toes;  ///< of each frame, as the plan has them
  std::vector<double> heights;        ///< of each frame: of the foot's lowest joint above where it
                                      ///< is on the floor
  std::vector<double> unbalanced;     ///< of each frame: how far the zero moment point is beyond
                                      ///< this foot, square metres
  double height_before = 0;           ///< as `heights`
  End end = End::kOpen;
};

/// When each foot stands and where, for the whole plan at once: the stances for which toes leave
/// the plan least (squares, along the floor and down to it) and the body is balanced best, where
/// each step costs as much as leaving the plan does (FootworkOptions). One foot carries the body
/// while the other is in the air, but in flights. Each foot's stances are the best beside the
/// other's (dynamic programming over frames), in turn. Deterministic. A plan of F frames takes
/// F * kLongestStance steps.
std::array<std::vector<Stance>, 2> PlanContacts(const std::array<FootTrack, 2>& feet, double fps,
                                                const FootworkOptions& options);

}  // namespace choreo
