#include "bench/edited_dance.h"

#include <chrono>
#include <cmath>
#include <span>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "client/authoring/keys/pose_library.h"
#include "model/core/error.h"
#include "model/core/grid.h"

namespace choreo::bench {
namespace {

constexpr int kEditsASecond = 30;
constexpr double kLookAhead_s = 0.5, kKeyEach_s = 2;

// Plays the song and moves the key, edit by edit.
void Play(client::RemoteDance& dance, const client::Audio& song, const std::atomic<bool>& over) {
  const std::vector<authoring::LibraryPose>& poses = authoring::PoseLibrary();
  const auto samples =
      static_cast<size_t>(song.format.sample_rate / kEditsASecond * song.format.channels);
  const auto start = std::chrono::steady_clock::now();
  size_t played = 0;
  for (int64_t edit = 0; !over; ++edit) {
    const double now_s = static_cast<double>(edit) / kEditsASecond;
    std::this_thread::sleep_until(start + std::chrono::duration<double>(now_s));
    if (played + samples > song.samples.size()) played = 0;
    dance.SendSamples(std::span(song.samples).subspan(played, samples));
    played += samples;
    dance.GenerateUntil(std::llround((now_s + kLookAhead_s) * kModelFps));
    // The next key that is not yet granted.
    const auto number = static_cast<int64_t>((now_s + 2 * kLookAhead_s) / kKeyEach_s) + 1;
    client::KeyPose key;
    key.id = std::to_string(number);
    key.time_s = static_cast<double>(number) * kKeyEach_s;
    key.pose = poses[static_cast<size_t>(number) % poses.size()].pose;
    key.pose.root_position.x() += 0.3 * std::sin(now_s);
    dance.SendKey(key);
  }
  dance.Cancel();
}

}  // namespace

int64_t DanceEdited(const client::Client& client, const client::Audio& song, uint64_t seed,
                    const std::atomic<bool>& over) {
  const auto dance =
      client.StartDance({.seed = seed, .audio = song.format, .generate_until = int64_t{0}});
  std::thread player([&] { Play(*dance, song, over); });
  int64_t frames = 0;
  try {
    while (const std::optional<client::Message> message = dance->Next())
      if (const auto* block = std::get_if<client::FrameBlock>(&*message))
        frames += static_cast<int64_t>(block->poses.size());
  } catch (const Error& error) {
    player.join();
    if (error.code() != ErrorCode::kCancelled) throw;
    return frames;
  }
  player.join();
  return frames;
}

}  // namespace choreo::bench
