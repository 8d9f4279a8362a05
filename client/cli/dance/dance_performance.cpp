#include "client/cli/dance/dance_performance.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <sstream>
#include <utility>

#include "client/authoring/fields/json_fields.h"
#include "client/authoring/keys/choreography.h"
#include "client/authoring/keys/dance_keys.h"
#include "client/authoring/keys/ending.h"
#include "client/authoring/keys/key_faults.h"
#include "client/authoring/keys/key_file.h"
#include "client/authoring/keys/pose_source.h"
#include "client/authoring/notes/notes.h"
#include "client/authoring/project/formation.h"
#include "client/cli/dance/dance_display.h"
#include "client/cli/options/interruption.h"
#include "client/cli/options/options.h"
#include "client/cli/options/output_file.h"
#include "client/cli/report/report.h"
#include "model/core/rounded.h"

namespace choreo::cli {
namespace {

/// Chooses the length of a dance without a song: as long as the path and the keys require.
double ChooseSilentSeconds(const DanceOptions& options, const ControlRequest& controls,
                           const client::ModelDescription& model) {
  if (options.seconds) return *options.seconds;
  int64_t last = controls.root_path ? controls.root_path->frames.back() : 0;
  for (const std::string& source : authoring::KeySources(options.keys)) {
    for (const client::KeyPose& key : authoring::ReadKeys(source, model.skeleton))
      last = std::max(last, authoring::FrameOf(key, model.fps));
  }
  return static_cast<double>(last + 1) / model.fps;
}

double ChooseSeconds(const DanceOptions& options, const authoring::Music& music) {
  const double song = music.audio.seconds();
  if (!options.seconds) return song;
  if (*options.seconds > song) {
    std::ostringstream message;
    message << "warning: --seconds " << *options.seconds << " is beyond the song, which ends at "
            << Rounded(song) << " s; the dance ends with it";
    authoring::Note(message.str());
  }
  return std::min(*options.seconds, song);
}

authoring::Counts CountsOf(const DanceOptions& options,
                           const std::optional<authoring::Music>& music) {
  if (!options.project_beats.empty())
    return authoring::CountsFrom(options.project_beats, options.project_ones);
  return music ? authoring::CountsOf(*music) : authoring::Counts();
}

authoring::DanceKeys ChooseKeys(const DanceOptions& options,
                                const std::optional<authoring::Music>& music, double seconds,
                                const authoring::DanceLength& length,
                                const client::ModelDescription& model) {
  if (authoring::IsNoKeys(options.keys)) return {};
  if (!options.keys.empty()) {
    if (length.frames < 1) {
      std::ostringstream message;
      message << seconds << " s is shorter than a frame of the model, " << Rounded(1 / length.fps)
              << " s, the least";
      throw InvalidArgument("--seconds", message.str());
    }
    authoring::DanceKeys keys =
        authoring::ReadDanceKeys(options.keys, length, model.skeleton, CountsOf(options, music));
    if (!options.allow_bends) authoring::RefuseBends(keys, model.skeleton);
    return keys;
  }
  authoring::CompositionRequest request{
      .seconds = seconds, .seed = options.seed.value_or(0), .way = options.way_seed};
  if (!options.seconds) request.named = music ? options.song : "--path";
  if (music) {
    const authoring::Counts counts = CountsOf(options, music);
    request.beats = counts.beats;
    request.one = counts.one;
    request.passages = music->passages;
    request.seed ^= music->id;  // other songs get other poses and paths
    if (request.way) *request.way ^= music->id;
  }
  // With a deterministic model, the dancer hardly moves without a next key.
  if (model.deterministic) request.end_s = static_cast<double>(length.frames - 1) / length.fps;
  authoring::DanceKeys keys;
  keys.poses = authoring::ComposeKeys(request, authoring::PosesToDance(model.skeleton));
  for (size_t i = 0; i < keys.poses.size(); ++i) {
    keys.places.push_back("keyframes[" + std::to_string(i) + "]");
    // The path sets the dancer's place.
    if (options.controls.IsOption(kRootPath)) keys.poses[i].mask.root_position = false;
  }
  return keys;
}

/// Lets the dance end in the pose of --end.
void AddEnding(const DanceOptions& options, const std::optional<authoring::Music>& music,
               const ControlRequest& controls, const authoring::DanceLength& length,
               const client::ModelDescription& model, authoring::DanceKeys* keys) {
  if (options.end.empty()) return;
  const authoring::NamedPose pose =
      authoring::ReadPose(options.end, model.skeleton, CountsOf(options, music));
  if (pose.has_place && !options.allow_bends)
    authoring::RefuseBends({{pose.key}, {options.end}}, model.skeleton);
  authoring::NoteOwnHold(pose);
  const std::vector<double> beats = CountsOf(options, music).beats;
  authoring::DanceLength seen = length;
  seen.frames -=
      authoring::FramesLater(options.after, beats, length.fps, length.frames, options.after_name);
  const double held_s =
      static_cast<double>(seen.frames - 1) / seen.fps - authoring::Ending(pose, beats, seen).time_s;
  authoring::RefuseHeldInAir(pose.key, held_s, "--end", model.skeleton);
  const std::vector<std::string> gone = authoring::EndIn(pose, beats, controls, seen, keys);
  if (options.keys.empty()) return;  // the user did not set the removed keys
  for (const std::string& id : gone)
    authoring::Note("note: key \"" + id + "\" makes way for the ending");
}

client::DanceResult Dance(const client::Client& client, const client::DanceConfig& config,
                          const authoring::DanceKeys& keys, const client::Audio& audio,
                          double model_fps, const DanceOptions& options,
                          const std::filesystem::path& out, VmcShow* show) {
  client::DanceResult dance;
  DanceDisplay display(*config.frames, model_fps, options.dancers_named);
  try {
    client.Dance(
        config, keys.poses, audio,
        [&](const client::Message& message) {
          Interruption::Check();
          display(message);
          if (show) show->Add(message);
        },
        &dance);
  } catch (const Error& error) {
    if (!dance.motion.frames.empty()) {
      const std::filesystem::path partial = PartialPath(out);
      options.bvh.Write(partial, dance.header.skeleton, dance.motion, dance.contacts);
      std::ostringstream message;
      message << "the dance was cut off; its first " << dance.motion.frames.size() << " frames ("
              << Rounded(static_cast<double>(dance.motion.frames.size()) / dance.motion.fps)
              << " s) are in " << partial.string() << '\n';
      std::cerr << message.str();
    }
    if (error.field() == "config.style") throw error.Of(options.style_name);
    throw authoring::InTermsOf(keys, options.controls.InTermsOf(error));
  }
  return dance;
}

DanceSettings SettingsFor(const DanceOptions& options, const client::Header& header,
                          const client::DanceConfig& config) {
  DanceSettings settings{config.manner, header.model, header.seed};
  settings.controls = config.controls;
  if (options.song.empty() || options.song == "-") return settings;
  settings.song = options.song;
  settings.song_start_s = options.song_start_s;
  if (!options.project_beats.empty() || options.beats != authoring::BeatOptions()) {
    settings.beats = config.known.music_beats;
    settings.downbeats = config.known.music_downbeats;
  }
  return settings;
}

}  // namespace

void CheckKeyFiles(const DanceOptions& options, const std::optional<authoring::Music>& music) {
  for (const std::string& source : authoring::KeySources(options.keys))
    authoring::ReadKeys(source, Skeleton::Smpl24(), nullptr, CountsOf(options, music));
}

PlannedDance Plan(const DanceOptions& options, const std::optional<authoring::Music>& music,
                  const Connection& connection) {
  const client::ModelDescription& model = connection.model(options.model);
  // The seed chooses among the library's key poses, with any model.
  const bool is_seed_for_model = options.seed && !options.keys.empty();
  NoteDeterministic(model, {{"--seed", is_seed_for_model},
                            {"--temperature", options.temperature.value_or(0) != 0}});
  NoteStyle(model, options.style);
  const ControlRequest controls =
      options.controls.Read(model, connection.server(), CountsOf(options, music));
  const double seconds =
      music ? ChooseSeconds(options, *music) : ChooseSilentSeconds(options, controls, model);
  if (music && !model.takes_music) {
    authoring::Note("note: the model \"" + model.name +
                    "\" takes no music; the song gives the dance its length and its beats");
  }
  authoring::CheckInADance(std::round(seconds * model.fps) / model.fps, "--seconds");
  const authoring::DanceLength length{std::llround(seconds * model.fps), model.fps};
  PlannedDance plan{.options = options, .length = length, .counts = CountsOf(options, music)};
  plan.keys = ChooseKeys(options, music, seconds, length, model);
  AddEnding(options, music, controls, length, model, &plan.keys);
  options.controls.RequireBegun(controls, length);
  authoring::RefuseHeldInAir(plan.keys, model.fps, model.skeleton);
  plan.faults = authoring::KeyFaults(plan.keys, model.fps, model.skeleton);
  ShowWarnings(plan.faults, {model.fps});

  client::DanceConfig& config = plan.config;
  config.model = options.model;
  config.fps = options.fps;
  config.seed = options.seed.value_or(0);
  config.manner = options;
  config.frames = length.frames;
  config.controls = controls;
  config.known.music_beats = options.project_beats;
  config.known.music_downbeats = options.project_downbeats;
  if (music) authoring::FillInMusic(*music, seconds, &config.known);
  if (music && model.takes_music) plan.audio = authoring::AudioFor(music->audio, seconds);
  return plan;
}

Performance Perform(const PlannedDance& plan, const Connection& connection,
                    const std::filesystem::path& out, std::optional<VmcShow>* show) {
  const auto& [options, length, counts, keys, faults, config, audio] = plan;
  if (!options.vmc.empty()) show->emplace(options.vmc, connection.model(options.model).skeleton);
  client::DanceResult dance = Dance(connection.client(), config, keys, audio, length.fps, options,
                                    out, *show ? &**show : nullptr);
  WrittenDance written = Examine(dance.header, dance.report, dance.motion, keys.poses);
  MarkHolds(keys, &written);
  written.counts = counts;
  written.settings = SettingsFor(options, dance.header, config);
  written.warnings = faults;
  written.warnings.insert(written.warnings.end(), dance.warnings.begin(), dance.warnings.end());
  written.beat_hit_chance = BeatHitChance(config.known.music_beats, length.frames, length.fps);
  return {std::move(dance), std::move(written)};
}

}  // namespace choreo::cli
