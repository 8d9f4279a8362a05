#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "model/core/error.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"
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
  /// those whose health says that they do not serve.
  std::vector<std::string> addresses = {"127.0.0.1:50051"};
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
  /// is taken for lost, seconds; at least 2, or 0: never. Dances may pause longer.
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
  /// Called, on the thread of a call, before it is tried again; what this throws ends it. For those
  /// who know that there is no use. None if empty.
  std::function<void()> before_retry = {};
};

/// One model that a server has loaded.
struct ModelDescription {
  std::string name = {};
  std::string fingerprint = {};  ///< equal fingerprints give equal bits
  std::string licence = {};      ///< terms of the weights
  std::string card = {};         ///< JSON
  Skeleton skeleton = {};
  double fps = 30;
  int history_frames = 0;  ///< frames of the past that it looks at
  double default_temperature = 0;
  std::vector<std::string> controls = {};  ///< "root_path", "velocity_factors"
  /// How lively its dancers usually are: what multipliers refer to; the first is the default.
  struct VelocityReference {
    std::string name = {};
    std::vector<double> speeds = {};  ///< metres a frame, in the order of kBodyPartNames
  };
  std::vector<VelocityReference> velocity_references = {};
  std::vector<std::string> styles = {};  ///< that DanceConfig::style may name
  bool takes_music = true;               ///< false: it refuses audio
  bool deterministic = false;  ///< seed and temperature change nothing; rests without a key ahead
  double audio_lead_s = 0;     ///< music that a transition wants before its first frame
  int latency_frames = 0;      ///< how far the music must be ahead of the frame that is made
  int max_transition_frames = 0;  ///< of one transition; the server's own limit is in it already
};

/// A server.
struct ServerDescription {
  std::string version = {};
  std::vector<ModelDescription> models = {};  ///< the first is the default
  std::vector<std::string> devices = {};
  int slots = 0;
  int active_streams = 0;
  /// What the server refuses to go beyond.
  struct Limits {
    int64_t max_message_bytes = 0;
    double max_audio_s = 0;
    int64_t max_audio_file_bytes = 0;
    int max_keyframes = 0;
    int max_transition_frames = 0;
    int max_candidates = 0;
    double max_frame_rate = 0;
    int max_streams = 0;
  } limits;
};

/// What the music's bytes are.
enum class AudioKind {
  kNone,      ///< there is no music
  kPcmFloat,  ///< interleaved float samples in [-1, 1]
  kFile,      ///< a WAV, FLAC, Ogg or MP3 file; danced to once all of it has arrived
};

struct AudioFormat {
  AudioKind kind = AudioKind::kNone;
  int sample_rate = 0;  ///< of kPcmFloat, Hz, 8000 to 192000
  int channels = 0;     ///< of kPcmFloat, 1 to 8
};

/// Music, whole.
struct Audio {
  AudioFormat format = {};
  std::vector<float> samples = {};    ///< of kPcmFloat, interleaved
  std::vector<std::byte> bytes = {};  ///< of kFile
};

/// A pose to be hit: to 1 mm and 0.1 degrees.
struct KeyPose {
  std::string id = {};                ///< unique; sent again, it replaces the key
  std::optional<int64_t> frame = {};  ///< at the model's rate; or else:
  double time_s = 0;                  ///< rounded to the nearest frame
  Pose pose = {};
  PoseMask mask = {};
};

/// Where a dance can be taken up again, on any server of the same fingerprint. Opaque but for what
/// it says of itself.
struct Continuation {
  int64_t frame = 0;              ///< the first that is still to be made
  int64_t audio_from_sample = 0;  ///< music before it need not be sent again
  std::string fingerprint = {};
  std::string bytes = {};  ///< the whole, serialised
};

/// Wishes beside key poses and music, for models that know them (ModelDescription::controls).
struct Controls {
  /// Where the root goes: points in time, at least 2, metres, in the world; frames are the model's.
  /// One in each frame, or few, which a smooth curve leads through. Keys win over it.
  struct RootPath {
    std::vector<int64_t> frames = {};          ///< ascending
    std::vector<Eigen::Vector2d> points = {};  ///< (x, z) at each
    std::vector<double> heights = {};          ///< of the root, at each; empty: as the model likes
  };
  /// How lively parts of the body are. Either factors or speeds.
  struct VelocityFactors {
    std::vector<int64_t> frames = {};  ///< of each row, ascending; empty: one row, for always
    std::vector<std::string> parts =
        {};                            ///< of each column, of kBodyPartNames; empty: one, for all
    std::vector<double> factors = {};  ///< [rows, columns] multipliers of the reference, 0 to 10
    std::vector<double> speeds = {};   ///< [rows, columns] metres a frame, 0 to 0.5
    std::string reference = {};        ///< empty: the model's first
  };
  std::optional<RootPath> root_path = {};
  std::optional<VelocityFactors> velocity_factors = {};
};

