// Generates a whole dance again.
#include <algorithm>

#include "client/edit.h"
#include "model/motion/rotation.h"

namespace choreo::client {
namespace {

/// Returns the configuration for Client::Dance.
DanceConfig ConfigFor(const FinishedDance& dance, const EditOptions& options) {
  DanceConfig config;
  config.model = options.model.name;
  config.fps = dance.motion.fps;
  config.seed = options.seed;
  config.manner = options.manner;
  config.known = options.known;
  config.frames = CountModelFrames(dance, options.model);
  const double end_s = static_cast<double>(*config.frames) / options.model.fps;
  std::erase_if(config.known.music_passages,
                [end_s](const Passage& passage) { return passage.from >= end_s; });
  config.controls = options.controls;
  return config;
}

}  // namespace

EditedDance DanceAllAnew(const Client& client, const FinishedDance& dance,
                         const EditOptions& options, const std::vector<KeyPose>& keys) {
  const Audio audio = options.model.takes_music ? options.audio : Audio{};
  DanceResult danced = client.Dance(ConfigFor(dance, options), keys, audio);
  EditedDance edited;
  edited.dance = {std::move(danced.motion), std::move(danced.contacts)};
  edited.end_changed = static_cast<int64_t>(dance.motion.frames.size());
  // A file may have frames after the model's last frame.
  const auto frames = dance.motion.frames.size();
  edited.dance.motion.frames.resize(frames, edited.dance.motion.frames.back());
  if (dance.contacts.empty())
    edited.dance.contacts.clear();
  else
    edited.dance.contacts.resize(frames, edited.dance.contacts.back());
  edited.keys = std::move(danced.report.keys);
  edited.warnings = std::move(danced.warnings);
  return edited;
}

}  // namespace choreo::client
