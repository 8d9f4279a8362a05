#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/audio/beat_hint.h"
#include "model/audio/beats.h"

namespace choreo::authoring {

inline constexpr int kMaxBeatsInBar = 16;  ///< that people count to

/// Options that override the beat tracker.
struct BeatOptions {
  std::optional<std::string> beats = {};  ///< the name of a file, or "auto" to find them
  BeatHint hint = {};
  std::optional<double> downbeat_s = {};  ///< of the song

  bool FindsThem() const { return beats.value_or("auto") == "auto"; }

  bool operator==(const BeatOptions&) const = default;
};

/// Throws Error(kInvalidArgument) for beat options without a song.
void RequireSong(const BeatOptions& options, const std::string& song);

/// A song's beats from second `start` on, found or read, depending on the options. Warns on
/// standard error of a tempo that is not heard in it. Throws Error(kInvalidArgument), whose field
/// is "beats", "downbeat" or a line of the file. `mono` as in TrackBeats.
BeatTrack BeatsAsAsked(std::span<const Onset> onsets, double start, const BeatOptions& options,
                       std::span<const float> mono = {});

/// Changes known beats and their downbeats by the options for half and double time and a downbeat.
/// Seconds of a dance that begins at second `start` of its song.
void ChangeBeats(const BeatOptions& options, double start, std::vector<double>* beats,
                 std::vector<double>* downbeats);

}  // namespace choreo::authoring
