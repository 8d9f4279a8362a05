#pragma once

#include <cstddef>
#include <cstdint>

#include "model/core/grid.h"

/// The API's limits and default port, shared by servers and clients.
namespace choreo {

inline constexpr int kMaxTransitionFrames = 1800;    ///< of one transition: a minute
inline constexpr int64_t kMaxDanceFrames = 108'000;  ///< absolute: an hour
inline constexpr int kMaxKeys = 1000;                ///< of one stream at a time
inline constexpr int kMinKeyDistance = 2;            ///< frames between two keys
inline constexpr int kMaxCandidates = 32;            ///< of one transition
inline constexpr double kMaxTemperature = 2;         ///< 0: the mean
inline constexpr double kDefaultDynamics = 0.5;   ///< how closely energy follows the music, 0 to 1
inline constexpr double kDefaultVariation = 0.3;  ///< of repeated passages, 0 to 1
inline constexpr double kMinOutputFps = 1, kMaxOutputFps = 120;  ///< frames sent a second

inline constexpr size_t kMaxNameBytes = 64;  ///< of a model's name, which metrics and logs repeat
inline constexpr size_t kMaxIdLength = 256;  ///< bytes, of a key
inline constexpr size_t kMaxFingerprintLength = 1024;  ///< bytes

/// Seconds of silence after which a client may take a server for lost at the soonest: it pings at
/// half of that, and servers allow twice as many pings.
inline constexpr double kMinSilence = 2;

inline constexpr int kDefaultPort = 50051;  ///< of choreod
inline constexpr int kMaxPort = 65'535;

}  // namespace choreo
