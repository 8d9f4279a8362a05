#pragma once

#include <filesystem>
#include <string>

#include "client/authoring/music/music.h"
#include "studio/studio.pb.h"

namespace choreo::studio {

/// A song to dance to. Immutable, hence shared between threads.
struct Song {
  authoring::Music music;
  client::Audio audio;  ///< sent to the server
  SongHeard heard;
};

/// Decodes a song and finds its beats. `name` is its name in errors. Throws like DecodeAudioFile,
/// and Error(kInvalidArgument) if it is longer than `most_seconds`.
Song HearSong(const std::filesystem::path& path, const std::string& name, double most_seconds);

}  // namespace choreo::studio
