#include "server/connections/frame_guard.h"

#include <dlfcn.h>
#include <openssl/ssl.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>

#include "server/connections/caller.h"
#include "server/connections/frame_meter.h"
#include "server/connections/handshakes.h"

namespace choreo {
namespace {

constexpr std::chrono::seconds kBetweenFloodReports{1};

/// An accepted connection.
struct Guarded {
  uint64_t cookie = 0;  ///< the socket's: a descriptor may be in use again
  std::string peer;
  bool encrypted = false;
  std::shared_ptr<HeldOff> held_off;
  FrameMeter meter = {};
  /// Of an encrypted connection.
  enum class Handshake { kNotBegun, kBegun, kOver };
  std::atomic<Handshake> handshake = Handshake::kNotBegun;
};

struct Guardeds {
  std::mutex mutex;
  std::unordered_map<int, std::shared_ptr<Guarded>> by_descriptor;  // lock: mutex
};

Guardeds& All() {
  static auto* all = new Guardeds;  // gRPC's threads outlive main()
  return *all;
}

std::atomic<uint64_t> header_floods = 0, empty_frame_floods = 0;
/// The connection whose bytes this thread read last; gRPC decrypts them next.
thread_local std::weak_ptr<Guarded> last_read;

uint64_t CookieOf(int connection) {
  uint64_t cookie = 0;
  socklen_t size = sizeof cookie;
  if (getsockopt(connection, SOL_SOCKET, SO_COOKIE, &cookie, &size) != 0) return 0;
  return cookie;
}

std::shared_ptr<Guarded> Find(int connection) {
  Guardeds& all = All();
  const std::lock_guard lock(all.mutex);
  const auto found = all.by_descriptor.find(connection);
  if (found == all.by_descriptor.end()) return nullptr;
  if (found->second->cookie == CookieOf(connection)) return found->second;
  all.by_descriptor.erase(found);
  return nullptr;
}

/// Logs at most one line a second, because floods come in groups.
void Tell(FrameMeter::Flood flood, const std::string& peer) {
  static std::mutex mutex;
  static std::chrono::steady_clock::time_point next_report;
  const bool headers = flood == FrameMeter::Flood::kHeaders;
  const uint64_t so_far = headers ? ++header_floods : ++empty_frame_floods;
  const auto now = std::chrono::steady_clock::now();
  const std::lock_guard lock(mutex);
  if (now < next_report) return;
  next_report = now + kBetweenFloodReports;
  const std::string what =
      headers ? std::to_string(FrameMeter::kMostHeaderBytes >> 10) + " KiB of headers for one call"
              : std::to_string(FrameMeter::kMostEmptyFrames) +
                    " frames in a second, of little content or none";
  spdlog::warn("{} has sent more than {}; its connection is closed, of {} so far", peer, what,
               so_far);
}

/// `connection`: null if no longer known.
bool MeterBytes(FrameMeter& meter, const void* bytes, size_t count, const Guarded* connection) {
  if (meter.flooded()) return false;  // gRPC tries again before it closes the connection
  const FrameMeter::Flood flood = meter.Read({static_cast<const uint8_t*>(bytes), count});
  if (flood == FrameMeter::Flood::kNone) return true;
  if (connection != nullptr && connection->held_off)
    connection->held_off->Add(AddressOf(connection->peer));
  Tell(flood, connection != nullptr ? connection->peer : "somebody");
  return false;
}

/// Whether the received bytes may be passed to gRPC.
bool MeterMessage(Guarded& connection, const msghdr& message, size_t count) {
  for (size_t i = 0; i < message.msg_iovlen && count > 0; ++i) {
    const size_t part = std::min(count, message.msg_iov[i].iov_len);
    if (!MeterBytes(connection.meter, message.msg_iov[i].iov_base, part, &connection)) return false;
    count -= part;
  }
  return true;
}

void Forget(void* /*ssl*/, void* meter, CRYPTO_EX_DATA* /*data*/, int /*index*/, long /*argument*/,
            void* /*pointer*/) {
  delete static_cast<FrameMeter*>(meter);
}

FrameMeter& MeterOf(SSL* ssl) {
  static const int index = SSL_get_ex_new_index(0, nullptr, nullptr, nullptr, Forget);
  auto* meter = static_cast<FrameMeter*>(SSL_get_ex_data(ssl, index));
  if (meter == nullptr) SSL_set_ex_data(ssl, index, meter = new FrameMeter);
  return *meter;
}

void NoteHandshakeOver() {
  const auto connection = last_read.lock();
  if (connection) connection->handshake = Guarded::Handshake::kOver;
}

// Counts a client that has ended its connection in the handshake.
void NoteEnd(Guarded& connection) {
  if (connection.handshake.exchange(Guarded::Handshake::kOver) == Guarded::Handshake::kBegun)
    CountClientLeft();
}

template <class Function>
Function* Next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

void GuardFrames(int connection, bool encrypted, std::shared_ptr<HeldOff> held_off) {
  auto guarded = std::make_shared<Guarded>(CookieOf(connection), PeerOf(connection), encrypted,
                                           std::move(held_off));
  Guardeds& all = All();
  const std::lock_guard lock(all.mutex);
  all.by_descriptor[connection] = std::move(guarded);
}

uint64_t HeaderFloods() { return header_floods; }
uint64_t EmptyFrameFloods() { return empty_frame_floods; }
void CountCallFlood() { ++empty_frame_floods; }

}  // namespace choreo

// These definitions replace the libraries' own in every program linked with this file.
extern "C" {

__attribute__((visibility("default"))) ssize_t recvmsg(int descriptor, msghdr* message, int flags) {
  static auto* const next = choreo::Next<decltype(recvmsg)>("recvmsg");
  const ssize_t count = next(descriptor, message, flags);
  const int fault = errno;
  const bool ends = count == 0 || (count < 0 && fault == ECONNRESET);
  if ((count < 0 && !ends) || flags != 0) return count;
  const auto connection = choreo::Find(descriptor);
  errno = fault;
  if (!connection) return count;
  if (ends) {
    choreo::NoteEnd(*connection);
    return count;
  }
  choreo::last_read = connection;
  if (connection->encrypted) {
    auto not_begun = choreo::Guarded::Handshake::kNotBegun;
    connection->handshake.compare_exchange_strong(not_begun, choreo::Guarded::Handshake::kBegun);
    return count;
  }
  if (choreo::MeterMessage(*connection, *message, static_cast<size_t>(count))) return count;
  errno = ECONNRESET;
  return -1;
}

__attribute__((visibility("default"))) int SSL_do_handshake(SSL* ssl) {
  static auto* const next = choreo::Next<decltype(SSL_do_handshake)>("SSL_do_handshake");
  const int result = next(ssl);
  if (result == 1 && SSL_is_server(ssl) != 0) choreo::NoteHandshakeOver();
  return result;
}

__attribute__((visibility("default"))) int SSL_read(SSL* ssl, void* bytes, int size) {
  static auto* const next = choreo::Next<decltype(SSL_read)>("SSL_read");
  const int count = next(ssl, bytes, size);
  if (count <= 0 || SSL_is_server(ssl) == 0) return count;
  const auto connection = choreo::last_read.lock();
  if (choreo::MeterBytes(choreo::MeterOf(ssl), bytes, static_cast<size_t>(count), connection.get()))
    return count;
  return -1;  // SSL_get_error reports this as a transport failure
}
}
