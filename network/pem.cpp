#include "network/pem.h"

#include <fcntl.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <limits>
#include <memory>
#include <vector>

#include "model/core/error.h"

namespace choreo {
namespace {

constexpr size_t kMaxPemBytes = 1 << 20;

using Bio = std::unique_ptr<BIO, decltype(&BIO_free)>;
using X509Pointer = std::unique_ptr<X509, decltype(&X509_free)>;
using KeyPointer = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
using Context = std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)>;

struct Descriptor {
  int fd;
  ~Descriptor() {
    if (fd >= 0) close(fd);
  }
};

Bio Reader(const std::string& text) {
  return {BIO_new_mem_buf(text.data(), static_cast<int>(text.size())), BIO_free};
}

Error Unusable(const std::string& field, const std::filesystem::path& path,
               const std::string& what) {
  ERR_clear_error();
  return InvalidArgument(field, path.string() + ' ' + what);
}

std::string LastReason() {
  const char* reason = ERR_reason_error_string(ERR_peek_last_error());
  return reason == nullptr ? "unknown error" : reason;
}

void RequireRegular(const std::string& field, const std::filesystem::path& path,
                    const struct stat& status) {
  if (S_ISREG(status.st_mode)) return;
  const char* what = S_ISDIR(status.st_mode)    ? "a directory"
                     : S_ISFIFO(status.st_mode) ? "a FIFO"
                     : S_ISSOCK(status.st_mode) ? "a socket"
                                                : "a device";
  throw InvalidArgument(field, path.string() + " is " + what + ", no file");
}

Error Absent(const std::string& field, const std::filesystem::path& path, int why) {
  if (why == ENOENT) return InvalidArgument(field, "no file " + path.string());
  return InvalidArgument(field, "cannot read " + path.string() + ": " + std::strerror(why));
}

X509Pointer FirstOf(const std::string& certificates) {
  return {PEM_read_bio_X509(Reader(certificates).get(), nullptr, nullptr, nullptr), X509_free};
}

// The expiry of each certificate. One without a readable date never expires.
std::vector<int64_t> ExpiriesOf(const std::string& certificates) {
  const Bio reader = Reader(certificates);
  std::vector<int64_t> expiries;
  while (const X509Pointer one{PEM_read_bio_X509(reader.get(), nullptr, nullptr, nullptr),
                               X509_free}) {
    std::tm date{};
    const bool has_date = ASN1_TIME_to_tm(X509_get0_notAfter(one.get()), &date) == 1;
    expiries.push_back(has_date ? timegm(&date) : std::numeric_limits<int64_t>::max());
  }
  ERR_clear_error();
  return expiries;
}

// Keeps OpenSSL from asking on the terminal.
int NoPassphrase(char* /*buffer*/, int /*size*/, int /*writing*/, void* needs_passphrase) {
  *static_cast<bool*>(needs_passphrase) = true;
  return -1;
}

KeyPointer ParseKey(const std::string& field, const std::filesystem::path& path,
                    const std::string& text) {
  bool needs_passphrase = false;
  KeyPointer key(
      PEM_read_bio_PrivateKey(Reader(text).get(), nullptr, NoPassphrase, &needs_passphrase),
      EVP_PKEY_free);
  if (key) return key;
  if (needs_passphrase)
    throw Unusable(field, path, "is encrypted; a key without a passphrase is needed");
  throw Unusable(field, path, text.empty() ? "is empty" : "holds no private key in PEM");
}

}  // namespace

void RequireRegularFile(const std::string& field, const std::filesystem::path& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) throw Absent(field, path, errno);
  RequireRegular(field, path, status);
}

std::string ReadSmallFile(const std::string& field, const std::filesystem::path& path,
                          size_t most) {
  RequireRegularFile(field, path);
  // The file may have been replaced. Without O_NONBLOCK, a FIFO would block until somebody writes
  // to it.
  const Descriptor file{open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
  if (file.fd < 0) throw Absent(field, path, errno);
  struct stat status {};
  if (fstat(file.fd, &status) != 0) throw Absent(field, path, errno);
  RequireRegular(field, path, status);
  const auto require_small = [&](size_t size) {
    if (size <= most) return;
    throw InvalidArgument(field, path.string() + " has " + std::to_string(size) +
                                     " bytes, of at most " + std::to_string(most));
  };
  require_small(static_cast<size_t>(status.st_size));
  std::string text;
  char bytes[4096];
  for (;;) {
    const ssize_t count = read(file.fd, bytes, sizeof bytes);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw Absent(field, path, errno);
    if (count == 0) return text;
    text.append(bytes, static_cast<size_t>(count));
    require_small(text.size());  // it may have grown meanwhile
  }
}

std::string ReadCertificates(const std::string& field, const std::filesystem::path& path) {
  std::string text = ReadSmallFile(field, path, kMaxPemBytes);
  if (text.empty()) throw Unusable(field, path, "is empty");
  const Bio reader = Reader(text);
  int count = 0;
  ERR_clear_error();
  while (X509Pointer(PEM_read_bio_X509(reader.get(), nullptr, nullptr, nullptr), X509_free)) {
    ++count;
  }
  const bool at_end = ERR_GET_REASON(ERR_peek_last_error()) == PEM_R_NO_START_LINE;
  if (!at_end) {
    throw Unusable(
        field, path,
        "has a damaged certificate, number " + std::to_string(count + 1) + ": " + LastReason());
  }
  if (count == 0) throw Unusable(field, path, "holds no certificate in PEM");
  ERR_clear_error();
  return text;
}

int64_t ExpiryOf(const std::string& chain) { return std::ranges::min(ExpiriesOf(chain)); }

int64_t LatestExpiryOf(const std::string& authorities) {
  return std::ranges::max(ExpiriesOf(authorities));
}

KeyPair ReadKeyPair(const std::string& certificate_field,
                    const std::filesystem::path& certificate_path, const std::string& key_field,
                    const std::filesystem::path& key_path) {
  KeyPair pair{.certificates = ReadCertificates(certificate_field, certificate_path),
               .key = ReadSmallFile(key_field, key_path, kMaxPemBytes)};
  const KeyPointer key = ParseKey(key_field, key_path, pair.key);
  const X509Pointer first = FirstOf(pair.certificates);
  if (X509_check_private_key(first.get(), key.get()) != 1) {
    throw Unusable(key_field, key_path, "is not the key of " + certificate_path.string());
  }
  // Detects what the handshake would refuse, such as a key that is too short.
  const Context context(SSL_CTX_new(TLS_method()), SSL_CTX_free);
  ERR_clear_error();
  if (SSL_CTX_use_certificate(context.get(), first.get()) != 1) {
    throw Unusable(certificate_field, certificate_path, "cannot be used: " + LastReason());
  }
  if (SSL_CTX_use_PrivateKey(context.get(), key.get()) != 1) {
    throw Unusable(key_field, key_path, "cannot be used: " + LastReason());
  }
  return pair;
}

}  // namespace choreo
