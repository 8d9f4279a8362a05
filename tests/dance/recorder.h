#pragma once

#include <chrono>
#include <condition_variable>
#include <cstring>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "model/dance/dance_stream.h"
#include "tests/support/fake_sampler.h"

namespace choreo {

/// Records everything that a stream sends its listener.
struct Recording {
  int64_t first_frame = -1;
  std::vector<Pose> poses;
  std::vector<Contacts> contacts;
  std::vector<KeyReached> reached;
  std::vector<KeyRejected> rejected;
  std::vector<Warning> warnings;
  std::vector<Beat> beats;
  std::vector<Continuation> continuations;
  std::vector<size_t> beats_before;  ///< each continuation
  std::optional<QualityReport> summary;
  std::optional<Error> error;
  bool in_order = true;     ///< no gap between frames
  int calls_after_end = 0;  ///< must stay 0

  bool ended() const { return summary.has_value() || error.has_value(); }
};

class Recorder : public DanceSink {
 public:
  /// Called with the count of frames so far, before the test can see the last of them.
  std::function<void(size_t frames)> on_frames;

  void OnFrames(int64_t first_frame, std::span<const Pose> poses,
                std::span<const Contacts> contacts) override {
    if (on_frames) on_frames(Snapshot().poses.size() + poses.size());
    std::lock_guard lock(mutex_);
    Note();
    if (recording_.first_frame < 0) recording_.first_frame = first_frame;
    const auto expected = recording_.first_frame + static_cast<int64_t>(recording_.poses.size());
    recording_.in_order &= first_frame == expected && poses.size() == contacts.size();
    recording_.poses.insert(recording_.poses.end(), poses.begin(), poses.end());
    recording_.contacts.insert(recording_.contacts.end(), contacts.begin(), contacts.end());
    changed_.notify_all();
  }
  void OnEvent(const DanceEvent& event) override {
    std::lock_guard lock(mutex_);
    Note();
    if (const auto* key = std::get_if<KeyReached>(&event)) recording_.reached.push_back(*key);
    if (const auto* late = std::get_if<KeyRejected>(&event)) recording_.rejected.push_back(*late);
    if (const auto* warn = std::get_if<Warning>(&event)) recording_.warnings.push_back(*warn);
    if (const auto* beat = std::get_if<Beat>(&event)) recording_.beats.push_back(*beat);
    changed_.notify_all();
  }
  void OnContinuation(const Continuation& continuation) override {
    std::lock_guard lock(mutex_);
    Note();
    recording_.continuations.push_back(continuation);
    recording_.beats_before.push_back(recording_.beats.size());
    changed_.notify_all();
  }
  void OnSummary(const QualityReport& report) override {
    std::lock_guard lock(mutex_);
    Note();
    recording_.summary = report;
    changed_.notify_all();
  }
  void OnError(const Error& error) override {
    std::lock_guard lock(mutex_);
    Note();
    recording_.error = error;
    changed_.notify_all();
  }

  /// Waits until the condition holds; throws after a minute, so that a test that hangs fails.
  Recording Wait(const std::function<bool(const Recording&)>& condition) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, std::chrono::minutes(1), [&] { return condition(recording_); })) {
      throw std::runtime_error("the dance stands still at frame " +
                               std::to_string(recording_.poses.size()));
    }
    return recording_;
  }
  Recording WaitForEnd() {
    return Wait([](const Recording& recording) { return recording.ended(); });
  }
  Recording WaitForFrames(size_t frames) {
    return Wait([frames](const Recording& recording) { return recording.poses.size() >= frames; });
  }
  Recording Snapshot() {
    std::lock_guard lock(mutex_);
    return recording_;
  }

 private:
  void Note() {
    if (recording_.ended()) ++recording_.calls_after_end;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  Recording recording_;
};

/// Whether b's frames, from its first one on, are a's, bit for bit, to the end of both.
inline bool SameDance(const Recording& a, const Recording& b) {
  const int64_t skip = b.first_frame - a.first_frame;
  if (skip < 0 || a.poses.size() != b.poses.size() + static_cast<size_t>(skip)) return false;
  for (size_t i = 0; i < b.poses.size(); ++i) {
    const size_t at = i + static_cast<size_t>(skip);
    if (a.poses[at].root_position != b.poses[i].root_position ||
        a.poses[at].rotations != b.poses[i].rotations || a.contacts[at] != b.contacts[i]) {
      return false;
    }
  }
  return !b.poses.empty();
}

/// The request, checked for a queue's model.
inline ValidDance Checked(const SampleQueue& queue, DanceConfig request) {
  return {std::move(request), queue.model()};
}
inline ValidGroup Checked(const SampleQueue& queue, GroupRequest request) {
  return {std::move(request), queue.model()};
}

/// A queue over workers of one model.
template <typename Model = FakeSampler>
std::unique_ptr<SampleQueue> QueueOf(int workers = 1, int max_bulk = 128) {
  return std::make_unique<SampleQueue>(FakeSamplers<Model>(workers),
                                       SampleQueue::Options{.max_bulk = max_bulk});
}
inline std::unique_ptr<SampleQueue> FakeQueue(int workers = 1, int max_bulk = 128) {
  return QueueOf<HearingSampler>(workers, max_bulk);
}

}  // namespace choreo
