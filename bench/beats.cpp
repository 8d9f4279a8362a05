// Measures beat tracking, without a shift between beats and songs: the F measure at 70 ms, from the
// first second and from the tenth, for whole songs (FindBeats) and for predictions, either of a
// live dance with transitions of 2 s (DanceMusic) or of `choreo live` (BeatEar). Songs have a tempo
// map (SONG.beats beside SONG.ogg, as `choreo --beats` reads it), or are synthetic, at every tempo
// and metre, with known downbeats (maps without counts: each fourth beat). An octave error is named
// and counts half.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/beat_patterns.h"
#include "client/authoring/music/beat_file.h"
#include "client/live/beat_ear.h"
#include "client/live/live_dance.h"
#include "client/live/sound.h"
#include "model/audio/beats/beat_hint.h"
#include "model/audio/beats/beats.h"
#include "model/audio/decode/decode.h"
#include "model/audio/music/made_song.h"
#include "model/core/error.h"
#include "model/core/grid.h"
#include "model/core/limits.h"
#include "model/dance/delivery/beat_schedule.h"
#include "model/dance/input/dance_music.h"
#include "model/metrics/song_beats.h"

namespace choreo::bench {
namespace {

constexpr double kLate = 10;  // seconds

std::vector<double> EverySecond(const std::vector<double>& beats, size_t first) {
  std::vector<double> half;
  for (size_t i = first; i < beats.size(); i += 2) half.push_back(beats[i]);
  return half;
}

/// The octave at which the beats fit, or "".
std::string Octave(const std::vector<double>& found, const std::vector<double>& map) {
  constexpr double kFits = 0.8;
  const double plain = BeatFMeasure(found, map);
  for (const size_t first : {0, 1}) {
    if (BeatFMeasure(found, EverySecond(map, first)) > std::max(kFits, plain)) return "half";
    if (BeatFMeasure(EverySecond(found, first), map) > std::max(kFits, plain)) return "double";
  }
  return "";
}

std::vector<double> HearLive(const std::vector<float>& mono) {
  AudioFeed feed(kModelSampleRate, 1, 0);
  feed.Push(mono, 0, [] {});
  const ModelInfo model;
  DanceMusic music(model, {}, kDefaultDynamics, &feed);
  BeatSchedule schedule(30, &feed, std::nullopt);
  for (int64_t from = 0; from + kTypicalFrames <= feed.ready(); from += kTypicalFrames) {
    schedule.StartTransition(music.PlanFor({from, from + kTypicalFrames}, from).Hear().beats, from);
    for (int64_t frame = from; frame < from + kTypicalFrames; ++frame) schedule.TakeAt(frame);
  }
  return schedule.reported();
}

/// Whether a server would not report a beat, because the music has fallen silent.
bool IsInSilence(const std::vector<Onset>& onsets, double beat, double step) {
  const auto heard = static_cast<size_t>(std::llround(beat * kOnsetRate)) + 1;
  return EndInPause(std::span(onsets).first(std::min(heard, onsets.size())), step);
}

/// The beats that `choreo live` sends to its server, as soon as they are found.
std::vector<double> HearByClient(const std::vector<float>& mono) {
  const double settled_s = live::LiveOptions().look_ahead_s;
  live::BeatEar ear;
  std::vector<double> predicted;
  const auto piece = static_cast<size_t>(live::kPieceSeconds * kModelSampleRate);
  for (size_t at = 0; at < mono.size(); at += piece) {
    std::vector<double> ahead =
        ear.Hear(std::span(mono).subspan(at, std::min(piece, mono.size() - at))).beats;
    ear.Wait();
    const double settled = static_cast<double>(at + piece) / kModelSampleRate + settled_s;
    std::erase_if(ahead, [settled](double beat) { return beat < settled; });
    if (ahead.empty()) continue;
    const double half = ahead.size() > 1 ? (ahead[1] - ahead[0]) / 2 : 0;
    std::erase_if(predicted, [&](double beat) { return beat > ahead.front() - half; });
    predicted.insert(predicted.end(), ahead.begin(), ahead.end());
  }
  const std::vector<Onset> onsets = FindOnsets(mono);
  const double period = 60 / TempoOf(predicted);
  std::erase_if(predicted, [&](double beat) { return IsInSilence(onsets, beat, period); });
  return predicted;
}

struct Judged {
  std::string name;
  std::vector<float> mono{};
  std::vector<double> beats{}, downbeats{};  // downbeats: empty if unknown
  std::optional<double> librosa{};           // librosa's F from the first second
  std::vector<SongPlan::Span> spans{};       // judged separately: before and after a tempo step
  std::vector<SongPlan::Span> silent{};
};

/// Beats in silence that begin more than a period after it.
int BeatsInSilence(const Judged& song, const std::vector<double>& beats) {
  constexpr double kNear = 0.07;  // a beat may precede its sound by this much
  const double period = 60 / TempoOf(song.beats);
  return static_cast<int>(std::ranges::count_if(beats, [&](double beat) {
    return std::ranges::any_of(song.silent, [&](const SongPlan::Span& span) {
      return beat > span.begin + period + kNear && beat < span.end - kNear;
    });
  }));
}

void PrintHead() {
  std::printf("%-34s %6s %6s %6s %6s %6s %6s %6s %6s %6s %6s  %s\n", "song", "F", "from10",
              "librosa", "down", "bpm", "off %", "live", "live10", "client", "cli.10", "");
}

struct Scores {
  double octaves_half;       // F of the whole song; half of it for an octave error
  double file, pcm, client;  // F from the first second
  double pcm_late;           // F from the tenth
  double downbeats;
  bool is_octave;
};

Scores Judge(const Judged& song) {
  const BeatTrack track = FindBeats(song.mono);
  const std::vector<double> found = track.Seconds();
  const std::vector<double> live = HearLive(song.mono);
  const std::string octave = Octave(found, song.beats);
  const double f = octave.empty() ? BeatFMeasure(found, song.beats) : 0.5;
  const auto number = [](std::optional<double> value) {
    char text[16] = "     –";
    if (value) std::snprintf(text, sizeof text, "%6.2f", *value);
    return std::string(text);
  };
  std::optional<double> down;
  if (!song.downbeats.empty()) down = BeatFMeasure(track.DownbeatSeconds(), song.downbeats);
  const double tempo = TempoOf(song.beats);
  const std::vector<double> client = HearByClient(song.mono);
  std::printf("%-34s %6.2f %6.2f %s %s %6.1f %6.1f %6.2f %6.2f %6.2f %6.2f  %s", song.name.c_str(),
              f, BeatFMeasure(found, song.beats, kLate), number(song.librosa).c_str(),
              number(down).c_str(), tempo, 100 * (track.tempo_bpm / tempo - 1),
              BeatFMeasure(live, song.beats), BeatFMeasure(live, song.beats, kLate),
              BeatFMeasure(client, song.beats), BeatFMeasure(client, song.beats, kLate),
              octave.c_str());
  for (const SongPlan::Span& span : song.spans)
    std::printf(" %.0f-%.0f s: %.2f", span.begin, span.end,
                BeatFMeasure(found, song.beats, span.begin, span.end));
  if (!song.silent.empty()) {
    std::printf(" beats in silence: %d, live %d, client %d", BeatsInSilence(song, found),
                BeatsInSilence(song, live), BeatsInSilence(song, client));
  }
  std::printf("\n");
  std::fflush(stdout);
  return {f,
          BeatFMeasure(found, song.beats),
          BeatFMeasure(live, song.beats),
          BeatFMeasure(client, song.beats),
          BeatFMeasure(live, song.beats, kLate),
          down.value_or(0),
          !octave.empty()};
}

double MeanOf(const std::vector<Scores>& songs, double Scores::*score) {
  double sum = 0;
  for (const Scores& song : songs) sum += song.*score;
  return sum / static_cast<double>(songs.size());
}

/// Prints the figures of docs/beats.md that are of many songs.
void PrintSummary(const std::vector<Scores>& all,
                  const std::map<int, std::vector<Scores>>& by_tempo) {
  constexpr double kWanted = 0.95, kFound = 0.9;
  int steady = 0, reached = 0, octaves = 0;
  std::vector<Scores> found[3];  // steady songs of slow, medium and fast tempi
  for (const auto& [bpm, songs] : by_tempo) {
    for (const Scores& song : songs) {
      ++steady;
      reached += song.octaves_half >= kWanted;
      octaves += song.is_octave;
      if (song.file > kFound) found[(bpm > 80) + (bpm > 150)].push_back(song);
    }
  }
  std::printf(
      "\nsteady tempo: %d of %d songs have an F of at least %.2f, %d double or half beats\n",
      reached, steady, kWanted, octaves);
  std::printf("all songs: mean F of downbeats %.2f, of PCM from second 10 %.2f\n",
              MeanOf(all, &Scores::downbeats), MeanOf(all, &Scores::pcm_late));
  const char* const tempi[] = {"50 to 80", "90 to 150", "160 to 200"};
  for (size_t i = 0; i < std::size(tempi); ++i) {
    const double file = MeanOf(found[i], &Scores::file);
    std::printf("%s bpm, steady songs with F over %.1f: PCM ÷ file %.2f, client ÷ file %.2f\n",
                tempi[i], kFound, MeanOf(found[i], &Scores::pcm) / file,
                MeanOf(found[i], &Scores::client) / file);
  }
}

/// Prints the accuracy of predictions relative to the accuracy in whole songs.
void PrintLiveShare(const std::map<int, std::vector<Scores>>& by_tempo) {
  std::printf("\nsteady songs: mean F in files, as PCM and with `choreo live`, and their shares\n");
  for (const auto& [bpm, songs] : by_tempo) {
    Scores sum{};
    for (const Scores& song : songs) {
      sum.file += song.file;
      sum.pcm += song.pcm;
      sum.client += song.client;
    }
    const auto count = static_cast<double>(songs.size());
    std::printf("%3d bpm  file %.2f  PCM %.2f  client %.2f  PCM ÷ file %.2f  client ÷ file %.2f\n",
                bpm, sum.file / count, sum.pcm / count, sum.client / count, sum.pcm / sum.file,
                sum.client / sum.file);
  }
}

void JudgeFiles(const std::vector<std::string>& songs, const std::string& librosa) {
  const nlohmann::json golden = nlohmann::json::parse(std::ifstream(librosa));
  for (const std::string& path : songs) {
    Judged song;
    song.name = std::filesystem::path(path).stem();
    const auto map = std::filesystem::path(path).replace_extension(".beats");
    if (!std::filesystem::exists(map)) {
      std::printf("%-34s not judged: its beats are not known, %s is missing\n", song.name.c_str(),
                  map.filename().c_str());
      continue;
    }
    song.mono = ToModelRate(DecodeAudioFile(path));
    bool counted = false;
    for (const auto& [second, count] : authoring::ReadBeatFile(map)) {
      counted = counted || count > 0;
      song.beats.push_back(second);
      if (count == 1) song.downbeats.push_back(second);
    }
    // Without counts as if the map began with a bar of four.
    for (size_t i = 0; !counted && i < song.beats.size(); i += kDefaultBar)
      song.downbeats.push_back(song.beats[i]);
    if (golden.contains(song.name))
      song.librosa = BeatFMeasure(golden[song.name].get<std::vector<double>>(), song.beats);
    Judge(song);
  }
}

/// Judges one synthetic song of each kind and tempo.
void JudgeMade(uint64_t seed) {
  std::map<std::string, std::vector<double>> by_kind;
  std::map<int, std::vector<Scores>> by_tempo;
  std::vector<Scores> all;
  const auto judge = [&](const std::string& kind, const std::string& name, SongPlan plan,
                         std::vector<SongPlan::Span> spans = {}) {
    plan.seed = seed++;
    MadeSong made = MakeSong(plan);
    const Scores scores = Judge({.name = kind + " " + name + " " + made.groove,
                                 .mono = std::move(made.mono),
                                 .beats = std::move(made.beats),
                                 .downbeats = std::move(made.downbeats),
                                 .spans = std::move(spans),
                                 .silent = plan.silent});
    by_kind[kind].push_back(scores.octaves_half);
    all.push_back(scores);
    if (plan.tempo.size() == 1 && plan.without_drums.empty() && plan.silent.empty())
      by_tempo[static_cast<int>(plan.tempo.front().bpm)].push_back(scores);
  };
  for (double bpm = 50; bpm <= 200; bpm += 10) {
    const std::string name = std::to_string(static_cast<int>(bpm));
    judge("4/4", name, {.tempo = {{0, bpm}}});
    judge("3/4", name, {.tempo = {{0, bpm}}, .meter = Meter::kThree});
    if (bpm >= 60) judge("swing", name, {.tempo = {{0, bpm}}, .swing = true});
    if (bpm <= 110) judge("6/8", name, {.tempo = {{0, bpm}}, .meter = Meter::kSix});
  }
  struct Change {
    double from, to;
  };
  for (const auto& [from, to] : {Change{120, 80}, {90, 140}, {100, 125}, {170, 130}, {150, 180}})
    judge("step", std::to_string(int(from)) + " to " + std::to_string(int(to)),
          {.seconds = 60, .tempo = {{0, from}, {30, from}, {30, to}}}, {{0, 30}, {34, 60}});
  for (const auto& [from, to] : {Change{90, 140}, {140, 100}, {70, 90}, {120, 180}})
    judge("ramp", std::to_string(int(from)) + " to " + std::to_string(int(to)),
          {.seconds = 60, .tempo = {{0, from}, {10, from}, {50, to}}});
  for (const double bpm : {90.0, 128.0, 160.0}) {
    const std::string name = std::to_string(static_cast<int>(bpm));
    judge("break", name, {.seconds = 60, .tempo = {{0, bpm}}, .without_drums = {{20, 32}}});
    judge("intro", name, {.seconds = 60, .tempo = {{0, bpm}}, .without_drums = {{0, 14}}});
    judge("pause", name, {.seconds = 60, .tempo = {{0, bpm}}, .silent = {{25, 33}}});
  }
  for (const auto& [kind, values] : by_kind) {
    double sum = 0;
    for (const double value : values) sum += value;
    std::printf("%-8s mean F %.3f, least %.2f, of %zu\n", kind.c_str(),
                sum / static_cast<double>(values.size()), *std::ranges::min_element(values),
                values.size());
  }
  PrintLiveShare(by_tempo);
  PrintSummary(all, by_tempo);
}

}  // namespace
}  // namespace choreo::bench

int main(int argc, char** argv) {
  using namespace choreo;
  CLI::App program("Compares beats that are found, and heard live, with those that are known.");
  std::vector<std::string> songs;
  std::string librosa = CHOREO_SOURCE_DIR "/bench/librosa.json";
  std::optional<uint64_t> made, patterns;
  program.add_option("songs", songs, "Songs, each with its tempo map SONG.beats beside it.")
      ->check(CLI::ExistingFile);
  program
      .add_option("--librosa", librosa,
                  "JSON of what librosa.beat.beat_track found: {\"SONG\": [seconds]}.")
      ->check(CLI::ExistingFile)
      ->capture_default_str();
  program.add_option("--made", made,
                     "First seed of made songs. Development had those below 1000000.");
  program.add_option("--patterns", patterns,
                     "First seed of made songs whose mean onsets are printed, as "
                     "model/audio/beats/bar_patterns.cpp has them.");
  CLI11_PARSE(program, argc, argv);
  if (patterns) {
    bench::PrintBarPatterns(*patterns, 60);
    return 0;
  }
  try {
    bench::PrintHead();
    bench::JudgeFiles(songs, librosa);
    if (made) bench::JudgeMade(*made);
  } catch (const Error& error) {
    std::fprintf(stderr, "beats_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
