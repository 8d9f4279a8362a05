#pragma once

#include <cstddef>
#include <cstdint>

#include "model/core/grid.h"

/// The API's limits, shared by servers and clients.
namespace choreo {

inline constexpr int kMaxTransitionFrames = 1800;    ///< in one transition: a minute
inline constexpr int64_t kMaxDanceFrames = 108'000;  ///< the last absolute frame: an hour
inline constexpr int kMaxKeys = 1000;                ///< pending in one stream
inline constexpr int kMinKeyDistance = 2;            ///< frames between two keys
inline constexpr int kMaxCandidates = 32;            ///< dances sampled for one transition
inline constexpr double kMaxTemperature = 2;         ///< of the sampling noise; 0: none
inline constexpr double kDefaultDynamics = 0.5;   ///< how closely energy follows the music, 0 to 1
inline constexpr double kDefaultVariation = 0.3;  ///< between repeats of a passage, 0 to 1
inline constexpr double kMinOutputFps = 1, kMaxOutputFps = 120;  ///< frames per second sent

inline constexpr size_t kMaxNameBytes = 64;  ///< in a model's name, which metrics and logs repeat
inline constexpr size_t kMaxIdLength = 256;  ///< bytes in a key's id
inline constexpr size_t kMaxFingerprintLength = 1024;  ///< bytes

}  // namespace choreo
