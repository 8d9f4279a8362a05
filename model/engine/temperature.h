#pragma once

#include <span>

#include "model/engine/step_engine.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// How much of what a model leaves open a transition takes: its temperature, shared out between the
/// waves of a plan's variety (model/flow/variety.h) and frames' own noise. Pure functions;
/// thread-safe.
namespace choreo {

/// True where the transition has a key that names a joint or the root's position.
bool Keyed(const TransitionSpec& spec);

/// How rough the dancer of these poses is: the median jerk of all joints, m/s^3, at 30 fps. Where
/// nothing is known, from a standstill and with less than four poses, that of whom the model's own
/// noise suits.
double Roughness(const Skeleton& skeleton, std::span<const Pose> history);

/// How little the key asks of the dancer: 1 where it is the pose that stands before frame 0, less
/// the farther away it is, 0 where the way there takes a mean speed of all joints of 0.1 m/s. What
/// the key leaves open stays as it is. 0 without a key.
double Idleness(const Skeleton& skeleton, const TransitionSpec& spec);

/// What history and key tell of how lively a way to a key should be.
struct Liveliness {
  double roughness;     ///< of the history (Roughness), m/s^3
  double idleness = 0;  ///< of the way (Idleness)
};
Liveliness LivelinessOf(const Skeleton& skeleton, const TransitionSpec& spec);

/// Half waves of wave `wave` (0: the slowest) of a plan's variety within its transition: on the way
/// to a key it is nothing at both ends, without one it swings freely at its end.
double HalfWaves(int wave, bool keyed);

/// How much of one wave of a plan's variety is sampled.
struct WaveShare {
  float temperature;  ///< times what its spread is
  int components;     ///< how many of variety's principal components, the first ones
};

/// Of wave `wave` (0: the slowest), of variety with `components`. Slow waves lead away from the way
/// that is most probable; quick ones make a dance as lively as dancers are, which the mean of all
/// ways is the less the longer the way is and the rougher the dancer. So without a key slow waves
/// have the square root of the temperature, which keeps a dance from wandering off, and the
/// quickest twice that; all have all components. On the way to a key slow ones have the temperature
/// to the power of 1.5, quick ones up to eight times that. Below a temperature of 1 no wave has
/// more than all of its spread. With a key, waves of a second and less in ways of two have all
/// components, slower ones and those of shorter ways fewer of them, down to a quarter, those in
/// which ways differ most. From a temperature of a half to one that, too, becomes a quarter for
/// all: ten dances that differ in few things come nearer to what was danced than ten that differ in
/// everything. The more idle the way, the more it is like one without a key, but for temperatures
/// above a half, whose components fade to a quarter here, too.
WaveShare ShareOf(const TransitionSpec& spec, const Liveliness& liveliness, int wave,
                  int components);

/// The share of its temperature that frames' own noise has: as rough as the dancer, beyond what a
/// plan with locked feet has itself. Without a key, and where nothing is known, 1 at most. On the
/// way to one from 0 (smooth) to 3, but no more than leads to the noise of temperature 0.75, or of
/// its own: roughness is handed on from transition to transition, and must not grow. On ways of
/// less than 60 frames, of whose noise arrival smooths most, that share to a power of up to 2.25
/// (10 frames and less), of at most 12.
float NoiseShare(const TransitionSpec& spec, double roughness);

}  // namespace choreo
