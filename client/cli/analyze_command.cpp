#include <cmath>
#include <cstdio>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "client/cli/commands.h"
#include "client/cli/music.h"
#include "client/cli/options.h"
#include "client/cli/output_file.h"
#include "model/audio/mfcc.h"
#include "model/audio/suggest_keys.h"
#include "model/core/error.h"
#include "model/core/npy.h"
#include "model/core/rounded.h"

namespace choreo::cli {
namespace {

struct AnalyzeOptions {
  std::string song;
  bool json = false;
  std::string features;
  BeatOptions beats;
  std::optional<int64_t> suggest_keys;
  double from_s = 0;
  double until_s = std::numeric_limits<double>::infinity();
};

void CheckPart(const Music& music, const AnalyzeOptions& options) {
  const auto seconds = [](double value) { return InFull(value) + " s"; };
  if (options.from_s >= options.until_s) {
    throw InvalidArgument(
        "--from", seconds(options.from_s) + " is not before --until, " + seconds(options.until_s));
  }
  if (options.from_s >= music.audio.seconds()) {
    throw InvalidArgument("--from", seconds(options.from_s) + " lies behind the song's end at " +
                                        Rounded(music.audio.seconds()) + " s");
  }
}

/// Suggestions among the beats from one second to another; they count the beats of the song.
std::vector<SuggestedKey> Suggest(const Music& music, const AnalyzeOptions& options) {
  CheckPart(music, options);
  const std::vector<double> beats = music.track.Seconds();
  BeatTrack part;
  size_t before = 0;
  for (size_t i = 0; i < beats.size(); ++i) {
    if (beats[i] < options.from_s) {
      ++before;
    } else if (beats[i] <= options.until_s) {
      part.frames.push_back(music.track.frames[i]);
    }
  }
  std::vector<SuggestedKey> keys =
      SuggestKeys(part, music.onset_strength, *options.suggest_keys, "--suggest-keys");
  for (SuggestedKey& key : keys) key.beat += before;
  return keys;
}

void PrintJson(const Music& music, const std::optional<std::vector<SuggestedKey>>& keys) {
  nlohmann::ordered_json json;
  json["duration_s"] = music.audio.seconds();
  json["sample_rate"] = music.audio.sample_rate;
  json["tempo_bpm"] = music.track.tempo_bpm;
  json["beats"] = music.track.Seconds();
  json["beats_in_bar"] = music.track.beats_in_bar;
  json["downbeats"] = music.track.DownbeatSeconds();
  json["confidence"] = music.track.confidence;
  json["passages"] = nlohmann::ordered_json::array();
  for (const Passage& passage : music.passages) {
    json["passages"].push_back(
        {{"from_s", passage.from}, {"to_s", passage.to}, {"like_s", passage.like}});
  }
  json["notes"] = music.audio.notes;
  if (keys) {
    json["suggested_keys"] = nlohmann::ordered_json::array();
    for (const SuggestedKey& key : *keys) {
      json["suggested_keys"].push_back(
          {{"time_s", key.time_s}, {"beat", key.beat}, {"strength", key.strength}});
    }
  }
  std::cout << json.dump(2) << std::endl;
}

/// Where the tempo changes, and how sure each stretch of a tempo is.
void PrintStretches(const BeatTrack& track) {
  constexpr double kOther = 0.04;  // share by which a tempo is another one
  constexpr size_t kFewest = 8;    // beats of a stretch
  const std::vector<double> beats = track.Seconds();
  std::vector<size_t> begins{0};
  for (size_t i = kFewest; i + kFewest < beats.size(); ++i) {
    const auto tempo = [&](size_t from, size_t to) {
      return TempoOf(std::span(beats).subspan(from, to - from));
    };
    const double before = tempo(std::max(begins.back(), i - kFewest), i + 1);
    const double behind = tempo(i, i + kFewest + 1);
    if (std::abs(behind / before - 1) > kOther && i - begins.back() >= kFewest) begins.push_back(i);
  }
  if (beats.size() < 2 || begins.size() < 2) return;
  for (size_t k = 0; k < begins.size(); ++k) {
    const size_t end = k + 1 < begins.size() ? begins[k + 1] : beats.size() - 1;
    double confidence = 0;
    for (size_t i = begins[k]; i < end; ++i) confidence += track.confidence[i];
    std::printf("%9.3f s  %.1f beats a minute, confidence %.2f\n", beats[begins[k]],
                TempoOf(std::span(beats).subspan(begins[k], end - begins[k] + 1)),
                confidence / static_cast<double>(end - begins[k]));
  }
}

void PrintText(const Music& music, const std::optional<std::vector<SuggestedKey>>& keys) {
  std::printf("%.2f s at %d Hz, %d channels; %.1f beats a minute, %zu beats, %zu bars of %d\n",
              music.audio.seconds(), music.audio.sample_rate, music.audio.channels,
              music.track.tempo_bpm, music.track.frames.size(),
              music.track.DownbeatSeconds().size(), music.track.beats_in_bar);
  PrintStretches(music.track);
  for (const Passage& passage : music.passages)
    std::printf("%9.3f s  to %.3f s comes back as from %.3f s\n", passage.from, passage.to,
                passage.like);
  if (!keys) return;
  std::printf("key poses would sit well at\n");
  for (const SuggestedKey& key : *keys)
    std::printf("%9.3f s  beat %zu, strength %.2f\n", key.time_s, key.beat, key.strength);
}

void Run(const AnalyzeOptions& options) {
  RequireOutputs({{"--features", options.features}}, {{"song", options.song}});
  if (!options.features.empty()) RequireExtension("--features", options.features, ".npy");
  const Music music =
      ReadMusic(options.song, std::numeric_limits<double>::infinity(), 0, options.beats);
  if (!options.features.empty()) {
    const FeatureMatrix rows = Mfcc(music.mono);
    WriteNpy(options.features, {{rows.rows(), rows.cols()},
                                std::vector<float>(rows.data(), rows.data() + rows.size())});
  }
  std::optional<std::vector<SuggestedKey>> keys;
  if (options.suggest_keys) keys = Suggest(music, options);
  options.json ? PrintJson(music, keys) : PrintText(music, keys);
}

}  // namespace

void AddAnalyzeCommand(CLI::App& program) {
  auto options = std::make_shared<AnalyzeOptions>();
  CLI::App* command = program.add_subcommand(
      "analyze", "Show what is heard in a song: its tempo, beats and features.");
  command
      ->add_option("song", options->song,
                   "WAV, FLAC, Ogg or MP3 file, or - for standard input; with ffmpeg installed, "
                   "whatever that reads.")
      ->required()
      ->check(SongFile());
  AddBeatOptions(*command, &options->beats);
  command->add_flag(
      "--json", options->json,
      "Print duration_s, sample_rate, tempo_bpm, beats (seconds), beats_in_bar, downbeats "
      "(seconds), confidence (of each beat, 0 to 1), passages (that come back), notes and "
      "suggested_keys as JSON.");
  command->add_option("--features", options->features,
                      "FILE.npy for the MFCC rows that the models hear: [rows, 40], 30 a second.");
  CLI::Option* suggest =
      command
          ->add_option(
              "--suggest-keys", options->suggest_keys,
              "Name so many beats on which key poses would sit well: strong ones, spread over "
              "the song.")
          ->check(WholeNumberFrom(1, 1'000'000));
  command->add_option("--from", options->from_s, "Second from which on keys are suggested.")
      ->check(TimeInSeconds())
      ->needs(suggest);
  command->add_option("--until", options->until_s, "Second up to which keys are suggested.")
      ->check(TimeInSeconds())
      ->needs(suggest);
  command->callback([options] { Run(*options); });
}

}  // namespace choreo::cli