/// What a dance is made with.
struct DanceConfig {
  std::string model = {};  ///< empty: the server's first
  double fps = 0;          ///< of the frames received, 1 to 120; 0: the model's
  std::optional<uint64_t> seed = {};
  std::optional<double> temperature = {};  ///< 0 to 2
  std::string style = {};                  ///< one of the model's; empty: as it comes
  /// Poses right before the dance, at the model's rate, oldest first; empty: the dancer stands at
  /// rest, facing +Z, where a path from frame 0 on begins, or else at the origin.
  std::vector<Pose> history = {};
  int64_t first_frame = 0;  ///< number of the first frame made, with `history`
  std::optional<Continuation> continuation = {};  ///< instead of `history`
  AudioFormat audio = {};
  std::optional<int64_t> frames =
      {};  ///< the dance ends before this frame; otherwise with the music or the last key
  /// Times of the music's beats, seconds, strictly ascending, 0 to 600: limbs are fastest on them,
  /// Beat messages and the report tell of them. Empty: the server finds them in a kFile, and in a
  /// kPcmFloat predicts each transition's from the 12 s before it.
  std::vector<double> music_beats = {};
  /// For who edits keys: as RemoteDance::GenerateUntil before all else; keys then grant nothing.
  std::optional<int64_t> generate_until = {};
  Controls controls = {};  ///< from the first frame on
};

/// What the frames mean. The first answer.
struct Header {
  std::string model = {};
  std::string fingerprint = {};
  Skeleton skeleton = {};
  uint64_t seed = 0;
  double temperature = 0;
  double fps = 30;        ///< of the frames received
  double model_fps = 30;  ///< of every other frame number
  int64_t first_frame = 0;
  int latency_frames = 0;
  std::string server_version = {};
};

/// Consecutive frames.
struct FrameBlock {
  int64_t first_frame = 0;  ///< at Header::fps
  std::vector<Pose> poses = {};
  std::vector<std::array<float, 4>> contacts = {};  ///< of Skeleton::feet, 0 to 1
  uint32_t candidate = 0;                           ///< of a transition
};

/// How one key was hit. Distances and angles are the largest of any joint that the key asks for.
struct KeyReached {
  std::string id = {};
  int64_t frame = 0;
  double raw_error_m = 0;      ///< of the model's own frame, made after frames steered to the key
  double final_error_m = 0;    ///< of the frame that was sent; at most 0.001
  double final_error_deg = 0;  ///< the same; at most 0.1
  double correction_m = 0;     ///< furthest that a joint was moved on the way to the key
};

/// A key came too late, and nothing changed.
struct KeyRejected {
  std::string id = {};
  int64_t frame = 0;           ///< asked for
  int64_t earliest_frame = 0;  ///< the first that a key could have now
  std::string reason = {};
};

struct Beat {
  /// How it is known.
  enum class Source {
    kUnknown,    ///< an old server does not say
    kGiven,      ///< the client told
    kFound,      ///< in the whole of a kFile
    kPredicted,  ///< from the music before, and no onset was there
    kHeard,      ///< predicted, and an onset was there
  };
  int64_t frame = 0;
  double time_s = 0;  ///< exact
  Source source = Source::kUnknown;
  double confidence = 0;  ///< 0 to 1, of the pulse that predicted it; 1 where none did
};

struct Warning {
  int64_t frame = 0;
  std::string message = {};  ///< names the value and the limit
};

/// The server was lost and another one goes on; frames before `frame` are not sent again.
struct Resumed {
  std::string address = {};
  int64_t frame = 0;        ///< at Header::fps
  bool exact = true;        ///< false: of another fingerprint
  std::string reason = {};  ///< what had happened
};

/// The end of a dance, and what it is worth. `frames` and `keys` are the whole dance's; the rest
/// speaks of the frames from `measured_from` on, which a resume moves on to where the last server
/// took over.
struct Report {
  /// How fast a part of the body was.
  struct PartSpeed {
    double asked = 0;
    double danced = 0;
  };
  int64_t frames = 0;  ///< at the model's rate
  std::vector<KeyReached> keys = {};
  int64_t measured_from = 0;  ///< at the model's rate
  double log_likelihood = 0;  ///< nats a frame
  std::optional<double> beat_hit_rate = {};
  double skate_ratio = 0;
  double max_key_acceleration = 0;  ///< of a joint, within two frames of any key, m/s^2
  double p95_acceleration = 0;      ///< of the frames' largest, m/s^2: to compare it with
  /// By BodyPart, metres a frame of the model, means over the frames of which velocity factors
  /// asked something; empty without.
  std::vector<PartSpeed> part_speeds = {};
  double first_frame_latency_s = 0;
  double elapsed_s = 0;
  double real_time_factor = 0;  ///< seconds of dance a second
};

using Message = std::variant<Header, FrameBlock, KeyReached, KeyRejected, Beat, Warning,
                             Continuation, Resumed, Report>;

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
  /// first of them on, for transitions that begin behind the frozen frames. Not after CompleteKeys.
  void SendBeats(std::span<const double> seconds);
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
  std::vector<std::array<float, 4>> contacts = {};
  std::vector<Beat> beats = {};
  std::vector<Warning> warnings = {};
  std::vector<KeyRejected> rejected = {};
  Report report = {};
  int resumes = 0;
};

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
  int candidates = 1;            ///< 1 to 32
};

struct TransitionCandidate {
  uint32_t candidate = 0;
  Motion motion = {};
  std::vector<std::array<float, 4>> contacts = {};
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
