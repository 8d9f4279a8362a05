#include "client/authoring/music/beat_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "client/authoring/music/beat_file.h"
#include "client/authoring/notes/notes.h"
#include "model/audio/beats/same_tempo.h"
#include "model/audio/signal/format.h"
#include "model/core/error.h"
#include "model/core/rounded.h"
#include "model/core/text/field.h"

namespace choreo::authoring {
namespace {

/// Extends the count in the bar from counted beats to the others.
void CountOthers(BeatTrack* track) {
  const auto first = std::ranges::find(track->in_bar, 0);
  // A bar lasts from one to the next if only downbeats are known.
  if (track->beats_in_bar == 1) {
    const auto second = std::find(first + 1, track->in_bar.end(), 0);
    track->beats_in_bar =
        second != track->in_bar.end() ? static_cast<int>(second - first) : kDefaultBar;
  }
  CountOn(track);
}

BeatTrack ReadBeats(const std::string& path, double start) {
  BeatTrack track;
  bool counted = true;
  for (const WrittenBeat& beat : ReadBeatFile(path, start)) {
    track.frames.push_back(std::llround((beat.second - start) * kOnsetRate));
    track.in_bar.push_back(beat.count - 1);
    track.confidence.push_back(1);
    track.beats_in_bar = std::max(track.beats_in_bar, beat.count);
    counted = counted && beat.count > 0;
  }
  RequireLeft(path, !track.frames.empty(), start);
  if (!counted) CountOthers(&track);
  return track;
}

/// Removes beats after a frame, the song's end. Returns their number.
int64_t DropBehind(int64_t end, BeatTrack* track) {
  const auto first = std::ranges::upper_bound(track->frames, end) - track->frames.begin();
  const int64_t behind = std::ssize(track->frames) - first;
  track->frames.resize(static_cast<size_t>(first));
  track->in_bar.resize(track->frames.size());
  track->confidence.resize(track->frames.size());
  return behind;
}

/// Whether eight beats somewhere have this tempo, or one that listeners confuse with it.
bool HasTempo(std::span<const double> beats, double bpm) {
  constexpr size_t kBeats = 8;
  for (size_t i = 0; i + kBeats < beats.size(); ++i) {
    const double tempo = TempoOf(beats.subspan(i, kBeats + 1));
    for (const double times : {1.0, 2.0, 3.0, 1.5}) {
      if (IsSameTempo(tempo * times, bpm) || IsSameTempo(tempo / times, bpm)) return true;
    }
  }
  return false;
}

/// Warns if nothing in the music has the requested tempo, or if no beats have it. `taken_bpm`: 0 if
/// there are none.
void WarnOfTempo(std::span<const Onset> onsets, double asked_bpm, double found_bpm,
                 double taken_bpm) {
  std::string warning;
  const auto whole = [](double bpm) { return std::to_string(std::lround(bpm)); };
  const BeatTrack heard = TrackBeats(onsets);
  if (heard.tempo_bpm > 0 && !HasTempo(heard.Seconds(), asked_bpm)) {
    warning = " is far from the tempo heard, " + whole(heard.tempo_bpm) + " beats a minute";
  }
  const bool followed = std::ranges::any_of(std::array{0.5, 1.0, 2.0}, [&](double times) {
    return IsSameTempo(found_bpm, times * asked_bpm);
  });
  if (taken_bpm == 0)
    warning += warning.empty() ? " finds no beat" : "; it finds no beat";
  else if (!followed)
    warning += (warning.empty() ? " is not found; beats are taken at " : "; they are taken at ") +
               whole(taken_bpm) + " a minute";
  if (!warning.empty()) Note("warning: --tempo " + InFull(asked_bpm) + warning);
}

/// Warns of options for which there are too few beats: half and double time need two of them, a
/// downbeat one.
void WarnOfFew(const BeatOptions& options, size_t beats) {
  const std::string why = beats == 0 ? "no beat is heard" : "there is only one beat";
  for (const auto& [given, option] :
       {std::pair(options.hint.half_time, std::string("--half-time")),
        {options.hint.double_time, "--double-time"},
        {beats == 0 && options.downbeat_s, "--downbeat " + InFull(options.downbeat_s.value_or(0))}})
    if (given && beats < 2) Note("warning: " + option + " changes nothing: " + why);
}

/// Beats from a frame before the song's part to its first beat, at the tempo of its first beats.
int64_t BeatsSince(const BeatTrack& track, int64_t frame) {
  constexpr size_t kBeats = 8;
  const std::vector<double> seconds = track.Seconds();
  const double bpm = TempoOf(std::span(seconds).first(std::min(seconds.size(), kBeats + 1)));
  const auto before = static_cast<double>(track.frames.front() - frame);
  return std::llround(before / kOnsetRate * bpm / 60);
}

/// Warns of a downbeat, in seconds of the song, where there is no beat.
void WarnOfDownbeat(double downbeat_s, double nearest_s, double tempo_bpm) {
  if (tempo_bpm <= 0 || std::abs(downbeat_s - nearest_s) <= 60 / tempo_bpm) return;
  Note("warning: --downbeat " + InFull(downbeat_s) +
       " is more than a beat away from any beat; the nearest, at " + Rounded(nearest_s) +
       " s, begins a bar");
}

void Change(const BeatOptions& options, double start, BeatTrack* track) {
  Follow(options.hint, track);
  if (!options.downbeat_s) return;
  const auto wanted = std::llround((*options.downbeat_s - start) * kOnsetRate);
  if (wanted < 0) {
    CountFrom(0, BeatsSince(*track, wanted), track);
  } else {
    const int64_t nearest = NearestBeat(*track, wanted);
    const std::vector<double> seconds = track->Seconds();
    WarnOfDownbeat(*options.downbeat_s, start + seconds[static_cast<size_t>(nearest)],
                   TempoOf(seconds));
    CountFrom(nearest, 0, track);
  }
}

}  // namespace

void CheckGivenBeats(std::span<const double> beats, const std::string& field) {
  CheckBeats(beats, field);
  for (size_t i = 1; i < beats.size(); ++i)
    RequireGap(beats[i - 1], beats[i], choreo::At(field, static_cast<int64_t>(i)));
}

void RequireLeft(const std::string& source, bool any, double start) {
  if (!any) throw InvalidArgument(source, "has no beat after second " + InFull(start));
}

void NoteBehind(const std::string& source, int64_t count, int64_t all, double end_s) {
  if (count == all) {
    throw InvalidArgument(source,
                          "has no beat within the part of the song that is heard, its first " +
                              Rounded(end_s) + " s; beats are in seconds");
  }
  if (count == 0) return;
  Note("note: " + source + ": " + std::to_string(count) + (count == 1 ? " beat is" : " beats are") +
       " left out, behind the end of the song at " + Rounded(end_s) + " s");
}

void NoteBehind(const std::string& source, std::span<const double> beats, double start,
                double end_s) {
  if (beats.empty()) return;
  const auto behind =
      std::ranges::count_if(beats, [&](double beat) { return beat > end_s + 1 / kOnsetRate; });
  NoteBehind(source, behind, std::ssize(beats), start + end_s);
}

void RequireSong(const BeatOptions& options, const std::string& song) {
  BeatOptions others = options;
  if (others.FindsThem()) others.beats.reset();
  if (song.empty() && others != BeatOptions())
    throw InvalidArgument("beats", "and other options of beats need a song");
}

BeatTrack BeatsAsAsked(std::span<const Onset> onsets, double start, const BeatOptions& options,
                       std::span<const float> mono) {
  BeatTrack track = options.FindsThem() ? TrackNear(options.hint, onsets, mono)
                                        : ReadBeats(*options.beats, start);
  // The last row of onsets ends a little later than the song.
  const double end = mono.empty() ? static_cast<double>(onsets.size()) / kOnsetRate
                                  : static_cast<double>(mono.size()) / kModelSampleRate;
  if (options.downbeat_s && *options.downbeat_s - start > end) {
    throw InvalidArgument("downbeat",
                          InFull(*options.downbeat_s) +
                              " s is after the part of the song that is heard, its first " +
                              Rounded(start + end) + " s");
  }
  const int64_t all = std::ssize(track.frames), behind = DropBehind(std::ssize(onsets), &track);
  if (!options.FindsThem()) NoteBehind(*options.beats, behind, all, start + end);
  WarnOfFew(options, track.frames.size());
  if (track.frames.empty()) {
    if (options.hint.tempo_bpm)
      WarnOfTempo(onsets, *options.hint.tempo_bpm, *options.hint.tempo_bpm, 0);
    return track;
  }
  const double found_bpm = TempoOf(track.Seconds());
  Change(options, start, &track);
  track.tempo_bpm = TempoOf(track.Seconds());
  const std::optional<double>& asked_bpm = options.hint.tempo_bpm;
  if (options.FindsThem() && asked_bpm && found_bpm > 0)
    WarnOfTempo(onsets, *asked_bpm, found_bpm, track.tempo_bpm);
  return track;
}

void ChangeBeats(const BeatOptions& options, double start, std::vector<double>* beats,
                 std::vector<double>* downbeats) {
  const bool changes = options.hint.half_time || options.hint.double_time || options.downbeat_s;
  if (beats->empty() || !changes) return;
  // No downbeat is known, or only downbeats are.
  BeatTrack track{.beats_in_bar = downbeats->empty() ? 0 : 1};
  std::map<int64_t, double> given;  // seconds by frame
  for (const double beat : *beats) {
    const int64_t frame = std::llround(beat * kOnsetRate);
    given[frame] = beat;
    track.frames.push_back(frame);
    track.in_bar.push_back(std::ranges::binary_search(*downbeats, beat) ? 0 : -1);
    track.confidence.push_back(1);
  }
  CountOthers(&track);
  Change(options, start, &track);
  beats->clear();
  downbeats->clear();
  for (size_t i = 0; i < track.frames.size(); ++i) {
    const auto exactly = given.find(track.frames[i]);
    beats->push_back(exactly != given.end() ? exactly->second
                                            : static_cast<double>(track.frames[i]) / kOnsetRate);
    if (track.in_bar[i] == 0) downbeats->push_back(beats->back());
  }
}

}  // namespace choreo::authoring
