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
  /// The largest values that the server accepts. 0: an older server does not state it.
  struct Limits {
    int64_t max_message_bytes = 0;     ///< of one message
    double max_audio_s = 0;            ///< of music, from its start
    int64_t max_audio_file_bytes = 0;  ///< of a music file
    int max_keyframes = 0;             ///< keys in a dance
    int max_transition_frames = 0;     ///< of one transition, at the model's rate
    int max_candidates = 0;            ///< of one transition
    double max_frame_rate = 0;         ///< of the output, frames per second
    int max_streams = 0;               ///< concurrent dances and transitions
  } limits;
};

}  // namespace choreo::client
