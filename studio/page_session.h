#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "client/live/music_ear.h"
#include "studio/studio_context.h"

namespace choreo::studio {

/// Serves one page's calls. Dances run concurrently; all other calls run one after another in
/// order. A failing call is answered by a Failure and does not affect others.
class PageSession {
 public:
  /// Called from any thread, one call at a time.
  using Send = std::function<void(const Response&)>;

  /// `context` must outlive it. Sends the Welcome.
  PageSession(const StudioContext& context, Send send);
  /// Ends all calls; waits only for a transition in progress.
  ~PageSession();
  PageSession(const PageSession&) = delete;
  PageSession& operator=(const PageSession&) = delete;

  /// Only forwards the request, but waits for the readers of dances that end or have ended. Call
  /// from one thread.
  void Receive(Request request);

 private:
  /// A dance in progress, and the thread that reads its frames.
  struct Dancing {
    std::unique_ptr<client::RemoteDance> dance;
    std::unique_ptr<live::MusicEar> ear;  // of a live dance
    int channels = 0;                     // of its music
    int64_t granted = 0;                  // granted frames of a live dance
    bool over = false;                    // guarded by mutex_
    std::jthread reader;                  // last: uses the others
  };

  void ReceiveLive(uint32_t call, const v1::StreamDanceRequest& request);
  /// Sends a live dance the beats and repeats predicted from its music.
  void ListenTo(const v1::Audio& audio, Dancing* dancing);
  void ReceiveLiveBeats(uint32_t call, const LiveBeats& beats);
  void StartDance(uint32_t call, const Dance& request);
  /// Sends warnings, at the keys' frames, about poses that human bodies cannot reach.
  void SendFaults(uint32_t call, const std::vector<client::KeyPose>& keys, int64_t first_frame = 0);
  void ReadDance(uint32_t call, Dancing* dancing);
  void EndDance(uint32_t call);
  void Reap();

  /// Runs the calls that are handled in order.
  void Work();
  void Do(const Request& request);
  void ReceiveSong(uint32_t call, const File& file);

  std::shared_ptr<const Song> song() const;
  void Answer(uint32_t call, Response response);
  void Fail(uint32_t call, const std::string& message);

  const StudioContext& context_;
  const Send send_;
  std::map<uint32_t, Dancing> dances_;  // used by the thread of Receive

  mutable std::mutex mutex_;
  std::mutex sending_;
  std::condition_variable changed_;
  bool stop_ = false;
  std::deque<Request> queue_;
  std::shared_ptr<const Song> song_;
  std::thread worker_;
};

}  // namespace choreo::studio
