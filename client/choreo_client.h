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
#include "model/messages/quality_report.h"
#include "model/motion/motion.h"
#include "model/motion/velocity_factors.h"

/// The client of a choreod, in plain C++ without protobuf or gRPC types.
///
/// Conventions are those of model/motion/: right-handed, Y up, metres, radians, seconds; rotations
/// are axis-angle, local to the parent. Frames are numbered from the start of the music, at the
/// model's rate except FrameBlock::first_frame. Every failure is a choreo::Error with the server's
/// message, which names field, value and limit.
namespace choreo::client {

/// Which servers to call, and how patiently.
struct Options {
  /// HOST:PORT or unix:PATH. Several are replicas: if one fails, or has another fingerprint than
  /// the dance, the next is tried. Calls take turns at the addresses of one name, and skip those
  /// whose health is not serving, unless `even_draining`.
  std::vector<std::string> addresses = {"127.0.0.1:" + std::to_string(kDefaultPort)};
  bool tls = false;
  /// PEM file of the authority to trust, with `tls`; empty: the system's.
  std::filesystem::path ca_certificate = {};
  /// With `tls`: accepts any certificate, even an expired one, to ask only whether a server lives.
  /// Excludes `token_file`, because anybody may answer.
  bool any_certificate = false;
  /// PEM files of a certificate and its key, with `tls`, if the server requires one.
  std::filesystem::path client_certificate = {}, client_key = {};
  /// The name in the server's certificate, with `tls`; empty: the one in its address.
  std::string server_name = {};
  /// File of the token that the server needs; reread for each call, so that it can be renewed.
  /// Requires `tls`, unless all addresses are on this machine.
  std::filesystem::path token_file = {};
  double connect_timeout_s = 5;  ///< per attempt at one address
  /// A server that is silent for this long during a call, even to pings, counts as lost, seconds;
  /// at least kMinSilence, or 0: never. Dances may pause longer.
  double silence_s = 5;
  double deadline_s = 0;  ///< for a call, from its first attempt to its last frame; 0: none
  /// How long to keep retrying, at one address or all of them, since a call last made progress,
  /// seconds. A time, not a count, because servers take time to come back. 0: no retries, so no
  /// resume either.
  double retry_s = 10;
  double first_backoff_s = 0.1;  ///< between attempts; doubled each time, up to 2 s
  /// Resumes on a server with another fingerprint if no other is left. The dance then continues
  /// differently: smoothly or, before the first continuation, with that server's own frames.
  /// `Resumed` reports it.
  bool allow_inexact_resume = false;
  /// Also calls servers that accept no new dances, to inspect them.
  bool even_draining = false;
  /// Called on a call's thread before each retry. Throws to end the call, if the caller knows that
  /// retrying is useless. May be empty.
  std::function<void()> before_retry = {};
  /// Told of each failure that is retried, after `before_retry`: whose it was, and what it was. May
  /// be empty.
  std::function<void(const std::string& address, const Error& failure)> retried = {};
};

/// A dance in progress: send requests while its frames arrive. When its server is lost, it resumes
/// on the next one from the last continuation, frame for frame as if nothing had happened.
///
/// One thread may call Next while others call the rest. Only Next blocks: requests wait in memory.
class RemoteDance {
 public:
  ~RemoteDance();  ///< Cancel()s a dance that has not ended
  RemoteDance(const RemoteDance&) = delete;
  RemoteDance& operator=(const RemoteDance&) = delete;

  /// The next interleaved samples of a kPcmFloat dance.
  void SendSamples(std::span<const float> interleaved);
  /// The next bytes of a kFile dance.
  void SendBytes(std::span<const std::byte> bytes);
  void EndAudio();
  void SendKey(const KeyPose& key);
  void RemoveKey(const std::string& id);
  /// Each replaces the earlier one of its kind (velocity factors: for the named parts) from the
  /// first unfrozen frame: that of the last GenerateUntil or, without, the one after the last key.
  /// Must come before CompleteKeys.
  void SendControls(const ControlRequest& controls);
  /// Frames before `frame` are final and come; later keys may still change. To edit keys, also set
  /// DanceConfig::generate_until: until this is called each key grants the frames up to itself.
  void GenerateUntil(int64_t frame);
  /// Beats ahead, seconds, strictly ascending, at least one: from the first on they replace known
  /// ones, for transitions that begin after the frozen frames. `downbeats`: those that begin a bar.
  /// `confidence`, 0 to 1: of a client that predicts them from the music it sends; such beats are
  /// not reported in silence. Must come before CompleteKeys.
  void SendBeats(std::span<const double> seconds, std::span<const double> downbeats = {},
                 std::optional<double> confidence = {});
  /// Passages ahead, ascending, at least one: from the first on they replace known ones, for
  /// transitions that begin after the frozen frames. Must come before CompleteKeys.
  void SendPassages(std::span<const Passage> passages);
  /// Says that no more keys will come, so that the rest may be made.
  void CompleteKeys();

  /// The next message; blocks. Returns nullopt after Report. Throws Error if the dance failed for
  /// good.
  std::optional<Message> Next();
  /// Ends the dance; a concurrent Next throws Error(kCancelled). Idempotent.
  void Cancel() noexcept;

 private:
  friend class Client;
  struct Impl;
  explicit RemoteDance(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// A complete dance.
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

using choreo::RankBy;

/// A request for a single transition.
struct TransitionRequest {
  DanceConfig config = {};  ///< its audio format is taken from `audio`
  int frames = 0;           ///< at the model's rate, 1 to ModelDescription::max_transition_frames
  std::optional<Pose> target = {};  ///< at the last frame
  PoseMask target_mask = {};
  std::optional<double> target_hit = {};  ///< KeyPose::hit; with `after` only on the way there
  std::string target_id = {};             ///< its name in warnings and the report; empty: "target"
  Audio audio = {};
  int64_t audio_first_sample =
      0;  ///< number of its first sample, counted from the start of the music
  std::vector<Pose> after = {};  ///< frames that follow, at most 60
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

/// A client of one server or of several replicas. Connects when needed. Thread-safe.
class Client {
 public:
  /// Throws Error(kInvalidArgument) for unusable options.
  explicit Client(Options options = {});
  ~Client();
  Client(Client&&) noexcept;
  Client& operator=(Client&&) noexcept;

  ServerDescription GetServerInfo() const;
  /// Whether the server is healthy: false while it drains.
  bool IsServing() const;

  /// Starts a dance that is steered while it runs.
  std::unique_ptr<RemoteDance> StartDance(const DanceConfig& config) const;

  /// A whole dance to known music through known keys. `config.audio` is taken from `audio`. Calls
  /// `observer`, if any, with each message.
  DanceResult Dance(DanceConfig config, const std::vector<KeyPose>& keys, const Audio& audio,
                    const std::function<void(const Message&)>& observer = {}) const;
  /// The same into `result`, which keeps the received frames if the dance fails.
  void Dance(DanceConfig config, const std::vector<KeyPose>& keys, const Audio& audio,
             const std::function<void(const Message&)>& observer, DanceResult* result) const;

  TransitionResult GenerateTransition(const TransitionRequest& request) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace choreo::client
