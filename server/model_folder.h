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

/// A folder of checkpoints, one model each: its .safetensors files, except those whose names begin
/// with a dot. default.safetensors comes first, the others by name. Not thread-safe.
class ModelFolder {
 public:
  /// Loads a checkpoint and makes warm engines.
  using Loader = std::function<Server::Samplers(const std::filesystem::path&)>;

  ModelFolder(std::filesystem::path folder, Loader load)
      : folder_(std::move(folder)), load_(std::move(load)) {}

  /// Loads all models at start. Throws what the loader throws, and Error(kInvalidArgument,
  /// "--models") for a folder that is empty or unreadable, and for two files with models of one
  /// name.
  std::vector<Server::Samplers> Load();

  /// Rereads the folder: loads new and changed files, and updates the server. Logs an unusable file
  /// as an error and retries it next time; until then its previous model stays, unless another file
  /// has one of that name. Everything stays if the folder is empty or unreadable. Once `stopped`,
  /// loads nothing more and does not update the server.
  void Reload(Server& server, const std::function<bool()>& stopped);

 private:
  /// Identifies a version of a file.
  struct Stamp {
    dev_t device = 0;
    ino_t inode = 0;
    off_t bytes = 0;
    int64_t written_ns = 0, changed_ns = 0;
    bool operator==(const Stamp&) const = default;
  };
  /// The model served from a file.
  struct Served {
    Stamp stamp;
    std::string model, fingerprint, card;
  };
  using Files = std::map<std::filesystem::path, Served>;
  using Faults = std::map<std::filesystem::path, std::string>;

  std::vector<std::filesystem::path> List() const;
  static Stamp StampOf(const std::filesystem::path& file);
  static bool Has(const Files& files, const std::string& model);
  /// Loads it, and records it in `files`. Throws if a model of that name exists.
  Server::Samplers LoadFile(const std::filesystem::path& file, Files* files) const;
  /// Records the file in `files`, or its problem in `faults`; returns engines unless they are
  /// already served.
  std::optional<Server::Samplers> Inspect(const std::filesystem::path& file, Files* files,
                                          Faults* faults) const;
  /// Keeps serving the previous models of faulty files, after all others, which have precedence.
  void KeepServing(const Faults& faults, Files* files) const;

  const std::filesystem::path folder_;
  const Loader load_;
  Files served_;
};

}  // namespace choreo
