#include "client/cli/dance/live_report.h"

#include <cmath>
#include <utility>

#include "model/motion/resample.h"

namespace choreo::cli {
namespace {

/// Makes a report of what is known about a dance whose server was lost.
client::Report CutOff(const live::LiveDance& live) {
  client::Report report;
  report.frames = static_cast<int64_t>(
                      std::floor(Duration(live.motion()) * live.header().model_fps + kOnFrame)) +
                  1;
  report.keys = live.reached();
  return report;
}

}  // namespace

WrittenDance Examine(const live::LiveDance& live, const authoring::DanceKeys& keys,
                     DanceSettings settings) {
  WrittenDance written = Examine(live.header(), live.report() ? *live.report() : CutOff(live),
                                 live.motion(), live.DancedKeys());
  written.is_complete = live.report().has_value();
  MarkHolds(keys, &written);
  std::vector<double> beats, downbeats;
  for (const client::Beat& beat : live.beats()) {
    beats.push_back(beat.time_s);
    if (beat.downbeat) downbeats.push_back(beat.time_s);
  }
  written.beat_hit_chance = BeatHitChance(beats, written.figures.frames, written.fps);
  if (settings.song.empty()) {
    settings.beats = std::move(beats);
    settings.downbeats = std::move(downbeats);
  }
  written.settings = std::move(settings);
  written.warnings = keys.warnings;
  written.warnings.insert(written.warnings.end(), live.warnings().begin(), live.warnings().end());
  return written;
}

}  // namespace choreo::cli
