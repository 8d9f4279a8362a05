#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client/dance_config.h"
#include "client/dance_messages.h"
#include "client/server_description.h"
#include "model/core/error.h"
#include "model/core/limits.h"
#include "model/motion/motion.h"
#include "model/motion/velocity_factors.h"

/// The client of a choreod, in plain C++: no protobuf or gRPC type appears here.
///
/// Conventions are model/motion/'s: right-handed, Y up, metres, radians, seconds; rotations are
/// axis-angle, local to the parent. Frames are numbered from the start of the music; all but
/// FrameBlock::first_frame at the model's rate. Every failure is a choreo::Error with the server's
/// own words, which name field, value and limit.
namespace choreo::client {

/// How to reach the servers, and how patiently.
struct Options {
  /// HOST:PORT or unix:PATH. Several are replicas: when one fails, or is of another fingerprint
  /// than the dance, the next is asked. Calls take turns at the addresses of one name, and pass
  /// those whose health says that they do not serve, unless `even_draining`.
  std::vector<std::string> addresses = {"127.0.0.1:" + std::to_string(kDefaultPort)};
  bool tls = false;
  /// PEM file of the authority to trust, where `tls`; empty: the system's.
  std::filesystem::path ca_certificate = {};
  /// PEM files of a certificate and its key, where `tls` and the server wants to see one.
  std::filesystem::path client_certificate = {}, client_key = {};
  /// Whose certificate the server must have, where `tls`; empty: the one of its address.
  std::string server_name = {};
  /// File of the token that the server wants: sent with each call, and read again for each, so
  /// that it can be renewed. Needs `tls`, unless all addresses are of this machine.
  std::filesystem::path token_file = {};
  double connect_timeout_s = 5;  ///< for one attempt at one address
  /// A server of which nothing is heard for so long during a call, not even the answer to a ping,
  /// is taken for lost, seconds; at least kMinSilence, or 0: never. Dances may pause longer.
  double silence_s = 5;
  double deadline_s = 0;  ///< for a call, from its first attempt to its last frame; 0: none
  /// How long to try again and again, at one address or at all of them, since a call last made
  /// progress, seconds. A time, not a count: it is what a server takes to come back that matters.
  /// 0: not at all, so no resume either.
  double retry_s = 10;
  double first_backoff_s = 0.1;  ///< between tries; doubled with each, up to 2 s
  /// Go on when only a server of another fingerprint is left: smoothly, yet not as the dance would
  /// have gone. `Resumed` says so.
  bool allow_inexact_resume = false;
  /// Ask servers, too, that take no new dances: for who looks at them.
  bool even_draining = false;
  /// Called, on the thread of a call, before it is tried again; what this throws ends it. For those
  /// who know that there is no use. None if empty.
  std::function<void()> before_retry = {};
};

/// A dance in progress: say what is wanted while its frames arrive. When its server is lost, it
/// goes on with the next one from the last continuation, frame for frame as if nothing had
/// happened.
///
/// One thread may call Next while others call the rest. Nothing but Next blocks: what is said waits
/// its turn in memory.
class RemoteDance {
 public:
  ~RemoteDance();  ///< Cancel()s a dance that has not ended
  RemoteDance(const RemoteDance&) = delete;
  RemoteDance& operator=(const RemoteDance&) = delete;

  /// The next interleaved samples, of a kPcmFloat dance.
  void SendSamples(std::span<const float> interleaved);
  /// The next bytes of a kFile dance.
  void SendBytes(std::span<const std::byte> bytes);
  void EndAudio();
  void SendKey(const KeyPose& key);
  void RemoveKey(const std::string& id);
  /// Each replaces the earlier one of its kind (velocity factors: of the parts named) from the
  /// first frame that is not frozen: that of the last GenerateUntil or, without, the one behind the
  /// last key. Not after CompleteKeys.
  void SendControls(const Controls& controls);
  /// Frames before `frame` are final and come; later keys may still change. Who edits keys sets
  /// DanceConfig::generate_until, too: until this is said each key grants the frames up to itself.
  void GenerateUntil(int64_t frame);
  /// Beats ahead, seconds, strictly ascending, at least one: they replace those known from the
  /// first of them on, for transitions that begin behind the frozen frames. `downbeats`: those of
  /// them that begin a bar. Not after CompleteKeys.
  void SendBeats(std::span<const double> seconds, std::span<const double> downbeats = {});
  /// Passages ahead, ascending, at least one: from the first of them on they replace those known,
  /// for transitions that begin behind the frozen frames. Not after CompleteKeys.
  void SendPassages(std::span<const Passage> passages);
  /// No further keys: the rest may be made.
  void CompleteKeys();

  /// The next message; blocks. After Report comes nullopt. Throws Error when the dance failed for
  /// good.
  std::optional<Message> Next();
  /// Ends the dance; a Next in progress throws Error(kCancelled). Idempotent.
  void Cancel() noexcept;

 private:
  friend class Client;
  struct Impl;
  explicit RemoteDance(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// A dance that is complete.
struct DanceResult {
  Header header = {};
  Motion motion = {};
  std::vector<Contacts> contacts = {};
  std::vector<Beat> beats = {};
  std::vector<Warning> warnings = {};
  std::vector<KeyRejected> rejected = {};
  Report report = {};
  int resumes = 0;
};

/// What candidates are ranked by: steering, support and skating, or likelihood alone.
enum class RankBy { kQuality, kLikelihood };

/// One transition, alone.
struct TransitionRequest {
  DanceConfig config = {};  ///< its audio format is taken from `audio`
  int frames = 0;           ///< at the model's rate, 1 to ModelDescription::max_transition_frames
  std::optional<Pose> target = {};  ///< of the last frame
  PoseMask target_mask = {};
  std::string target_id = {};  ///< how warnings and the report call it; empty: "target"
  Audio audio = {};
  int64_t audio_first_sample =
      0;  ///< number of its first sample, counted from the start of the music
  std::vector<Pose> after = {};  ///< frames to lead into, at most 60
  int candidates = 1;            ///< 1 to kMaxCandidates
  RankBy rank_by = RankBy::kQuality;
};

struct TransitionCandidate {
  uint32_t candidate = 0;
  Motion motion = {};
  std::vector<Contacts> contacts = {};
  Report report = {};
  Continuation continuation = {};
};

struct TransitionResult {
  Header header = {};
  std::vector<TransitionCandidate> candidates = {};  ///< best first
  std::vector<Warning> warnings = {};
};

/// A client of one server or of several replicas. Connections are made when needed. Thread-safe.
class Client {
 public:
  /// Throws Error(kInvalidArgument) for options that cannot be used.
  explicit Client(Options options = {});
  ~Client();
  Client(Client&&) noexcept;
  Client& operator=(Client&&) noexcept;

  ServerDescription GetServerInfo() const;
  /// What the server says of its health: false while it drains.
  bool IsServing() const;

  /// Begins a dance that is steered while it goes on.
  std::unique_ptr<RemoteDance> StartDance(const DanceConfig& config) const;

  /// A whole dance to known music through known keys. `config.audio` is taken from `audio`.
  /// `observer`, if any, sees each message as it comes.
  DanceResult Dance(DanceConfig config, const std::vector<KeyPose>& keys, const Audio& audio,
                    const std::function<void(const Message&)>& observer = {}) const;
  /// The same into `result`, which holds what came if the dance fails on the way.
  void Dance(DanceConfig config, const std::vector<KeyPose>& keys, const Audio& audio,
             const std::function<void(const Message&)>& observer, DanceResult* result) const;

  TransitionResult GenerateTransition(const TransitionRequest& request) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace choreo::client
