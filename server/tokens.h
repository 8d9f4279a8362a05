#pragma once

#include <grpcpp/support/status.h>

#include <array>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace choreo {

/// Who may call: a file of lines "SHA256 NAME", the hash in 64 hexadecimal digits (as sha256sum
/// writes it) of a token that the client sends as "authorization: Bearer TOKEN". Empty lines and
/// those that begin with # are none. Tokens themselves are kept nowhere, and never logged.
/// Thread-safe.
class Tokens {
 public:
  /// An empty path: everybody may call. Throws Error(kNotFound) or Error(kInvalidArgument), field
  /// "--tokens", naming file and line.
  explicit Tokens(std::filesystem::path file);

  bool needed() const { return !file_.empty(); }

  /// Whose token `authorization` carries, the value of that header or empty; nobody's where none is
  /// needed. Takes equally long for whatever is no token. OK, or UNAUTHENTICATED with words that
  /// say what to send.
  grpc::Status FindHolder(std::string_view authorization, std::string* holder) const;

  /// Looks at the file again; to be called every now and then. One that can't be used changes
  /// nothing, and is logged once.
  void Refresh();

 private:
  using Hash = std::array<unsigned char, 32>;
  struct Holder {
    Hash hash;
    std::string name;
  };
  using Holders = std::vector<Holder>;

  std::string Read() const;
  Holders Parse(const std::string& text) const;
  std::shared_ptr<const Holders> holders() const;

  const std::filesystem::path file_;
  std::string text_;  // of the file as last read; of the thread that refreshes
  mutable std::mutex mutex_;
  std::shared_ptr<const Holders> holders_;  // lock: mutex_
};

}  // namespace choreo
