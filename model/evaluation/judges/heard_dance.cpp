#include "model/evaluation/judges/heard_dance.h"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <iterator>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "model/audio/music/music_id.h"
#include "model/audio/music/passage_ear.h"
#include "model/audio/signal/format.h"
#include "model/dance/dance_stream.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

class Listener : public DanceSink {
 public:
  void OnFrames(int64_t, std::span<const Pose> poses, std::span<const Contacts>) override {
    poses_.insert(poses_.end(), poses.begin(), poses.end());
  }
  void OnEvent(const DanceEvent&) override {}
  void OnContinuation(const Continuation&) override {}
  void OnSummary(const QualityReport&) override { End(std::nullopt); }
  void OnError(const Error& error) override { End(error); }

  std::vector<Pose> Wait() {
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [this] { return is_over_; });
    if (error_) throw *error_;
    return std::move(poses_);
  }

 private:
  void End(const std::optional<Error>& error) {
    const std::lock_guard lock(mutex_);
    error_ = error;
    is_over_ = true;
    ended_.notify_all();
  }

  std::vector<Pose> poses_;
  std::mutex mutex_;
  std::condition_variable ended_;
  std::optional<Error> error_;
  bool is_over_ = false;
};

ValidDance ValidMonoDance(const SampleQueue& queue, DanceConfig config) {
  config.audio = DanceConfig::Audio{kModelSampleRate, 1, 0};
  config.generate_until = 0;
  return ValidDance(std::move(config), queue.model());
}

}  // namespace

std::vector<Pose> DanceTo(SampleQueue& queue, std::span<const float> mono, DanceConfig config,
                          std::span<const Key> keys, const ControlRequest& controls) {
  config.music_id = MusicId(mono);
  const auto listener = std::make_shared<Listener>();
  DanceStream stream(queue, ValidMonoDance(queue, std::move(config)), listener);
  if (controls.root_path || controls.velocity_factors) stream.SetControls(controls);
  for (const Key& key : keys) stream.SetKey(key, AtFrame{key.frame});
  stream.PushAudio(mono, 0);
  stream.HalfClose();
  return listener->Wait();
}

std::vector<Pose> DanceLiveTo(SampleQueue& queue, std::span<const float> mono, DanceConfig config) {
  constexpr size_t kPiece = kModelSampleRate / 10;
  constexpr double kLookAhead_s = 0.3;  // choreo live's default
  const auto listener = std::make_shared<Listener>();
  DanceStream stream(queue, ValidMonoDance(queue, std::move(config)), listener);
  PassageEar ear;
  for (size_t at = 0; at < mono.size(); at += kPiece) {
    const std::span<const float> piece = mono.subspan(at, std::min(kPiece, mono.size() - at));
    if (const std::optional<Passage> passage = ear.Hear(piece)) stream.GivePassages({*passage});
    const double now = static_cast<double>(at + piece.size()) / kModelSampleRate;
    stream.GenerateUntil(std::llround((now + kLookAhead_s) * kModelFps));
    stream.PushAudio(piece, static_cast<int64_t>(at));
  }
  stream.HalfClose();
  return listener->Wait();
}

std::vector<Key> KeysOf(std::span<const Pose> dance) {
  std::vector<Key> keys;
  for (size_t frame = kTypicalFrames; frame < dance.size(); frame += kTypicalFrames) {
    Pose pose = dance[frame];
    // A dance's rotations are continuous, a key's at most half a turn.
    for (auto rotation : pose.rotations.colwise())
      rotation = NearestBranch(rotation, Eigen::Vector3d::Zero());
    keys.push_back({std::to_string(frame),
                    static_cast<int64_t>(frame),
                    std::move(pose),
                    {.root_position = false, .joints = {}}});
  }
  return keys;
}

ControlRequest Circle(size_t frames) {
  constexpr double kRadius = 0.75, kAround = 24 * 30;
  RootPath path;
  for (size_t frame = 0; frame < frames; frame += 15) {
    path.frames.push_back(static_cast<int64_t>(frame));
    const double turn = 2 * std::numbers::pi * static_cast<double>(frame) / kAround;
    path.points.emplace_back(kRadius * std::sin(turn), kRadius * (1 - std::cos(turn)));
  }
  ControlRequest controls;
  controls.root_path = std::move(path);
  return controls;
}

}  // namespace choreo
