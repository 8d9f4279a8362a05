#include "client/cli/edit_options.h"

#include <sstream>

#include "client/authoring/music.h"
#include "client/cli/options.h"
#include "client/cli/report.h"
#include "model/core/atomic_file.h"

namespace choreo::cli {

client::EditOptions HowToDance(const EditOptions& options, const Connection& connection) {
  client::EditOptions edit;
  edit.model = connection.model(options.model);
  edit.seed = options.seed.value_or(0);
  edit.temperature = options.temperature;
  edit.music_dynamics = options.music_dynamics;
  edit.variation = options.variation;
  edit.style = options.style;
  edit.controls = options.controls.Read(edit.model, connection.server());
  NoteDeterministic(edit.model, {{"--seed", options.seed.has_value()},
                                 {"--temperature", edit.temperature.value_or(0) != 0}});
  return edit;
}

void TakeSong(const EditOptions& options, double end_s, client::EditOptions* edit) {
  authoring::RequireSong(options.beats, options.song);
  if (options.song.empty()) return;
  const authoring::Music music =
      authoring::ReadMusic(options.song, end_s, options.song_start_s, options.beats);
  edit->audio = authoring::AudioFor(music.audio, end_s);
  edit->music_beats = authoring::BeatsBefore(music, end_s);
  edit->music_passages = music.passages;
  edit->music_id = music.id;
}

KnownDance ReadKnown(const std::string& path, int64_t frames, double fps) {
  const auto report = ReadReport(path);
  if (report["fps"] != fps) {
    std::ostringstream message;
    message << report["fps"].dump() << ", but the model runs at " << fps;
    throw InvalidArgument(path + ":fps", message.str());
  }
  // Older edits wrote no count.
  if (report.contains("frames") && report["frames"] != frames) {
    throw InvalidArgument(path + ":frames", report["frames"].dump() + ", but the dance has " +
                                                std::to_string(frames) +
                                                ": this is another dance's report");
  }
  return {KeysOf(report, frames, path), ReadWarnings(report, path)};
}

void WriteKnown(const std::filesystem::path& path, const KnownDance& known, int64_t frames,
                double fps) {
  nlohmann::ordered_json report = {{"frames", frames}, {"fps", fps}};
  report["keyframes"] = nlohmann::ordered_json::array();
  for (const auto& [frame, key] : known.keys) report["keyframes"].push_back(key);
  report["warnings"] = WarningsJson(known.warnings);
  WriteFile(path, report.dump(2) + "\n");
}

}  // namespace choreo::cli
