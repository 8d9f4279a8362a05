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

/// What all pages share. Thread-safe: nothing changes after construction.
class StudioContext {
 public:
  /// Asks the server what it has. `song` may be empty, and the folder of the photo model. Throws
  /// what the client library, HearSong and the library's retargeting do.
  StudioContext(const client::Options& server, const std::filesystem::path& song,
                const std::filesystem::path& photo_model = {});

  const client::Client& client() const { return client_; }
  const client::ModelDescription& model() const { return model_; }
  /// Of music that the server dances to.
  double most_seconds() const { return most_seconds_; }
  const PhotoModel& photo_model() const { return photo_model_; }
  /// The first message to every page.
  const Welcome& welcome() const { return welcome_; }
  /// That of the command line, or null.
  const std::shared_ptr<const Song>& song() const { return song_; }

 private:
  client::Client client_;
  client::ModelDescription model_;
  double most_seconds_ = 0;
  std::shared_ptr<const Song> song_;
  PhotoModel photo_model_;
  Welcome welcome_;
};

}  // namespace choreo::studio
