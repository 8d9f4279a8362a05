#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client/authoring/music/beat_file.h"
#include "model/audio/beats/beat_hint.h"
#include "model/audio/beats/beats.h"

namespace choreo::authoring {

/// Options that override the beat tracker.
struct BeatOptions {
  std::optional<std::string> beats = {};  ///< the name of a file, or "auto" to find them
  BeatHint hint = {};
  std::optional<double> downbeat_s = {};  ///< a downbeat, in seconds of the song

  bool FindsThem() const { return beats.value_or("auto") == "auto"; }

  bool operator==(const BeatOptions&) const = default;
};

/// Throws Error(kInvalidArgument) for beat options without a song.
void RequireSong(const BeatOptions& options, const std::string& song);

/// Throws what CheckBeats does, and Error(kInvalidArgument, FIELD[i]) for beats that are closer
/// than the rows in which they are found.
void CheckGivenBeats(std::span<const double> beats, const std::string& field);

/// Throws Error(kInvalidArgument, source) unless `any` given beat is left from second `start` of
/// the song on. `source`: their file.
void RequireLeft(const std::string& source, bool any, double start);

/// Notes (notes.h) given beats behind a song's end, if any. Throws
/// Error(kInvalidArgument, source) if `all` of them are.
void NoteBehind(const std::string& source, int64_t count, int64_t all, double end_s);
/// The same for beats, perhaps none, in seconds of a dance that begins at second `start` of its
/// song, which ends at second `end_s` of the dance.
void NoteBehind(const std::string& source, std::span<const double> beats, double start,
                double end_s);

/// Finds or, by the options, reads a song's beats from second `start` on. Warns (notes.h) if the
/// song does not have the requested tempo. Throws Error(kInvalidArgument) whose field is "beats",
/// "downbeat", the file or a line of it. `mono` as in TrackBeats; it also tells the song's end.
BeatTrack BeatsAsAsked(std::span<const Onset> onsets, double start, const BeatOptions& options,
                       std::span<const float> mono = {});

/// Applies the options for half time, double time and a downbeat to known beats and downbeats, in
/// seconds of a dance that begins at second `start` of its song.
void ChangeBeats(const BeatOptions& options, double start, std::vector<double>* beats,
                 std::vector<double>* downbeats);

}  // namespace choreo::authoring
