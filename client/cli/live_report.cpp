#include "client/cli/live_report.h"

#include <utility>

namespace choreo::cli {

WrittenDance Examine(const live::LiveDance& live, const authoring::DanceKeys& keys, Asked asked) {
  WrittenDance written = Examine(live.header(), *live.report(), live.motion(), live.DancedKeys());
  for (size_t i = 0; i < keys.poses.size(); ++i) {
    for (WrittenKey& key : written.keys)
      if (key.reached.id == keys.poses[i].id) key.holds = authoring::HeldKey(keys, i);
  }
  for (const client::Beat& beat : live.beats()) {
    asked.beats.push_back(beat.time_s);
    if (beat.downbeat) asked.downbeats.push_back(beat.time_s);
  }
  written.beat_hit_chance =
      BeatHitChance(asked.beats, written.report.frames, live.header().model_fps);
  written.asked = std::move(asked);
  written.warnings = keys.warnings;
  written.warnings.insert(written.warnings.end(), live.warnings().begin(), live.warnings().end());
  return written;
}

}  // namespace choreo::cli
