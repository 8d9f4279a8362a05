#include "server/settings/tokens.h"

#include <openssl/crypto.h>
#include <openssl/sha.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <map>
#include <sstream>
#include <utility>

#include "model/core/joined.h"
#include "model/core/text/counted.h"
#include "network/pem.h"
#include "server/messages/status.h"

namespace choreo {
namespace {

/// A longer file cannot be a token file.
constexpr size_t kMaxTokensBytes = 1 << 20;
constexpr size_t kMaxLinesLength = 60;  // characters of a list of line numbers

// Schemes are case-insensitive (RFC 7235).
bool IsBearer(std::string_view scheme) {
  constexpr std::string_view kBearer = "bearer";
  return std::ranges::equal(scheme, kBearer, [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b;
  });
}

grpc::Status SendToken(const std::string& why) {
  return Unauthenticated(why + "; send the metadata \"authorization: Bearer TOKEN\"");
}

}  // namespace

Tokens::Tokens(std::filesystem::path file) : file_(std::move(file)) {
  if (!needed()) return;
  text_ = Read();
  Content content = Parse(*text_);
  if (!content.good()) throw Faults(content);
  if (content.holders.empty()) throw NoTokens();
  Replace(std::move(content.holders));
}

std::string Tokens::Read() const { return ReadSmallFile("--tokens", file_, kMaxTokensBytes); }

bool Tokens::ParseHash(std::string_view digits, Hash* hash) {
  if (digits.size() != 2 * hash->size()) return false;
  for (size_t i = 0; i < hash->size(); ++i) {
    const char* at = digits.data() + 2 * i;
    if (std::from_chars(at, at + 2, (*hash)[i], 16).ptr != at + 2) return false;
  }
  return true;
}

void Tokens::WarnOfRawToken(std::string_view token, const Holders& holders) const {
  Hash as_hash;
  if (!ParseHash(token, &as_hash)) return;
  for (const Holder& one : holders) {
    if (CRYPTO_memcmp(one.hash.data(), as_hash.data(), as_hash.size()) != 0 ||
        warned_.exchange(true))
      continue;
    spdlog::warn("{}: the line of {} has the token itself; its SHA-256 belongs there",
                 file_.string(), one.name);
  }
}

Tokens::Content Tokens::Parse(const std::string& text) {
  Content content;
  content.is_marked = text.starts_with("\xEF\xBB\xBF");
  std::istringstream lines(text);
  std::string line;
  std::map<Hash, std::pair<std::string, int>> seen;  // name and line of each hash
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    std::string digits;
    Holder holder;
    if (!(words >> digits) || digits.starts_with('#')) continue;
    if (ParseHash(digits, &holder.hash) && words >> holder.name) {
      const auto& [known, is_new] = seen.try_emplace(holder.hash, holder.name, number);
      const auto& [name, first] = known->second;
      if (is_new) {
        content.holders.push_back(std::move(holder));
      } else if (name != holder.name && content.twins.empty()) {
        content.twins = std::to_string(first) + " and " + std::to_string(number);
      }
    } else if (content.bad_lines.size() < kMaxLinesLength) {
      content.bad_lines += (content.bad_lines.empty() ? "" : ", ") + std::to_string(number);
    }
  }
  return content;
}

// Never quotes a line, because it may contain a token.
Error Tokens::Faults(const Content& content) const {
  std::vector<std::string> faults;
  if (!content.bad_lines.empty())
    faults.push_back("line " + content.bad_lines +
                     ": not \"SHA256 NAME\" with 64 hexadecimal digits");
  if (content.is_marked)
    faults.push_back("line 1 begins with a byte order mark: save the file as UTF-8 without one");
  if (!content.twins.empty())
    faults.push_back("lines " + content.twins + ": the same token under two names");
  return InvalidArgument("--tokens", file_.string() + ' ' + Joined(faults, std::identity(), "; "));
}

Error Tokens::NoTokens() const {
  return InvalidArgument("--tokens", file_.string() + " holds no token, no line \"SHA256 NAME\"");
}

