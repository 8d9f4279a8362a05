#include "server/tokens.h"

#include <openssl/crypto.h>
#include <openssl/sha.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "server/status.h"
#include "tls/pem.h"

namespace choreo {
namespace {

/// A longer file cannot be a token file.
constexpr size_t kMaxTokensBytes = 1 << 20;
constexpr size_t kMaxLinesLength = 60;  // characters of a list of line numbers

// Schemes ignore case (RFC 7235).
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
  if (!content.bad_lines.empty()) throw BadLines(content.bad_lines);
  Replace(std::move(content.holders));
}

std::string Tokens::Read() const { return ReadSmallFile("--tokens", file_, kMaxTokensBytes); }

Tokens::Content Tokens::Parse(const std::string& text) {
  Content content;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    std::string digits;
    Holder holder;
    if (!(words >> digits) || digits.starts_with('#')) continue;
    bool good = digits.size() == 2 * holder.hash.size();
    for (size_t i = 0; good && i < holder.hash.size(); ++i) {
      const char* at = digits.data() + 2 * i;
      good = std::from_chars(at, at + 2, holder.hash[i], 16).ptr == at + 2;
    }
    if (good && words >> holder.name) {
      content.holders.push_back(std::move(holder));
    } else if (content.bad_lines.size() < kMaxLinesLength) {
      content.bad_lines += (content.bad_lines.empty() ? "" : ", ") + std::to_string(number);
    }
  }
  return content;
}

// Never quotes a line: it may contain a token.
Error Tokens::BadLines(const std::string& numbers) const {
  return InvalidArgument("--tokens", file_.string() + " line " + numbers +
                                         ": not \"SHA256 NAME\" with 64 hexadecimal digits");
}

std::shared_ptr<const Tokens::Holders> Tokens::holders() const {
  const std::lock_guard lock(mutex_);
  return holders_;
}

grpc::Status Tokens::FindHolder(std::string_view authorization, std::string* holder) const {
  if (!needed()) return grpc::Status::OK;
  if (authorization.empty()) return SendToken("a token is needed");
  const size_t scheme = authorization.find(' ');
  if (scheme == authorization.npos || !IsBearer(authorization.substr(0, scheme))) {
    return SendToken("that is no bearer token");
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
  if (found == nullptr) return SendToken("nobody here has that token");
  *holder = found->name;
  return grpc::Status::OK;
}

void Tokens::Replace(Holders holders) {
  auto known = std::make_shared<const Holders>(std::move(holders));
  const std::lock_guard lock(mutex_);
  holders_ = std::move(known);
}

void Tokens::Refresh() {
  if (!needed()) return;
  std::string text;
  try {
    text = Read();
  } catch (const Error& error) {
    if (!text_) return;  // logged before
    text_.reset();
    Replace({});
    spdlog::error("{}; nobody is let in until it can be read", error.what());
    return;
  }
  if (text_ == text) return;
  Content content = Parse(text);
  if (!content.bad_lines.empty()) {
    spdlog::error("{}; the other lines count", BadLines(content.bad_lines).what());
  }
  spdlog::info("{} tokens are known now", content.holders.size());
  Replace(std::move(content.holders));
  text_ = std::move(text);
}

}  // namespace choreo
