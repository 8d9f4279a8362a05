#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/audio/beats/beat_hint.h"
#include "model/audio/beats/beats.h"

namespace choreo::authoring {

inline constexpr int kMaxBeatsInBar = 16;  ///< people count no further

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

/// Notes how many given beats lie behind a song's end, if any (notes.h). `source`: the beats' file.
void NoteBehind(const std::string& source, int64_t count, double end_s);

/// Finds or, by the options, reads a song's beats from second `start` on. Warns (notes.h) if the
/// song does not have the requested tempo. Throws Error(kInvalidArgument) whose field is "beats",
/// "downbeat" or a line of the file. `mono` as in TrackBeats.
BeatTrack BeatsAsAsked(std::span<const Onset> onsets, double start, const BeatOptions& options,
                       std::span<const float> mono = {});

/// Applies the options for half time, double time and a downbeat to known beats and downbeats, in
/// seconds of a dance that begins at second `start` of its song.
void ChangeBeats(const BeatOptions& options, double start, std::vector<double>* beats,
                 std::vector<double>* downbeats);

}  // namespace choreo::authoring
