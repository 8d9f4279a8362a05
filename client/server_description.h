#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/messages/model_description.h"

/// A server's description of itself and its models.
namespace choreo::client {

using choreo::ModelDescription;

/// The answer to GetServerInfo.
struct ServerDescription {
  std::string version = {};
  std::vector<ModelDescription> models = {};  ///< the first is the default
  std::vector<std::string> devices = {};
  int workers = 0;
  int active_streams = 0;
  bool draining = false;  ///< it is stopping, and takes no new dances
  /// The server's limits.
  struct Limits {
    int64_t max_message_bytes = 0;
    double max_audio_s = 0;
    int64_t max_audio_file_bytes = 0;
    int max_keyframes = 0;
    int max_transition_frames = 0;
    int max_candidates = 0;
    double max_frame_rate = 0;
    int max_streams = 0;
  } limits;
};

}  // namespace choreo::client
