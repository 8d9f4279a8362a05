#include "bench/cold_start.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "bench/lateness.h"
#include "client/authoring/local_server.h"
#include "model/core/programs.h"

namespace choreo::bench {

ColdStart DanceFromStart(const client::Audio& song) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const auto since = [start] {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  };
  ColdStart cold;
  const auto server = authoring::LocalServer::Start(std::string(kShippedModels[0]));
  cold.listens_ms = since();
  const client::Client client({.addresses = {server->address()}});
  client.GetServerInfo();  // commands ask for it first
  const auto dance = client.StartDance({.seed = 1, .audio = song.format});
  SendKeys(*dance, 2, 1);
  dance->SendSamples(song.samples);
  dance->EndAudio();
  while (const std::optional<client::Message> message = dance->Next())
    if (cold.first_frame_ms == 0 && std::holds_alternative<client::FrameBlock>(*message))
      cold.first_frame_ms = since();
  return cold;
}

}  // namespace choreo::bench
