#pragma once

#include <array>
#include <string_view>

#include "model/metrics/critic.h"
#include "model/motion/skeleton.h"

/// Critics that each see one aspect of a dance. Those that distinguish it from real motion show
/// which aspects are wrong. Only for measuring, like the critic.
namespace choreo {

/// What each sees, in windows of 2 s:
///
///   floor          height of lower foot, upper foot and lowest joint above the floor
///   balance        distance of centre of mass and zero moment point from the feet,
///                  acceleration of the centre
///   contacts       number of feet on the floor, how long, on toes or heel, how they slide
///   foot spectrum  SpeedSpectrum of ankles and toes
///   coordination   which limbs are fast together
///   dwell          how slow hands, feet and pelvis get, and for how long
inline constexpr std::array<std::string_view, 6> kCriticFamilies = {
    "floor", "balance", "contacts", "foot spectrum", "coordination", "dwell"};

/// [kCriticFamilies] Windows of one kind of motion, as each critic sees them.
using FamilyWindows = std::array<CriticWindows, kCriticFamilies.size()>;

/// Cuts a motion into adjoining windows of 2 s from its first frame on. `floor`: its height,
/// metres. Throws Error(kInvalidArgument) for a skeleton that BalanceGauge doesn't fit.
void AddFamilies(const Skeleton& skeleton, double fps, const JointTrack& track, double floor,
                 size_t clip, FamilyWindows* to);

/// The CriticArea of each by plain ridge regression: features are few and meaningful.
std::array<double, kCriticFamilies.size()> FamilyAreas(const FamilyWindows& real,
                                                       const FamilyWindows& danced);

}  // namespace choreo
