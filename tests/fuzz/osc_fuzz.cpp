#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include "client/live/cues.h"
#include "tests/fuzz/fuzz.h"

namespace {

// Two processes have two ports.
uint16_t Port() { return static_cast<uint16_t>(20'000 + getpid() % 10'000); }

}  // namespace

FUZZ_TARGET(osc) {
  using namespace choreo;
  static const std::unique_ptr<live::Cues> cues = live::HearOsc(Port());
  static const int sender = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(Port());
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  sendto(sender, data, size, 0, reinterpret_cast<const sockaddr*>(&address), sizeof(address));
  for (const live::Cue& cue : cues->Take()) {
    // An impossible time is for who takes it to refuse.
    if (cue.ahead_s && cue.pose.empty()) fuzz::Fail("a time of no pose");
  }
  return 0;
}
