#pragma once

#include <filesystem>
#include <string>

#include "client/cli/music.h"
#include "studio/studio.pb.h"

namespace choreo::studio {

/// A song that is danced to. Immutable, hence shared between threads.
struct Song {
  cli::Music music;
  client::Audio audio;  ///< what is sent
  SongHeard heard;
};

/// Decodes a song and hears its beats. `name` is how errors call it, which are those of
/// DecodeAudioFile, and Error(kInvalidArgument) for one that is longer than `most_seconds`.
Song HearSong(const std::filesystem::path& path, const std::string& name, double most_seconds);

}  // namespace choreo::studio
