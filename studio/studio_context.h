#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "client/choreo_client.h"
#include "studio/photo_model.h"
#include "studio/song.h"
#include "studio/studio.pb.h"

namespace choreo::studio {

/// The state that all pages share. Thread-safe: constant after construction.
class StudioContext {
 public:
  /// Queries the server. `song` and the photo model's folder may be empty. Throws as the client
  /// library, HearSong and the library's retargeting.
  StudioContext(const client::Options& server, const std::filesystem::path& song,
                const std::filesystem::path& photo_model = {});

  const client::Client& client() const { return client_; }
  const client::ServerDescription& server() const { return server_; }
  /// The server's first model.
  const client::ModelDescription& model() const { return server_.models.front(); }
  /// Longest music that the server accepts.
  double most_seconds() const { return server_.limits.max_audio_s; }
  const PhotoModel& photo_model() const { return photo_model_; }
  /// The first message to every page.
  const Welcome& welcome() const { return welcome_; }
  /// The command line's song, or null.
  const std::shared_ptr<const Song>& song() const { return song_; }

 private:
  client::Client client_;
  client::ServerDescription server_;
  std::shared_ptr<const Song> song_;
  PhotoModel photo_model_;
  Welcome welcome_;
};

}  // namespace choreo::studio
