#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "client/authoring/music/music.h"
#include "model/audio/beats/suggest_keys.h"

namespace choreo::authoring {

/// A beat that suits a key pose, and a pose of the library for it.
struct ProposedKey {
  SuggestedKey on;
  std::string id;    ///< of the key
  std::string pose;  ///< LibraryPose::id
};

/// Proposes keys for a song: on SuggestKeys' beats, with poses drawn by DrawPoses from
/// PosesToDance. Fails like SuggestKeys.
std::vector<ProposedKey> ProposeKeys(const Music& music, const SuggestionRequest& request,
                                     uint64_t seed = 0);

}  // namespace choreo::authoring
