#include "client/authoring/keys/proposed_keys.h"

#include "client/authoring/keys/choreography.h"
#include "client/authoring/keys/pose_library.h"

namespace choreo::authoring {

std::vector<ProposedKey> ProposeKeys(const Music& music, const SuggestionRequest& request,
                                     uint64_t seed) {
  const std::vector<SuggestedKey> keys =
      SuggestKeys(music.track, music.onset_strength, music.passages, request);
  std::vector<double> times;
  for (const SuggestedKey& key : keys) times.push_back(key.time_s);
  const std::vector<LibraryPose> poses = PosesToDance(Skeleton::Smpl24());
  const std::vector<size_t> drawn = DrawPoses(times, music.passages, seed ^ music.id, poses);
  std::vector<ProposedKey> proposed;
  for (size_t i = 0; i < keys.size(); ++i)
    proposed.push_back({keys[i], IdOfKey(i + 1, poses[drawn[i]]), poses[drawn[i]].id});
  return proposed;
}

}  // namespace choreo::authoring
