#pragma once

#include <span>

#include "model/engine/step_engine.h"
#include "model/motion/kinematics.h"

/// How much of what a model leaves open a transition takes: its temperature, shared out between the
/// waves of a plan's variety (model/flow/variety.h) and frames' own noise. Pure functions;
/// thread-safe.
namespace choreo {

/// True where the transition has a key that names a joint or the root's position.
bool Keyed(const TransitionSpec& spec);

/// How much of one wave of a plan's variety is sampled.
struct WaveShare {
  float temperature;  ///< times what its spread is
  int components;     ///< how many of variety's principal components, the first ones
};

/// Of wave `wave` (0: the slowest), of variety with `components`. On the way to a key the
/// temperature to a power: slow waves, which lead away from the way that is most probable, take
/// little; quick ones make a dance as lively as dancers are, which the mean of all ways is the less
/// the longer the way is. Slow waves have a third of the components, those in which ways differ
/// most: ten dances that differ in few things come nearer to what was danced than ten that differ
/// in everything. Without a key the fourth root of the temperature for all waves: at the
/// temperatures that serve keys well such a dance would all but stand.
WaveShare ShareOf(const TransitionSpec& spec, int wave, int components);

/// The share of its temperature that frames' own noise has on the way to a key: as rough as the
/// dancer is whose last poses these are, by the median jerk of all joints beyond what a plan with
/// locked feet has itself. From 0 (smooth) to 3, but no more than leads to the noise of temperature
/// 0.75, or of its own: roughness is handed on from transition to transition, and must not grow. 1
/// where nothing is known: without a key, from a standstill, and where `history`, the placements of
/// the spec's, has less than four poses.
float NoiseShare(const TransitionSpec& spec, std::span<const JointPlacement> history, double fps);

}  // namespace choreo
