#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "client/authoring/keys/proposed_keys.h"
#include "client/authoring/music/music.h"
#include "client/cli/commands/commands.h"
#include "client/cli/options/authoring_options.h"
#include "client/cli/options/options.h"
#include "client/cli/options/output_file.h"
#include "model/audio/signal/mfcc.h"
#include "model/core/error.h"
#include "model/core/files/npy.h"
#include "model/core/grid.h"
#include "model/core/rounded.h"
#include "model/core/text/counted.h"

namespace choreo::cli {
namespace {

struct AnalyzeOptions {
  std::string song;
  bool json = false;
  std::string features;
  double song_start_s = 0;
  double seconds = std::numeric_limits<double>::infinity();
  authoring::BeatOptions beats;
  std::optional<int64_t> suggest_keys;
  std::optional<uint64_t> seed;
  std::string from, until;  // times (counts.h); or empty
};

/// The seconds from --from to --until, or to the end of the dance.
std::pair<double, double> PartOf(const authoring::Music& music, const AnalyzeOptions& options) {
  const authoring::Counts counts = authoring::CountsOf(music);
  const auto second = [&](const char* option, const std::string& time, double usual) {
    return time.empty() ? usual : authoring::ParseTime(time, option).In(counts, option);
  };
  const double from = second("--from", options.from, 0);
  const double said = second("--until", options.until, std::numeric_limits<double>::infinity());
  // The whole song is analysed, but a dance of --seconds has no keys after its end.
  const double until = std::min(said, options.seconds);
  RequireBefore(from, until, said <= options.seconds ? "--until" : "--seconds");
  if (from >= music.audio.seconds()) {
    throw InvalidArgument("--from", Rounded(from) + " s is after the song's end at " +
                                        Rounded(music.audio.seconds()) + " s");
  }
  return {from, until};
}

std::vector<authoring::ProposedKey> Propose(const authoring::Music& music,
                                            const AnalyzeOptions& options) {
  const auto [from, until] = PartOf(music, options);
  return authoring::ProposeKeys(music, {*options.suggest_keys, from, until, "--suggest-keys"},
                                options.seed.value_or(0));
}

/// The count of a beat, as authoring::Counts.
int64_t CountOf(const authoring::Counts& counts, size_t beat) {
  return static_cast<int64_t>(beat) - static_cast<int64_t>(counts.one) + 1;
}

/// In the order of Phrase.
constexpr const char* kBegins[] = {"a beat", "a bar", "an eight", "a passage"};
const char* Begins(const SuggestedKey& key) { return kBegins[static_cast<size_t>(key.begins)]; }

void PrintJson(const authoring::Music& music, const authoring::Counts& counts,
               const std::optional<std::vector<authoring::ProposedKey>>& keys) {
  nlohmann::ordered_json json;
  json["duration_s"] = music.audio.seconds();
  json["sample_rate"] = music.audio.sample_rate;
  json["tempo_bpm"] = music.track.tempo_bpm;
  json["beats"] = music.track.Seconds();
  json["beats_in_bar"] = music.track.beats_in_bar;
  json["downbeats"] = music.track.DownbeatSeconds();
  json["confidence"] = music.track.confidence;
  json["without_beats"] = nlohmann::ordered_json::array();
  for (const auto& [from, to] : WithoutBeats(music.track.Seconds(), music.audio.seconds()))
    json["without_beats"].push_back({{"from_s", from}, {"to_s", to}});
  json["passages"] = nlohmann::ordered_json::array();
  for (const Passage& passage : music.passages) {
    json["passages"].push_back(
        {{"from_s", passage.from}, {"to_s", passage.to}, {"like_s", passage.like}});
  }
  json["energies"] = music.energies;
  json["notes"] = music.audio.notes;
  if (keys) {
    json["suggested_keys"] = nlohmann::ordered_json::array();
    json["keyframes"] = nlohmann::ordered_json::array();
    for (const auto& [on, id, pose] : *keys) {
      json["suggested_keys"].push_back({{"time_s", on.time_s},
                                        {"beat", on.beat},
                                        {"count", CountOf(counts, on.beat)},
                                        {"strength", on.strength},
                                        {"begins", Begins(on)}});
      json["keyframes"].push_back({{"id", id}, {"time", on.time_s}, {"pose", pose}});
    }
  }
  std::cout << json.dump(2) << std::endl;
}

/// Prints the tempo and confidence of each stretch of one tempo.
void PrintStretches(const BeatTrack& track) {
  constexpr double kOther = 0.04;  // share by which another tempo differs
  constexpr size_t kMinBeats = 8;  // beats of a stretch
  const std::vector<double> beats = track.Seconds();
  std::vector<size_t> begins{0};
  for (size_t i = kMinBeats; i + kMinBeats < beats.size(); ++i) {
    const auto tempo = [&](size_t from, size_t to) {
      return TempoOf(std::span(beats).subspan(from, to - from));
    };
    const double before = tempo(std::max(begins.back(), i - kMinBeats), i + 1);
    const double after = tempo(i, i + kMinBeats + 1);
    if (std::abs(after / before - 1) > kOther && i - begins.back() >= kMinBeats)
      begins.push_back(i);
  }
  if (beats.size() < 2) return;
  for (size_t k = 0; k < begins.size(); ++k) {
    const size_t end = k + 1 < begins.size() ? begins[k + 1] : beats.size() - 1;
    double confidence = 0;
    for (size_t i = begins[k]; i < end; ++i) confidence += track.confidence[i];
    std::printf("%9.3f s  %.1f beats a minute, confidence %.2f\n", beats[begins[k]],
                TempoOf(std::span(beats).subspan(begins[k], end - begins[k] + 1)),
                confidence / static_cast<double>(end - begins[k]));
  }
}

/// `verb`: how the beats came about, "heard" or "given".
void PrintText(const authoring::Music& music, const authoring::Counts& counts, const char* verb,
               const std::optional<std::vector<authoring::ProposedKey>>& keys) {
  const BeatTrack& track = music.track;
  std::printf("%.2f s at %d Hz, %s; ", music.audio.seconds(), music.audio.sample_rate,
              Counted(music.audio.channels, "channel").c_str());
  if (track.frames.empty()) {
    std::printf("no beat %s", verb);
  } else {
    if (track.tempo_bpm > 0) std::printf("%.1f beats a minute, ", track.tempo_bpm);
    std::printf("%s, %s of %d", Counted(track.frames.size(), "beat").c_str(),
                Counted(track.DownbeatSeconds().size(), "bar").c_str(), track.beats_in_bar);
  }
  if (!counts.beats.empty()) std::printf(", count 1 at %.3f s", counts.beats[counts.one]);
  std::printf("\n");
  PrintStretches(track);
  if (!track.frames.empty()) {
    for (const auto& [from, to] : WithoutBeats(track.Seconds(), music.audio.seconds()))
      std::printf("%9.3f s  to %.3f s no beat %s here\n", from, to, verb);
  }
  for (const Passage& passage : music.passages)
    std::printf("%9.3f s  to %.3f s comes back as from %.3f s\n", passage.from, passage.to,
                passage.like);
  if (!keys) return;
  std::printf("key poses would sit well at\n");
  for (const auto& [on, id, pose] : *keys)
    std::printf("%9.3f s  count %lld, strength %.2f, begins %s: %s\n", on.time_s,
                static_cast<long long>(CountOf(counts, on.beat)), on.strength, Begins(on),
                pose.c_str());
}

void Run(const AnalyzeOptions& options) {
  RequireOutputs({{"--features", options.features}}, {{"song", options.song}});
  if (!options.features.empty()) RequireExtension("--features", options.features, {".npy"});
  authoring::Music music =
      authoring::ReadMusic(options.song, options.seconds, options.song_start_s, options.beats);
  if (!options.features.empty()) {
    const FeatureMatrix all = Mfcc(music.mono);
    const double kept = std::floor(options.seconds * kModelFps) + 1;
    const FeatureMatrix rows =
        all.topRows(static_cast<Eigen::Index>(std::min(kept, static_cast<double>(all.rows()))));
    WriteNpy(options.features, {{rows.rows(), rows.cols()},
                                std::vector<float>(rows.data(), rows.data() + rows.size())});
  }
  std::optional<std::vector<authoring::ProposedKey>> keys;
  if (options.suggest_keys) keys = Propose(music, options);
  const authoring::Counts counts = authoring::CountsOf(music);
  authoring::KeepFirst(options.seconds, &music);
  if (options.json)
    PrintJson(music, counts, keys);
  else
    PrintText(music, counts, options.beats.FindsThem() ? "heard" : "given", keys);
}

}  // namespace

void AddAnalyzeCommand(CLI::App& program) {
  auto options = std::make_shared<AnalyzeOptions>();
  CLI::App* command = program.add_subcommand(
      "analyze", "Show what is heard in a song: its tempo, beats and features.");
  command
      ->add_option("song", options->song,
                   "WAV, FLAC, Ogg or MP3 file, or - for standard input; with ffmpeg installed, "
                   "any file that it reads.")
      ->required()
      ->check(SongFile());
  command
      ->add_option("--song-start", options->song_start_s,
                   "Second of the song at which to begin; times count from there.")
      ->check(TimeInSeconds());
  command
      ->add_option("--seconds", options->seconds,
                   "Seconds of the song to show, as a dance of this length hears it. Keys are "
                   "suggested within them.")
      ->check(AboveZero());
  AddBeatOptions(*command, &options->beats);
  command->add_flag(
      "--json", options->json,
      "Print JSON: duration_s, sample_rate, tempo_bpm, beats (seconds), "
      "beats_in_bar, downbeats (seconds), confidence (of each beat, 0 to 1: how much "
      "more begins on the beats around it than elsewhere), without_beats (where none "
      "is heard or given), passages (that return), energies (of each half second), notes and, "
      "with --suggest-keys, suggested_keys and keyframes (a key file).");
  command->add_option("--features", options->features,
                      "FILE.npy to write the MFCC rows to, which the papers' models hear: [rows, "
                      "40], 30 a second.");
  CLI::Option* suggest =
      command
          ->add_option(
              "--suggest-keys", options->suggest_keys,
              "Number of key poses to suggest: beats from second 1 on where passages, eights and "
              "bars begin, with a pose of the library for each, the same where a passage returns. "
              "With --json they are a file for `choreo dance --keyframes`.")
          ->check(WholeNumberFrom(1, 1'000'000));
  command
      ->add_option(
          "--from", options->from,
          "Second, or count (9c), from which keys are suggested. The first downbeat is 1c.")
      ->check(TimeOrCount())
      ->needs(suggest);
  command
      ->add_option("--until", options->until, "Second, or count, up to which keys are suggested.")
      ->check(TimeOrCount())
      ->needs(suggest);
  AddSeed(*command, options->seed, "Another seed suggests other poses. Default: 0.")
      ->needs(suggest);
  command->callback([options] { Run(*options); });
}

}  // namespace choreo::cli
