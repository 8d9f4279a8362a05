#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client/choreo_client.h"
#include "client/live/beat_clock.h"
#include "client/live/beat_ear.h"
#include "client/live/cues.h"
#include "client/live/midi_clock.h"
#include "client/live/pose_player.h"
#include "client/live/sound.h"
#include "model/core/limits.h"

namespace choreo::live {

inline constexpr double kMostAheadSeconds = 60;  ///< that a cue's pose may come behind it

/// What a live dance is made with.
struct LiveOptions {
  client::DanceConfig config = {};         ///< `audio` and `generate_until` are set here
  std::vector<client::KeyPose> keys = {};  ///< that are known from the beginning
  std::map<std::string, Pose> poses = {};  ///< that cues may name
  double ahead_s = 1;                      ///< a cue's pose comes so long behind it, on a beat
  double look_ahead_s = 0.3;               ///< what is nearer than this is danced already
  double seconds = std::numeric_limits<double>::infinity();  ///< of music, at most
  int most_keys = kMaxKeys;  ///< that the server takes in one dance, those taken back included
};

/// How it goes: frames and keys since the last time, the pulse as it is now.
struct LiveFigures {
  double seconds = 0;  ///< of music so far
  int64_t frames = 0, late = 0;
  double most_late_ms = 0;           ///< of the late ones
  std::optional<double> tempo = {};  ///< beats a minute, of those that are danced to
  double confidence = 0;
  int keys_taken = 0, keys_danced = 0, keys_refused = 0;
};

/// Called while it goes on, by one thread at a time.
struct LiveObserver {
  std::function<bool()> go_on;                      ///< asked before each piece of music
  std::function<void(const LiveFigures&)> figures;  ///< each second, and once for all of it
  std::function<void(const std::string&)> note;     ///< for people, printable; few a second
  PosePlayer::Show show = {};                       ///< frames in time; may be empty
};

/// Dances to music while it sounds. A frame is shown as long behind its music as the model has to
/// hear ahead, a piece of sound takes, and 50 ms; one that comes later than that is late.
class LiveDance {
 public:
  LiveDance(const client::Client& client, const client::ModelDescription& model,
            LiveOptions options, LiveObserver observer);
  ~LiveDance();

  /// Until the music is over or nobody goes on. Throws Error when the dance fails; what came stays.
  /// `midi`: who knows the beats; may be null.
  void Run(Sound& sound, std::span<const std::unique_ptr<Cues>> cues, MidiClock* midi = nullptr);

  const client::Header& header() const { return header_; }
  const Motion& motion() const { return motion_; }
  const std::vector<Contacts>& contacts() const { return contacts_; }

 private:
  // Of the thread that runs.
  void Play(Sound& sound, std::span<const std::unique_ptr<Cues>> cues, MidiClock* midi);
  void SendBeats(BeatsAhead ahead, double now);
  void Follow(const Cue& cue, double now);
  void TakeBack();
  void Refuse(const std::string& reason);
  void SendKey(const client::KeyPose& key, int64_t frame);
  std::optional<int64_t> KeyNear(int64_t frame) const;
  int64_t FrameAt(double seconds) const;
  void Tell(double seconds);

  // Of the thread that reads.
  void Read();
  void Take(const client::Message& message);
  void TakeFrames(const client::FrameBlock& block);
  void Note(const std::string& text);

  const client::Client& client_;
  const client::ModelDescription& model_;
  const LiveOptions options_;
  const LiveObserver observer_;
  std::unique_ptr<client::RemoteDance> dance_;
  PosePlayer::Clock::time_point began_;

  std::map<int64_t, std::string> keys_;  // by frame: ids of those that were sent and not taken back
  std::vector<int64_t> asked_;           // their frames, in the order in which they were asked for
  int64_t granted_ = 0;
  int sent_ = 0;  // keys, those taken back included

  client::Header header_;
  Motion motion_;
  std::vector<Contacts> contacts_;
  std::exception_ptr failure_;
  std::unique_ptr<PosePlayer> player_;
  std::atomic<bool> over_ = false;

  std::mutex mutex_;  // guards what follows, and the observer
  BeatClock clock_;
  LiveFigures since_, all_;
  int notes_ = 0;  // since the last figures
};

}  // namespace choreo::live
