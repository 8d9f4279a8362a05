#pragma once

/// What servers and clients agree on beside the API.
namespace choreo {

/// The least silence, seconds, after which a client may treat a server as lost. Clients ping twice
/// in that time, and servers allow twice as many pings.
inline constexpr double kMinSilence = 2;

inline constexpr int kDefaultPort = 50051;  ///< of choreod
inline constexpr int kMaxPort = 65'535;

}  // namespace choreo
