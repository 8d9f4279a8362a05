#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/server.h"

namespace choreo {

/// A folder of checkpoints, each of which is a model of a server: its .safetensors files, but for
/// those whose names begin with a dot. default.safetensors comes first, the others by name. Not
/// thread-safe.
class ModelFolder {
 public:
  /// Loads a checkpoint and makes engines that are ready to dance.
  using Loader = std::function<Server::Samplers(const std::filesystem::path&)>;

  ModelFolder(std::filesystem::path folder, Loader load)
      : folder_(std::move(folder)), load_(std::move(load)) {}

  /// All models, for a start. Throws what the loader throws, Error(kInvalidArgument, "--models")
  /// for a folder that has none or cannot be read, and for two files with models of one name.
  std::vector<Server::Samplers> Load();

  /// Looks again: loads the files that are new or have changed since, and tells the server what it
  /// serves now. A file that cannot be used is logged as an error and tried again the next time;
  /// until then the model that it had before goes on, unless another file has one of that name. All
  /// go on where the folder has none or cannot be read. Once `stopped` it loads nothing more, and
  /// the server is told nothing.
  void Reload(Server& server, const std::function<bool()>& stopped);

 private:
  /// Of a file that is another one, or was written since.
  struct Stamp {
    dev_t device = 0;
    ino_t inode = 0;
    off_t bytes = 0;
    int64_t written_ns = 0, changed_ns = 0;
    bool operator==(const Stamp&) const = default;
  };
  /// What is served of a file.
  struct Served {
    Stamp stamp;
    std::string model, fingerprint, card;
  };
  using Files = std::map<std::filesystem::path, Served>;
  using Faults = std::map<std::filesystem::path, std::string>;

  std::vector<std::filesystem::path> List() const;
  static Stamp StampOf(const std::filesystem::path& file);
  static bool Has(const Files& files, const std::string& model);
  /// Loads it, and notes in `files` what it has. Throws where a model of that name is there.
  Server::Samplers LoadFile(const std::filesystem::path& file, Files* files) const;
  /// Notes in `files` what it has, or in `faults` why it cannot be used; engines where these are
  /// not served already.
  std::optional<Server::Samplers> Look(const std::filesystem::path& file, Files* files,
                                       Faults* faults) const;
  /// Of files at fault, notes what is served of them as before; once all others have been looked
  /// at, which have the right of way.
  void GoOn(const Faults& faults, Files* files) const;

  const std::filesystem::path folder_;
  const Loader load_;
  Files served_;
};

}  // namespace choreo
