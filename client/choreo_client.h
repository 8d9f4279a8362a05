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
#include "model/messages/quality_report.h"
#include "model/motion/controls/velocity_factors.h"
#include "model/motion/motion.h"
#include "network/protocol.h"

/// A client for choreod, in plain C++ without protobuf or gRPC types.
///
/// Conventions as in model/motion/: right-handed, Y up, metres, radians, seconds. Rotations are
/// axis-angle vectors, local to the parent. Frames are numbered from the start of the music, at the
/// model's rate except FrameBlock::first_frame. Every failure is a choreo::Error with the server's
/// message, which names the field, the value and the limit.
namespace choreo::client {

/// Servers, credentials, timeouts and retries of a Client.
struct Options {
  /// HOST:PORT or unix:PATH. Several are replicas: if one fails, or has another fingerprint than
  /// the dance, the next is tried. Calls take turns at the addresses of one name, and skip those
  /// whose health is not serving, unless `even_draining`.
  std::vector<std::string> addresses = {"127.0.0.1:" + std::to_string(kDefaultPort)};
  bool tls = false;
  /// PEM file of the authority to trust, with `tls`; empty: the system's.
  std::filesystem::path ca_certificate = {};
  /// With `tls`: accepts any certificate, even an expired one. For health checks alone. Excludes
  /// `token_file`, because an impostor may answer.
  bool any_certificate = false;
  /// PEM files of a certificate and its key, with `tls`, if the server requires one.
  std::filesystem::path client_certificate = {}, client_key = {};
  /// The name in the server's certificate, with `tls`; empty: the one in its address.
  std::string server_name = {};
  /// File of the token that the server needs; reread for each call, so that it can be renewed.
  /// Requires `tls`, unless all addresses are on this machine.
  std::filesystem::path token_file = {};
  double connect_timeout_s = 5;  ///< limit of one attempt to connect to one address, seconds
  /// Seconds after which a server that sends nothing during a call, not even answers to pings,
  /// counts as lost. At least kMinSilence; 0: never. Dances may pause longer.
  double silence_s = 5;
  double deadline_s = 0;  ///< seconds from a call's first attempt to its last frame; 0: no limit
  /// Seconds for which to keep retrying, at one address or all of them, since a call last made
  /// progress. This is a time, not a count, because servers take time to come back. 0: no retries,
  /// so no resumption either.
  double retry_s = 10;
  double first_backoff_s = 0.1;  ///< seconds before the first retry; doubled each time, up to 2 s
  /// Resumes on a server with another fingerprint if no server with the same one is left. The dance
  /// then continues differently: smoothly or, before the first continuation, with the new server's
  /// own frames. `Resumed` reports it.
  bool allow_inexact_resume = false;
  /// Also calls servers that accept no new dances, to inspect them.
  bool even_draining = false;
  /// Called before each retry, on the call's thread. It may throw to end the call if the caller
  /// knows that retrying is useless. May be empty.
  std::function<void()> before_retry = {};
  /// Called for each failure that is retried, after `before_retry`, with the address of the server
  /// that failed. May be empty.
  std::function<void(const std::string& address, const Error& failure)> retried = {};
};

class DanceCall;

/// A dance in progress, to which requests are sent while its frames arrive. If its server is lost,
/// the dance resumes on the next one from the last continuation, with exactly the frames of an
/// uninterrupted dance.
///
/// One thread may call Next while others call the other functions. Only Next blocks: requests are
/// queued in memory.
class RemoteDance {
 public:
  ~RemoteDance();  ///< cancels a dance that has not ended
  RemoteDance(const RemoteDance&) = delete;
  RemoteDance& operator=(const RemoteDance&) = delete;

  /// Sends the next interleaved samples of a kPcmFloat dance.
  void SendSamples(std::span<const float> interleaved);
  /// Sends the next bytes of a kFile dance.
  void SendBytes(std::span<const std::byte> bytes);
  void EndAudio();
  void SendKey(const KeyPose& key);
  void RemoveKey(const std::string& id);
  /// Sends controls. Each replaces the earlier control of its kind (velocity factors: of the named
  /// parts alone) from the first unfrozen frame on: the last GenerateUntil's or, without one, the
  /// frame after the last key. Call before CompleteKeys.
  void SendControls(const ControlRequest& controls);
  /// Lets the server generate the frames before `frame`, which are final. Later keys may still
  /// change. Until the first call, each key permits the frames up to itself. To edit keys, set
  /// DanceConfig::generate_until, which prevents this.
  void GenerateUntil(int64_t frame);
  /// Sends beats ahead: at least one, seconds, strictly ascending. From the first one on they
  /// replace known beats, for transitions that begin after the frozen frames. `downbeats`: the
  /// beats that begin a bar. `confidence`, 0 to 1: set it if you predict the beats from the music
  /// that you send; such beats are not reported in silence. Call before CompleteKeys.
  void SendBeats(std::span<const double> seconds, std::span<const double> downbeats = {},
                 std::optional<double> confidence = {});
  /// Sends passages ahead: at least one, ascending. From the first one on they replace known
  /// passages, for transitions that begin after the frozen frames. Call before CompleteKeys.
  void SendPassages(std::span<const Passage> passages);
  /// States that no more keys follow, so that the server may generate the rest of the dance.
  void CompleteKeys();

  /// Waits for the next message. Returns nullopt after Report. Throws Error if the dance failed and
  /// cannot be resumed.
  std::optional<Message> Next();
  /// Ends the dance; a concurrent Next throws Error(kCancelled). Idempotent.
  void Cancel() noexcept;

 private:
  friend class Client;
  friend DanceCall& CallOf(RemoteDance& dance);
  RemoteDance(std::unique_ptr<DanceCall> call, const AudioFormat& audio);

  std::unique_ptr<DanceCall> call_;
  AudioFormat audio_;
  int joints_ = 0;  // of the header's skeleton, used only by Next
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
  /// At the last frame; its own frame, time and hands are not sent. Hit, with `after`, only on the
  /// way there. An empty id is "target" in warnings and the report.
  std::optional<KeyPose> target = {};
  Audio audio = {};
  int64_t audio_first_sample =
      0;  ///< number of the first sample in `audio`, counted from the start of the music
  std::vector<Pose> after = {};  ///< frames that follow the transition, at most 60
  int candidates = 1;            ///< 1 to kMaxCandidates
  RankBy rank_by = RankBy::kQuality;
};

struct TransitionCandidate {
  uint32_t candidate = 0;  ///< its number, 0 to TransitionRequest::candidates - 1
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

  /// Starts a dance that can be steered while it runs.
  std::unique_ptr<RemoteDance> StartDance(const DanceConfig& config) const;

  /// Generates a whole dance to known music through known keys. Takes `config.audio` from `audio`.
  /// Calls `observer`, if any, with each message.
  DanceResult Dance(DanceConfig config, const std::vector<KeyPose>& keys, const Audio& audio,
                    const std::function<void(const Message&)>& observer = {}) const;
  /// Generates a whole dance, as above, into `result`, which keeps the received frames if the dance
  /// fails.
  void Dance(DanceConfig config, const std::vector<KeyPose>& keys, const Audio& audio,
             const std::function<void(const Message&)>& observer, DanceResult* result) const;

  TransitionResult GenerateTransition(const TransitionRequest& request) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace choreo::client
