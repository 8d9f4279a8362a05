#pragma once

#include <array>
#include <string_view>

#include "model/metrics/critic.h"
#include "model/motion/skeleton.h"

/// Critics that look at one side of a dance each: what they can tell from real motion says what is
/// amiss. For measuring alone, as the critic.
namespace choreo {

/// What each looks at, in windows of 2 s:
///   floor          how high lower foot, upper foot and lowest joint are above the floor
///   balance        how far centre of mass and zero moment point are outside of the feet, how the
///                  centre accelerates
///   contacts       how many feet are on the floor, how long, on toes or heel, how they slide
///   foot spectrum  SpeedSpectrum of ankles and toes
///   coordination   which limbs are fast together
///   dwell          how slow hands, feet and pelvis get, and how long
inline constexpr std::array<std::string_view, 6> kCriticFamilies = {
    "floor", "balance", "contacts", "foot spectrum", "coordination", "dwell"};

/// [kCriticFamilies] Windows of one kind of motion, as each critic sees them.
using FamilyWindows = std::array<CriticWindows, kCriticFamilies.size()>;

/// Cuts a motion into windows of 2 s, side by side from its first frame on. `floor`: its height,
/// metres. Throws Error(kInvalidArgument) for a skeleton that BalanceGauge doesn't fit.
void AddFamilies(const Skeleton& skeleton, double fps, const JointTrack& track, double floor,
                 size_t clip, FamilyWindows* to);

/// CriticArea of each, by a plain ridge regression: features are few, and each is meant.
std::array<double, kCriticFamilies.size()> FamilyAreas(const FamilyWindows& real,
                                                       const FamilyWindows& danced);

}  // namespace choreo
