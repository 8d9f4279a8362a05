#pragma once

#include <array>
#include <string_view>

#include "model/metrics/critic.h"
#include "model/motion/skeleton.h"

/// Critics that each see one aspect of a dance. A critic that distinguishes it from real motion
/// shows what is wrong with it. Only for measuring, like the critic.
namespace choreo {

/// The input of each, in windows of 2 s:
///
///   floor          height of lower foot, upper foot and lowest joint above the floor
///   balance        distance of centre of mass and zero moment point from the feet,
///                  acceleration of the centre
///   contacts       number of feet on the floor, for how long, on toes or heel, and their sliding
///   foot spectrum  SpeedSpectrum of ankles and toes
///   coordination   limbs that are fast together
///   dwell          the lowest speeds of hands, feet and pelvis, and their duration
inline constexpr std::array<std::string_view, 6> kCriticFamilies = {
    "floor", "balance", "contacts", "foot spectrum", "coordination", "dwell"};

/// [kCriticFamilies] Windows of one kind of motion, as input of each critic.
using FamilyWindows = std::array<CriticWindows, kCriticFamilies.size()>;

/// Cuts a motion into adjoining windows of 2 s from its first frame on. `floor`: the floor's
/// height, metres. Throws Error(kInvalidArgument) for a skeleton that BalanceGauge doesn't fit.
void AddFamilies(const Skeleton& skeleton, double fps, const JointTrack& track, double floor,
                 size_t clip, FamilyWindows* to);

/// The CriticArea of each family by plain ridge regression, as its features are few and meaningful.
std::array<double, kCriticFamilies.size()> FamilyAreas(const FamilyWindows& real,
                                                       const FamilyWindows& danced);

}  // namespace choreo
