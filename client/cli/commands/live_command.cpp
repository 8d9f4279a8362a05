#include <unistd.h>

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>

#include "client/authoring/keys/dance_keys.h"
#include "client/authoring/keys/key_file.h"
#include "client/authoring/keys/pose_library.h"
#include "client/authoring/music/music.h"
#include "client/cli/commands/commands.h"
#include "client/cli/dance/live_report.h"
#include "client/cli/options/authoring_options.h"
#include "client/cli/options/connection.h"
#include "client/cli/options/interruption.h"
#include "client/cli/options/options.h"
#include "client/cli/options/output_file.h"
#include "client/cli/report/report.h"
#include "client/live/live_dance.h"
#include "client/live/midi_clock.h"
#include "client/live/vmc.h"
#include "model/core/files/atomic_file.h"
#include "model/core/limits.h"
#include "model/core/rounded.h"
#include "model/formats/motion_file.h"
#include "model/motion/resample.h"
#include "network/protocol.h"

namespace choreo::cli {
namespace {

struct LiveCommand : DanceManner {
  ServerOptions server;
  std::string song;
  double song_start_s = 0;
  std::string input = "default";
  std::vector<std::string> keys;
  int osc_port = 0;
  std::string midi_clock;
  authoring::BeatOptions beats;
  double ahead_s = live::LiveOptions{}.ahead_s;
  double look_ahead_s = live::LiveOptions{}.look_ahead_s;
  std::optional<double> seconds;
  std::optional<uint64_t> seed;
  authoring::WrittenControls controls;
  double fps = 0;
  std::string model;
  std::string vmc;
  std::string out;
  std::string report;
};

void CheckBeatOptions(const authoring::BeatOptions& beats) {
  if (!beats.FindsThem()) {
    throw InvalidArgument("--beats",
                          "names the beats of a whole song, but a live dance hears them meanwhile, "
                          "or takes them from --midi-clock; `choreo dance` reads " +
                              *beats.beats);
  }
  if (beats.downbeat_s) {
    throw InvalidArgument("--downbeat",
                          "names a second of a song, which live music does not have; `choreo "
                          "dance` counts bars from it");
  }
}

void CheckOutputs(const LiveCommand& options) {
  if (!options.out.empty()) RequireWrittenMotionFile(options.out);
  std::vector<NamedFile> inputs = FilesOf(options.controls);
  inputs.push_back({"song", options.song});
  for (const std::string& keys : authoring::KeySources(options.keys))
    inputs.push_back({"--keyframes", authoring::FileOf(keys)});
  RequireOutputs({{"--out", options.out}, {"--report", options.report}}, inputs);
}

std::unique_ptr<live::Sound> OpenSound(const LiveCommand& options) {
  if (options.song.empty()) return live::ListenTo(options.input);
  return live::PlaySong(authoring::ReadSong(options.song, std::numeric_limits<double>::infinity(),
                                            options.song_start_s));
}

/// The counts of a song's file, for times of keys and controls.
authoring::Counts CountsFor(const LiveCommand& options, double seconds) {
  if (options.song.empty() || options.song == "-") {
    return {.advice =
                "the beats of live music are not known in advance; use seconds, or name the song's "
                "file"};
  }
  if (authoring::KeySources(options.keys).empty() && FilesOf(options.controls).empty()) return {};
  return authoring::CountsOf(
      authoring::ReadMusic(options.song, seconds, options.song_start_s, options.beats));
}

/// The legend of keyboard keys and their poses, as wide as a terminal.
std::string Legend(const std::vector<authoring::LibraryPose>& poses) {
  constexpr size_t kColumns = 4;
  std::ostringstream legend;
  for (size_t i = 0; i < std::min(poses.size(), live::KeyboardKeys().size()); ++i) {
    legend << "  " << live::KeyboardKeys()[i] << ' ' << std::left << std::setw(15) << poses[i].id;
    if (i % kColumns == kColumns - 1) legend << '\n';
  }
  legend << "\nBackspace removes the last pose; Ctrl-C ends the dance.\n";
  return legend.str();
}

std::vector<std::unique_ptr<live::Cues>> OpenCues(
    const LiveCommand& options, const std::vector<authoring::LibraryPose>& poses) {
  std::vector<std::unique_ptr<live::Cues>> cues;
  if (options.osc_port > 0) cues.push_back(live::HearOsc(options.osc_port));
  std::vector<std::string> names;
  for (const authoring::LibraryPose& pose : poses) names.push_back(pose.id);
  if (auto keyboard = live::ReadKeyboard(STDIN_FILENO, names)) {
    cues.push_back(std::move(keyboard));
    std::cout << Legend(poses);
  }
  return cues;
}

std::string Say(const live::LiveFigures& figures) {
  std::ostringstream line;
  line << std::fixed << std::setprecision(0) << figures.seconds << " s: " << figures.frames
       << " frames, " << figures.late << " late";
  if (figures.late > 0) line << " by " << figures.most_late_ms << " ms at most";
  if (figures.tempo) {
    line << std::setprecision(1) << "; " << *figures.tempo << " beats a minute, confidence "
         << std::setprecision(2) << figures.confidence;
  }
  line << "; poses: " << figures.keys_taken << " taken, " << figures.keys_danced << " danced, "
       << figures.keys_refused << " refused\n";
  return line.str();
}

DanceSettings SettingsFor(const LiveCommand& options, const live::LiveDance& live) {
  const client::Header& header = live.header();
  DanceSettings settings{{options}, header.model, header.seed};
  if (options.song.empty() || options.song == "-") return settings;
  settings.song = options.song;
  settings.song_start_s = options.song_start_s;
  if (options.beats == authoring::BeatOptions()) return settings;
  // Edits count like `analyze` with these options.
  KnownMusic known;
  const double seconds = Duration(live.motion());
  authoring::FillInMusic(
      authoring::ReadMusic(options.song, seconds, options.song_start_s, options.beats), seconds,
      &known);
  settings.beats = known.music_beats;
  settings.downbeats = known.music_downbeats;
  return settings;
}

void Run(const LiveCommand& options) {
  CheckOutputs(options);
  CheckBeatOptions(options.beats);
  if (options.server.deadline_s > 0) {
    throw InvalidArgument("--deadline",
                          "a live dance lasts as long as its music; --seconds limits it");
  }
  if (options.look_ahead_s >= options.ahead_s) {
    throw InvalidArgument("--ahead", InFull(options.ahead_s) + " s does not exceed --look-ahead, " +
                                         InFull(options.look_ahead_s) + " s");
  }
  // Opened before the server starts, so that a wrong file name is reported at once.
  const std::unique_ptr<live::Sound> sound = OpenSound(options);
  const Connection connection(options.server, options.model);
  const client::ModelDescription& model = connection.model(options.model);
  NoteStyle(model, options.style);
  live::LiveOptions dance;
  dance.config.model = options.model;
  dance.config.fps = options.fps;
  dance.config.seed = options.seed.value_or(0);
  dance.config.manner = options;
  dance.beats = options.beats.hint;
  dance.ahead_s = options.ahead_s;
  dance.look_ahead_s = options.look_ahead_s;
  dance.most_keys = connection.server().limits.max_keyframes;
  const double most = connection.server().limits.max_audio_s;
  dance.seconds = std::min(options.seconds.value_or(most), most);
  // A shorter song ends the dance.
  const double longest = std::min(dance.seconds, sound->seconds());
  const authoring::DanceLength length{std::max<int64_t>(1, std::llround(longest * model.fps)),
                                      model.fps};
  const authoring::Counts counts = CountsFor(options, longest);
  dance.config.controls = options.controls.Read(model, connection.server(), counts);
  options.controls.RequireBegun(dance.config.controls, length);
  const authoring::DanceKeys keys =
      authoring::ReadDanceKeys(authoring::KeySources(options.keys), length, model.skeleton, counts);
  ShowWarnings(keys.warnings, {model.fps});
  dance.keys = keys.poses;
  const std::vector<authoring::LibraryPose> poses = authoring::PosesToDance(model.skeleton);
  for (const authoring::LibraryPose& pose : poses) dance.poses[pose.id] = pose.pose;

  live::LiveObserver observer;
  observer.go_on = [] { return !Interruption::Came(); };
  observer.figures = [](const live::LiveFigures& figures) { std::cout << Say(figures); };
  observer.note = [](const std::string& text) { std::cerr << "note: " << text << '\n'; };
  observer.failure = [&connection] { return connection.failure(); };
  std::optional<live::VmcSender> vmc;
  if (!options.vmc.empty()) {
    vmc.emplace(options.vmc, model.skeleton);
    observer.show = [&vmc](const Pose& pose, double seconds) { vmc->Send(pose, seconds); };
  }
  std::optional<live::MidiClock> midi;
  if (!options.midi_clock.empty()) midi.emplace(options.midi_clock);
  const Interruption interruption;
  const std::vector<std::unique_ptr<live::Cues>> cues = OpenCues(options, poses);
  std::cout << std::unitbuf << "listening to "
            << (options.song.empty() ? options.input : options.song) << '\n';
  live::LiveDance live(connection.client(), model, std::move(dance), std::move(observer));
  const auto write = [&] {
    if (live.motion().frames.empty()) return;
    if (!options.out.empty()) {
      WriteMotion(options.out, live.header().skeleton, live.motion(), &live.contacts());
      std::cout << options.out << '\n';
    }
    if (options.report.empty()) return;
    WriteFile(options.report, ReportJson(Examine(live, keys, SettingsFor(options, live))));
    std::cout << options.report << '\n';
  };
  try {
    live.Run(*sound, cues, midi ? &*midi : nullptr);
  } catch (const Error& error) {
    write();  // keeps what has been danced
    throw options.controls.InTermsOf(error);
  }
  write();
}

}  // namespace

void AddLiveCommand(CLI::App& program) {
  auto options = std::make_shared<LiveCommand>();
  CLI::App* command = program.add_subcommand(
      "live",
      "Dance to music while it sounds, through poses that are requested meanwhile.\nEach pose "
      "falls on the first beat at least a second ahead. At a terminal, letters request poses of "
      "the library. The dance ends with the music, with Ctrl-C, or after the longest music that "
      "the server allows.");
  CLI::Option* song =
      command
          ->add_option(
              "song", options->song,
              "WAV, FLAC, Ogg or MP3 file, or - for standard input, to dance to instead of a "
              "microphone or line in; with ffmpeg installed, any file that it reads.")
          ->check(SongFile());
  AddSongStart(*command, options->song_start_s);
  command
      ->add_option("--input", options->input,
                   "Microphone or line in, by its ALSA name; `arecord -L` lists them.")
      ->excludes(song)
      ->capture_default_str();
  AddRepeated(*command, "-k,--keyframes", options->keys,
              "Key poses known from the start, as in `choreo dance`. Seconds count from the start "
              "of the dance, counts (9c) are those of the song's file. none: no keys (default).");
  command
      ->add_option("--osc", options->osc_port,
                   "UDP port for OSC messages: /choreo/key POSE [SECONDS ahead], /choreo/undo. "
                   "Anybody who reaches the port can send them.")
      ->check(WholeNumberFrom(1, kMaxPort));
  command->add_option("--midi-clock", options->midi_clock,
                      "Device of raw MIDI, such as /dev/snd/midiC1D0. From its Start on, beats "
                      "come from its clock instead of the music.");
  AddBeatOptions(*command, &options->beats);
  for (const char* refused : {"--beats", "--downbeat"}) Hide(*command, refused);
  command
      ->add_option("--ahead", options->ahead_s,
                   "Least seconds from the request of a pose to its beat.")
      ->check(NumberFrom(0.2, live::kMaxAheadSeconds))
      ->capture_default_str();
  command
      ->add_option(
          "--look-ahead", options->look_ahead_s,
          "Seconds ahead of the music that are final: no pose can be added or removed there.")
      ->check(NumberFrom(0, live::kMaxAheadSeconds))
      ->capture_default_str();
  command->add_option("-s,--seconds", options->seconds, "Most seconds of music.")
      ->check(AboveZero());
  AddSeed(*command, options->seed, "Same seed, same music, same poses: same dance. Default: 0.");
  AddManner(*command, options.get());
  AddControlOptions(*command, &options->controls);
  command->add_option("--fps", options->fps, "Frames a second. Default: the model's.")
      ->check(NumberFrom(kMinOutputFps, kMaxOutputFps));
  AddModel(*command, options->model);
  AddVmc(*command, options->vmc);
  command->add_option("-o,--out", options->out,
                      "FILE.npz, FILE.bvh or FILE.glb to write the dance to.");
  command->add_option("--report", options->report,
                      "JSON file to write the report to, for `choreo edit` and `render`.");
  options->server.AddInexactResume(*command);
  options->server.AddTo(*command);
  Hide(*command, "--deadline");
  command->callback([options, command] {
    CheckSongStart(*command, options->song);
    Run(*options);
  });
}

}  // namespace choreo::cli
