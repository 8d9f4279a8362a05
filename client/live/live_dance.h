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
#include "client/live/cues.h"
#include "client/live/midi_clock.h"
#include "client/live/pose_player.h"
#include "client/live/sound.h"
#include "model/audio/beats/beat_hint.h"
#include "model/audio/beats/beats_ahead.h"
#include "model/core/limits.h"

namespace choreo::live {

inline constexpr double kMaxAheadSeconds = 60;  ///< limit of a cue's delay

/// Options of a live dance.
struct LiveOptions {
  client::DanceConfig config = {};         ///< Run sets `audio` and `generate_until`
  std::vector<client::KeyPose> keys = {};  ///< known from the beginning
  std::map<std::string, Pose> poses = {};  ///< for cues, by name
  double ahead_s = 1;                      ///< least delay from a cue to its pose, on a beat
  double look_ahead_s = 0.3;               ///< frames nearer than this are already generated
  BeatHint beats = {};                     ///< a hint about the beats of the music
  double seconds = std::numeric_limits<double>::infinity();  ///< limit of the music
  int most_keys = kMaxKeys;  ///< limit of the server for one dance, including keys taken back
};

/// Progress of a live dance: frames and keys since the last report, and the present tempo.
struct LiveFigures {
  double seconds = 0;  ///< length of the music so far
  int64_t frames = 0, late = 0;
  double most_late_ms = 0;           ///< the largest delay of a late frame
  std::optional<double> tempo = {};  ///< beats per minute of the dance
  double confidence = 0;
  int keys_taken = 0, keys_danced = 0, keys_refused = 0;
};

/// Callbacks during a dance, one thread at a time.
struct LiveObserver {
  std::function<bool()> go_on;  ///< called before each piece of music; false ends the dance
  std::function<void(const LiveFigures&)>
      figures;  ///< called every second, and once at the end for everything
  std::function<void(const std::string&)> note;  ///< called with printable notes, a few per second
  /// Returns the latest failure that the client has retried, if any. May be empty.
  std::function<std::optional<Error>()> failure = {};
  PosePlayer::Show show = {};  ///< shows frames at their times; may be empty
};

/// Dances to live music. Each frame is shown later than its music by the sum of the model's
/// look-ahead, one piece of sound, and 50 ms. Frames that arrive after that are late.
class LiveDance {
 public:
  LiveDance(const client::Client& client, const client::ModelDescription& model,
            LiveOptions options, LiveObserver observer);
  ~LiveDance();

  /// Dances until the music ends or `go_on` returns false. Throws Error if the dance fails, or is
  /// refused until the music is over; keeps the received frames. `midi`: a source of beats, or
  /// null.
  void Run(Sound& sound, std::span<const std::unique_ptr<Cues>> cues, MidiClock* midi = nullptr);

  const client::Header& header() const { return header_; }
  const Motion& motion() const { return motion_; }
  const std::vector<Contacts>& contacts() const { return contacts_; }
  /// The server's other messages, and its report once the dance has ended normally.
  const std::vector<client::Beat>& beats() const { return beats_; }
  const std::vector<client::Warning>& warnings() const { return warnings_; }
  const std::optional<client::Report>& report() const { return report_; }
  /// The keys that the server reported as reached.
  const std::vector<client::KeyReached>& reached() const { return reached_; }
  /// The danced keys, in order of time; of an interrupted dance, the reached ones. Throws
  /// Error(kInternal) if the server names a key that it was not sent.
  std::vector<client::KeyPose> DancedKeys() const;

 private:
  // The functions below run on the thread of Run.
  void Play(Sound& sound, std::span<const std::unique_ptr<Cues>> cues, MidiClock* midi);
  bool IsHinted() const { return options_.beats != BeatHint(); }
  void SendBeats(BeatsAhead ahead, double now);
  void Follow(const Cue& cue, double now);
  void TakeBack();
  void Refuse(const std::string& reason);
  void SendKey(const client::KeyPose& key, int64_t frame);
  std::optional<int64_t> KeyNear(int64_t frame) const;
  int64_t FrameAt(double seconds) const;
  void ShowFigures(double seconds);
  void RequireBegun();

  // The functions below run on the reading thread.
  void Read();
  void Handle(const client::Message& message);
  void HandleFrames(const client::FrameBlock& block);
  void Note(const std::string& text);

  const client::Client& client_;
  const client::ModelDescription& model_;
  const LiveOptions options_;
  const LiveObserver observer_;
  std::unique_ptr<client::RemoteDance> dance_;
  PosePlayer::Clock::time_point began_;

  std::map<int64_t, std::string> keys_;  // by frame: ids of keys sent and not taken back
  std::vector<int64_t> requested_;       // their frames, in the order of requests
  int64_t granted_ = 0;
  std::vector<client::KeyPose> sent_;  // including keys taken back

  client::Header header_;
  Motion motion_;
  std::vector<Contacts> contacts_;
  std::vector<client::Beat> beats_;
  std::vector<client::Warning> warnings_;
  std::vector<client::KeyReached> reached_;
  std::optional<client::Report> report_;
  std::exception_ptr failure_;
  std::unique_ptr<PosePlayer> player_;
  std::atomic<bool> begun_ = false, over_ = false;

  std::mutex mutex_;  // guards the members below and the observer
  BeatClock clock_;
  LiveFigures since_, all_;
  int notes_ = 0;  // since the last report
};

}  // namespace choreo::live
