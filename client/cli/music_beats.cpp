#include "client/cli/music_beats.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "client/cli/options.h"
#include "model/audio/format.h"
#include "model/core/error.h"
#include "model/core/rounded.h"

namespace choreo::cli {
namespace {

constexpr double kFramesPerSecond = static_cast<double>(kModelSampleRate) / kOnsetHop;
constexpr size_t kMostBeats = size_t{20} * kMaxAudioSeconds;  // as a dance takes
constexpr double kTempoSlack = 1.06;                          // either way: a semitone
constexpr int kUsualBar = 4;

/// Counts from beat `first` on, and backwards before it.
void CountFrom(size_t first, BeatTrack* track) {
  const int bar = track->beats_in_bar > 0 ? track->beats_in_bar : kUsualBar;
  track->beats_in_bar = bar;
  track->in_bar.resize(track->frames.size());
  for (size_t i = 0; i < track->frames.size(); ++i) {
    const int64_t since = static_cast<int64_t>(i) - static_cast<int64_t>(first);
    track->in_bar[i] = static_cast<int>((since % bar + bar) % bar);
  }
}

size_t FirstDownbeat(const BeatTrack& track) {
  const auto first = std::ranges::find(track.in_bar, 0);
  return first == track.in_bar.end() ? 0 : static_cast<size_t>(first - track.in_bar.begin());
}

/// Lines of a second, and, where it is known, the count in the bar, from 1 on.
BeatTrack ReadBeats(const std::string& path, double start) {
  std::ifstream file(path);
  if (!file) throw Error(ErrorCode::kNotFound, "--beats", path + " cannot be opened as a file");
  BeatTrack track;
  std::string line;
  double last = -1;
  for (int number = 1; std::getline(file, line); ++number) {
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string field = path + ":" + std::to_string(number);
    std::istringstream words(line);
    double second = 0;
    std::string rest;
    if (!(words >> second) || !std::isfinite(second) || second < 0)
      throw InvalidArgument(field,
                            "\"" + line + "\" does not begin with a second of the song, 0 or more");
    if (second <= last) {
      throw InvalidArgument(
          field,
          InFull(second) + " s does not lie behind the beat before it, at " + InFull(last) + " s");
    }
    last = second;
    int count = 0;
    if (words >> rest) {
      count = std::atoi(rest.c_str());
      if (count < 1 || count > 16)
        throw InvalidArgument(field, "\"" + rest + "\" is no count in a bar, must be 1 to 16");
    }
    if (track.frames.size() >= kMostBeats)
      throw InvalidArgument(field, "is beat " + std::to_string(kMostBeats + 1) + ", the limit is " +
                                       std::to_string(kMostBeats));
    if (second < start) continue;
    track.frames.push_back(std::llround((second - start) * kFramesPerSecond));
    track.in_bar.push_back(count - 1);
    track.confidence.push_back(1);
    track.beats_in_bar = std::max(track.beats_in_bar, count);
  }
  if (track.frames.empty())
    throw InvalidArgument("--beats", path + " has no beat behind second " + InFull(start));
  if (track.beats_in_bar == 0) CountFrom(0, &track);
  return track;
}

/// Every second beat is left out, those that the downbeats are among stay.
void Halve(BeatTrack* track) {
  BeatTrack half{.beats_in_bar = track->beats_in_bar};
  const size_t first = FirstDownbeat(*track);
  for (size_t i = first % 2; i < track->frames.size(); i += 2) {
    half.frames.push_back(track->frames[i]);
    half.confidence.push_back(track->confidence[i]);
  }
  CountFrom(first / 2, &half);
  *track = std::move(half);
}

void Double(BeatTrack* track) {
  BeatTrack twice{.beats_in_bar = track->beats_in_bar};
  for (size_t i = 0; i < track->frames.size(); ++i) {
    twice.frames.push_back(track->frames[i]);
    twice.confidence.push_back(track->confidence[i]);
    if (i + 1 == track->frames.size()) break;
    twice.frames.push_back((track->frames[i] + track->frames[i + 1]) / 2);
    twice.confidence.push_back(track->confidence[i]);
  }
  CountFrom(2 * FirstDownbeat(*track), &twice);
  *track = std::move(twice);
}

TempoLimits LimitsOf(const BeatOptions& options) {
  TempoLimits limits;
  if (!options.tempo_bpm) return limits;
  limits.slowest_bpm = std::max(limits.slowest_bpm, *options.tempo_bpm / kTempoSlack);
  limits.fastest_bpm = std::min(limits.fastest_bpm, *options.tempo_bpm * kTempoSlack);
  return limits;
}

}  // namespace

void AddBeatOptions(CLI::App& command, BeatOptions* options) {
  CLI::Option* beats = command.add_option(
      "--beats", options->beats,
      "FILE of the song's beats, in place of those that are found: a line a beat, its second and, "
      "where it is known, its count in the bar, 1 for a downbeat. auto (default): found.");
  command
      .add_option("--tempo", options->tempo_bpm,
                  "Beats a minute, about: within 6 % of it they are looked for.")
      ->check(CLI::Range(50.0, 200.0))
      ->excludes(beats);
  CLI::Option* half =
      command.add_flag("--half-time", options->half_time, "Every second beat counts alone.");
  command
      .add_flag("--double-time", options->double_time, "Half way between two beats is one, too.")
      ->excludes(half);
  command
      .add_option("--downbeat", options->downbeat_s,
                  "A second of the song: the beat nearest to it is the first of its bar.")
      ->check(TimeInSeconds());
}

BeatTrack BeatsAsAsked(std::span<const Onset> onsets, double start, const BeatOptions& options) {
  BeatTrack track = options.beats == "auto" ? TrackBeats(onsets, LimitsOf(options))
                                            : ReadBeats(options.beats, start);
  // What lies behind the song's end is no beat of it.
  while (!track.frames.empty() && track.frames.back() > std::ssize(onsets)) {
    track.frames.pop_back();
    track.in_bar.pop_back();
    track.confidence.pop_back();
  }
  if (track.frames.empty()) return track;
  if (options.half_time) Halve(&track);
  if (options.double_time) Double(&track);
  if (options.downbeat_s) {
    const auto wanted = std::llround((*options.downbeat_s - start) * kFramesPerSecond);
    const auto nearest = std::ranges::min_element(
        track.frames, {}, [wanted](int64_t frame) { return std::abs(frame - wanted); });
    CountFrom(static_cast<size_t>(nearest - track.frames.begin()), &track);
  }
  track.tempo_bpm = TempoOf(track.Seconds());
  return track;
}

}  // namespace choreo::cli
