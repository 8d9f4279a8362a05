#pragma once

#include <arpa/inet.h>
#include <fcntl.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <mutex>
#include <queue>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace choreo {

/// Two network namespaces, joined only by a wire with faults: it loses IP packets, delays them,
/// reorders them, or is cut. Needs root.
class BadWire {
 public:
  struct Badness {
    double loss = 0;                      ///< share of the packets
    std::chrono::milliseconds delay{0};   ///< for each packet
    std::chrono::milliseconds spread{0};  ///< largest additional delay; later packets may overtake
  };

  /// Whether this process has the rights to create one.
  static bool MayMake() { return geteuid() == 0 && access("/dev/net/tun", R_OK | W_OK) == 0; }

  /// Moves the calling thread, and threads that it starts later, to the near end. The process's
  /// other threads stay. Calls `at_far_end` once at the far end.
  template <typename AtFarEnd>
  explicit BadWire(AtFarEnd&& at_far_end) {
    ends_[1] = EnterNewNamespace(kFar);
    at_far_end();
    ends_[0] = EnterNewNamespace(kNear);
    thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
  }
  ~BadWire() {
    thread_.request_stop();
    thread_.join();
    for (const int end : ends_) close(end);
  }
  BadWire(const BadWire&) = delete;
  BadWire& operator=(const BadWire&) = delete;

  static constexpr const char* kNear = "10.77.0.1";
  static constexpr const char* kFar = "10.77.0.2";

  void Be(const Badness& badness) {
    const std::lock_guard lock(mutex_);
    badness_ = badness;
  }
  void Cut() { Be({.loss = 1}); }
  int64_t passed() const { return passed_; }
  int64_t lost() const { return lost_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Packet {
    Clock::time_point due;
    int to = -1;
    std::vector<char> bytes;
    bool operator<(const Packet& other) const { return due > other.due; }  // earliest first
  };

  static void Require(bool done, const char* what) {
    if (!done) throw std::runtime_error(std::string(what) + ": " + std::strerror(errno));
  }

  // Enters a new namespace with loopback and a TUN device at this address. Returns the device's
  // descriptor.
  static int EnterNewNamespace(const char* address) {
    Require(unshare(CLONE_NEWNET) == 0, "a network namespace");
    const int device = open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC);
    ifreq request{};
    request.ifr_flags = IFF_TUN | IFF_NO_PI;
    std::strcpy(request.ifr_name, "wire");
    Require(ioctl(device, TUNSETIFF, &request) == 0, "a device");
    const int control = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const auto set = [&](const char* text, unsigned long what) {
      auto* value = reinterpret_cast<sockaddr_in*>(&request.ifr_addr);
      *value = {};
      value->sin_family = AF_INET;
      inet_pton(AF_INET, text, &value->sin_addr);
      Require(ioctl(control, what, &request) == 0, text);
    };
    set(address, SIOCSIFADDR);
    set("255.255.255.0", SIOCSIFNETMASK);
    for (const char* name : {"wire", "lo"}) {
      std::strcpy(request.ifr_name, name);
      request.ifr_flags = IFF_UP | IFF_RUNNING;
      Require(ioctl(control, SIOCSIFFLAGS, &request) == 0, name);
    }
    close(control);
    return device;
  }

  void Work(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      std::array<pollfd, 2> waited{pollfd{ends_[0], POLLIN, 0}, pollfd{ends_[1], POLLIN, 0}};
      poll(waited.data(), waited.size(), 1);
      for (int from = 0; from < 2; ++from) {
        while (Take(ends_[from], ends_[1 - from])) continue;
      }
      for (; !on_their_way_.empty() && on_their_way_.top().due <= Clock::now();
           on_their_way_.pop()) {
        const Packet& packet = on_their_way_.top();
        const ssize_t written = write(packet.to, packet.bytes.data(), packet.bytes.size());
        ++(written < 0 ? lost_ : passed_);
      }
    }
  }

  bool Take(int from, int to) {
    std::array<char, 65536> bytes;
    const ssize_t size = read(from, bytes.data(), bytes.size());
    if (size <= 0) return false;
    const std::lock_guard lock(mutex_);
    if (std::uniform_real_distribution(0.0, 1.0)(random_) < badness_.loss) {
      ++lost_;
      return true;
    }
    const std::chrono::milliseconds more(
        std::uniform_int_distribution<int64_t>(0, badness_.spread.count())(random_));
    on_their_way_.push(
        {Clock::now() + badness_.delay + more, to, {bytes.begin(), bytes.begin() + size}});
    return true;
  }

  std::array<int, 2> ends_{-1, -1};
  std::mutex mutex_;  // guards badness_
  Badness badness_;
  std::mt19937 random_{1};
  std::priority_queue<Packet> on_their_way_;
  std::atomic<int64_t> passed_ = 0, lost_ = 0;
  std::jthread thread_;
};

}  // namespace choreo
