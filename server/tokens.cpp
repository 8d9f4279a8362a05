#include "server/tokens.h"

#include <openssl/crypto.h>
#include <openssl/sha.h>
#include <spdlog/spdlog.h>

#include <charconv>
#include <fstream>
#include <iterator>
#include <sstream>

#include "model/core/error.h"
#include "server/status.h"

namespace choreo {
namespace {

constexpr std::string_view kScheme = "Bearer ";
/// A file longer than this is none of ours.
constexpr size_t kMostBytes = 1 << 20;

grpc::Status SendToken(const std::string& why) {
  return Unauthenticated(why + "; send the metadata \"authorization: Bearer TOKEN\"");
}

}  // namespace

Tokens::Tokens(std::filesystem::path file) : file_(std::move(file)) {
  if (!needed()) return;
  text_ = Read();
  holders_ = std::make_shared<const Holders>(Parse(text_));
}

std::string Tokens::Read() const {
  std::ifstream in(file_, std::ios::binary);
  if (!in) throw Error(ErrorCode::kNotFound, "--tokens", "cannot read " + file_.string());
  std::string text(std::istreambuf_iterator<char>(in), {});
  if (text.size() <= kMostBytes) return text;
  throw InvalidArgument("--tokens", file_.string() + " has " + std::to_string(text.size()) +
                                        " bytes, of at most " + std::to_string(kMostBytes));
}

// No line is ever quoted: somebody may have written a token there.
Tokens::Holders Tokens::Parse(const std::string& text) const {
  Holders holders;
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
    if (!good || !(words >> holder.name)) {
      throw InvalidArgument("--tokens", file_.string() + " line " + std::to_string(number) +
                                            ": not \"SHA256 NAME\" with 64 hexadecimal digits");
    }
    holders.push_back(std::move(holder));
  }
  return holders;
}

std::shared_ptr<const Tokens::Holders> Tokens::holders() const {
  const std::lock_guard lock(mutex_);
  return holders_;
}

grpc::Status Tokens::FindHolder(std::string_view authorization, std::string* holder) const {
  if (!needed()) return grpc::Status::OK;
  if (authorization.empty()) return SendToken("a token is needed");
  if (!authorization.starts_with(kScheme)) return SendToken("that is no bearer token");
  authorization.remove_prefix(kScheme.size());
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

void Tokens::Refresh() {
  if (!needed()) return;
  try {
    std::string text = Read();
    if (text == text_) return;
    text_ = std::move(text);
    auto holders = std::make_shared<const Holders>(Parse(text_));
    spdlog::info("{} tokens are known now", holders->size());
    const std::lock_guard lock(mutex_);
    holders_ = std::move(holders);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kNotFound && text_.empty()) return;  // said before
    if (error.code() == ErrorCode::kNotFound) text_.clear();
    spdlog::error("{}; those known before stay", error.what());
  }
}

}  // namespace choreo
