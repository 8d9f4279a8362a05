#pragma once

#include <grpcpp/support/status.h>

#include <array>
#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/core/error.h"

namespace choreo {

/// Who may call: a file of lines "SHA256 NAME", with the hash in 64 hexadecimal digits (as by
/// sha256sum) of a token that the client sends as "authorization: Bearer TOKEN". Ignores empty
/// lines and those that begin with #. Tokens themselves are neither stored nor logged. A token
/// that is no longer in the file gives no access, unless the file holds only bad lines: then the
/// former ones stay valid. A file that is empty or gone admits nobody. Thread-safe.
class Tokens {
 public:
  /// A token's SHA-256.
  using Hash = std::array<unsigned char, 32>;

  /// An empty path: everybody may call. Throws Error(kInvalidArgument), field "--tokens", naming
  /// file and line, if it is unreadable, a line is bad, or it holds no token.
  explicit Tokens(std::filesystem::path file);

  bool needed() const { return !file_.empty(); }
  size_t count() const { return holders()->size(); }
  /// Who has a token, each once, in the order of the file, at most `most`.
  std::vector<std::string> Names(size_t most) const;

  /// The holder of the token in `authorization`, that header's value or empty; nobody if no token
  /// is needed. Takes equally long for all invalid tokens. Returns OK, or UNAUTHENTICATED saying
  /// what to send. `hash`: the token's, if that is wanted.
  grpc::Status FindHolder(std::string_view authorization, std::string* holder,
                          Hash* hash = nullptr) const;

  /// Whether a token that FindHolder knew has been revoked since: the file was read and lacks it. A
  /// file that cannot be read revokes none.
  bool IsRevoked(const Hash& hash) const;

  /// Rereads the file; call regularly. Bad lines are skipped; while the file is unreadable, nobody
  /// is admitted; a file of bad lines alone changes nothing. Logs each once. Returns whether a
  /// changed file has no bad lines; none without a change.
  std::optional<bool> Refresh();

 private:
  struct Holder {
    Hash hash;
    std::string name;
  };
  using Holders = std::vector<Holder>;

  struct Content {
    Holders holders;
    std::string bad_lines;  // "2, 7"; empty: none
  };

  std::string Read() const;
  static Content Parse(const std::string& text);
  static bool ParseHash(std::string_view digits, Hash* hash);
  Error BadLines(const std::string& numbers) const;
  Error NoTokens() const;
  std::shared_ptr<const Holders> holders() const;
  void Replace(Holders holders);
  /// Nobody is admitted while the file cannot be read.
  void Close();
  /// Warns if the file has this token itself where its hash belongs: both may look alike.
  void WarnOfRawToken(std::string_view token, const Holders& holders) const;

  const std::filesystem::path file_;
  // The file as last read; none if unreadable. Used by the refreshing thread.
  std::optional<std::string> text_;
  bool seems_empty_ = false;  // at the last look
  mutable std::mutex mutex_;
  mutable std::atomic<bool> warned_ = false;                              // of a raw token
  std::shared_ptr<const Holders> holders_ = std::make_shared<Holders>();  // lock: mutex_
  bool closed_ = false;                                                   // lock: mutex_
};

}  // namespace choreo