std::shared_ptr<const Tokens::Holders> Tokens::holders() const {
  const std::lock_guard lock(mutex_);
  return holders_;
}

std::vector<std::string> Tokens::Names(size_t most) const {
  std::vector<std::string> names;
  const auto all = holders();
  for (const Holder& one : *all) {
    if (names.size() >= most) break;
    if (std::ranges::find(names, one.name) == names.end()) names.push_back(one.name);
  }
  return names;
}

grpc::Status Tokens::FindHolder(std::string_view authorization, std::string* holder,
                                Hash* hash_of_it) const {
  if (!needed()) return grpc::Status::OK;
  if (authorization.empty()) return SendToken("a token is needed");
  const size_t scheme = authorization.find(' ');
  if (scheme == authorization.npos || !IsBearer(authorization.substr(0, scheme))) {
    return SendToken("that is not a bearer token");
  }
  authorization.remove_prefix(
      std::min(authorization.find_first_not_of(' ', scheme), authorization.size()));
  if (authorization.empty()) return SendToken("that token is empty");
  Hash hash;
  SHA256(reinterpret_cast<const unsigned char*>(authorization.data()), authorization.size(),
         hash.data());
  const auto all = holders();
  const Holder* found = nullptr;
  for (const Holder& one : *all) {
    if (CRYPTO_memcmp(one.hash.data(), hash.data(), hash.size()) == 0) found = &one;
  }
  if (found == nullptr) {
    WarnOfRawToken(authorization, *all);
    // No other token would help.
    if (IsClosed())
      return Unauthenticated("the server cannot read its tokens, and admits nobody until it can");
    return SendToken("that token is unknown");
  }
  *holder = found->name;
  if (hash_of_it != nullptr) *hash_of_it = hash;
  return grpc::Status::OK;
}

bool Tokens::IsRevoked(const Hash& hash) const {
  if (!needed()) return false;
  const std::lock_guard lock(mutex_);
  return !closed_ && std::ranges::none_of(*holders_, [&](const Holder& one) {
    return CRYPTO_memcmp(one.hash.data(), hash.data(), hash.size()) == 0;
  });
}

bool Tokens::IsClosed() const {
  const std::lock_guard lock(mutex_);
  return closed_;
}

void Tokens::Replace(Holders holders) {
  auto known = std::make_shared<const Holders>(std::move(holders));
  const std::lock_guard lock(mutex_);
  holders_ = std::move(known);
  closed_ = false;
}

void Tokens::Close() {
  const std::lock_guard lock(mutex_);
  holders_ = std::make_shared<const Holders>();
  closed_ = true;
}

std::optional<bool> Tokens::Refresh() {
  if (!needed()) return std::nullopt;
  std::string text;
  try {
    text = Read();
  } catch (const Error& error) {
    if (!text_) return std::nullopt;  // logged before
    text_.reset();
    Close();
    spdlog::error("{}; no call is accepted until it can be read", error.what());
    return false;
  }
  if (text_ == text) {
    seems_empty_ = false;
    return std::nullopt;
  }
  Content content = Parse(text);
  const bool is_empty = content.holders.empty() && content.good();
  // A file is empty for a moment while it is written, so it must be still empty at the next
  // Refresh.
  if (is_empty && !std::exchange(seems_empty_, true)) return std::nullopt;
  seems_empty_ = is_empty;
  text_ = std::move(text);
  const bool all_good = content.good();
  // A file without a token is the wrong file or unfinished.
  if (content.holders.empty()) {
    const Error fault = is_empty ? NoTokens() : Faults(content);
    spdlog::error("{}; what was known before stays valid: {}", fault.what(),
                  Counted(count(), "token"));
    return false;
  }
  if (!all_good) spdlog::error("{}; the other lines count", Faults(content).what());
  spdlog::info("{}: read again, {}", file_.string(), Counted(content.holders.size(), "token"));
  Replace(std::move(content.holders));
  warned_ = false;
  return all_good;
}

}  // namespace choreo
