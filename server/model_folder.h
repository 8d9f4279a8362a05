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

/// A folder of checkpoints: its .safetensors files, one model each, except those whose names begin
/// with a dot. default.safetensors comes first; the others follow by name. Not thread-safe.
class ModelFolder {
 public:
  /// Loads a checkpoint and returns warmed-up engines.
  using Loader = std::function<Server::Samplers(const std::filesystem::path&)>;

  ModelFolder(std::filesystem::path folder, Loader load)
      : folder_(std::move(folder)), load_(std::move(load)) {}

  /// Loads all models at startup. Throws what the loader throws. Throws Error(kInvalidArgument,
  /// "--models") for an empty or unreadable folder, and for two models of the same name.
  std::vector<Server::Samplers> Load();

  /// Rereads the folder: loads new and changed files, and those whose StyleFiguresFile has changed,
  /// and updates the server. Logs an unusable file as an error and retries it next time. Until then
  /// it serves the file's previous model, unless another file has a model of that name. Changes
  /// nothing if the folder is empty or unreadable. Once `stopped` returns true, loads nothing more
  /// and does not update the server.
  void Reload(Server& server, const std::function<bool()>& stopped);

 private:
  /// Identifies a version of a file; a missing one has zeros.
  struct Stamp {
    dev_t device = 0;
    ino_t inode = 0;
    off_t bytes = 0;
    int64_t written_ns = 0, changed_ns = 0;
    bool operator==(const Stamp&) const = default;
  };
  /// The model served from a file.
  struct Served {
    Stamp stamp, figures_stamp;
    std::string model, fingerprint, card;
    std::vector<double> figures;  // of StyleFigures; empty: none
  };
  using Files = std::map<std::filesystem::path, Served>;
  using Faults = std::map<std::filesystem::path, std::string>;

  std::vector<std::filesystem::path> List() const;
  static Stamp StampOf(const std::filesystem::path& file);
  /// Of the file's StyleFiguresFile, which may be missing or no file at all.
  static Stamp FiguresStampOf(const std::filesystem::path& file);
  static bool Has(const Files& files, const std::string& model);
  /// Loads a file and records it in `files`. Throws if `files` has a model of that name.
  Server::Samplers LoadFile(const std::filesystem::path& file, Files* files) const;
  /// Records a file in `files`, or its fault in `faults`. Returns its engines unless they are
  /// already served.
  std::optional<Server::Samplers> Inspect(const std::filesystem::path& file, Files* files,
                                          Faults* faults) const;
  /// Adds the previous models of faulty files to `files`. Call after all other files are recorded:
  /// they have precedence.
  void KeepServing(const Faults& faults, Files* files) const;

  const std::filesystem::path folder_;
  const Loader load_;
  Files served_;
};

}  // namespace choreo
