#pragma once

#include <grpcpp/support/status.h>

#include <array>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/core/error.h"

namespace choreo {

/// Who may call: a file of lines "SHA256 NAME", the hash in 64 hexadecimal digits (as sha256sum
/// writes it) of a token that the client sends as "authorization: Bearer TOKEN". Empty lines and
/// those that begin with # are none. Tokens themselves are kept nowhere, and never logged. Whatever
/// happens to the file while it is in use, nobody keeps a token by it that stands there no more.
/// Thread-safe.
class Tokens {
 public:
  /// An empty path: everybody may call. Throws Error(kInvalidArgument), field "--tokens", naming
  /// file and line, where it cannot be read or one line is bad.
  explicit Tokens(std::filesystem::path file);

  bool needed() const { return !file_.empty(); }
  size_t count() const { return holders()->size(); }

  /// Whose token `authorization` carries, the value of that header or empty; nobody's where none is
  /// needed. Takes equally long for whatever is no token. OK, or UNAUTHENTICATED with words that
  /// say what to send.
  grpc::Status FindHolder(std::string_view authorization, std::string* holder) const;

  /// Looks at the file again; to be called every now and then. Of one with bad lines the good ones
  /// count; while it cannot be read nobody is let in. Both are logged once.
  void Refresh();

 private:
  using Hash = std::array<unsigned char, 32>;
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
  Error BadLines(const std::string& numbers) const;
  std::shared_ptr<const Holders> holders() const;
  void Replace(Holders holders);

  const std::filesystem::path file_;
  // Of the file as last read; none: it could not be. Of the thread that refreshes.
  std::optional<std::string> text_;
  mutable std::mutex mutex_;
  std::shared_ptr<const Holders> holders_ = std::make_shared<Holders>();  // lock: mutex_
};

}  // namespace choreo
