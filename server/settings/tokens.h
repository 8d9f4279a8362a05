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

/// The authorised callers, read from a file of lines "SHA256 NAME". SHA256 is the hash, 64
/// hexadecimal digits as printed by sha256sum, of a token that the client sends as "authorization:
/// Bearer TOKEN". Empty lines and lines that begin with # are ignored. Tokens themselves are
/// neither stored nor logged. A token has one name: a line that gives it another is bad. A token
/// removed from the file gives no access. But a file without a good line keeps its previous tokens
/// valid. A missing file admits nobody. Thread-safe.
class Tokens {
 public:
  /// A token's SHA-256.
  using Hash = std::array<unsigned char, 32>;

  /// `file`: if empty, everybody may call. Throws Error(kInvalidArgument, "--tokens"), naming file
  /// and line, if the file is unreadable, has a bad line, or has no token.
  explicit Tokens(std::filesystem::path file);

  bool needed() const { return !file_.empty(); }
  size_t count() const { return holders()->size(); }
  /// The names of token holders, without duplicates, in the file's order, at most `most`.
  std::vector<std::string> Names(size_t most) const;

  /// Finds the holder of the token in `authorization`, that header's value or empty. The holder is
  /// empty if no token is needed. Takes equally long for all invalid tokens. Returns OK, or
  /// UNAUTHENTICATED with a message that states what to send. `hash`: receives the token's hash
  /// unless null.
  grpc::Status FindHolder(std::string_view authorization, std::string* holder,
                          Hash* hash = nullptr) const;

  /// Whether a token that FindHolder accepted has been revoked since: the reread file lacks it. An
  /// unreadable file revokes no token.
  bool IsRevoked(const Hash& hash) const;

  /// Rereads the file; call regularly. Skips bad lines. Admits nobody while the file is unreadable.
  /// A file without a good line changes nothing. Logs each fault once. Returns whether a changed
  /// file is without fault, or none without a change.
  std::optional<bool> Refresh();

 private:
  struct Holder {
    Hash hash;
    std::string name;
  };
  using Holders = std::vector<Holder>;

  struct Content {
    Holders holders;
    std::string bad_lines;   // "2, 7"; empty: none
    std::string twins;       // "2 and 7", the first lines of one hash and two names; empty: none
    bool is_marked = false;  // begins with a byte order mark, which makes line 1 bad
    bool good() const { return bad_lines.empty() && twins.empty(); }
  };

  std::string Read() const;
  static Content Parse(const std::string& text);
  static bool ParseHash(std::string_view digits, Hash* hash);
  Error Faults(const Content& content) const;
  Error NoTokens() const;
  std::shared_ptr<const Holders> holders() const;
  void Replace(Holders holders);
  /// Admits nobody, while the file is unreadable.
  void Close();
  bool IsClosed() const;
  /// Warns if the file contains this token in place of its hash; the two may look alike.
  void WarnOfRawToken(std::string_view token, const Holders& holders) const;

  const std::filesystem::path file_;
  // The file as last read; none if unreadable. Only the refreshing thread uses it.
  std::optional<std::string> text_;
  bool seems_empty_ = false;  // at the last Refresh
  mutable std::mutex mutex_;
  mutable std::atomic<bool> warned_ = false;                              // of a raw token
  std::shared_ptr<const Holders> holders_ = std::make_shared<Holders>();  // lock: mutex_
  bool closed_ = false;                                                   // lock: mutex_
};

}  // namespace choreo
