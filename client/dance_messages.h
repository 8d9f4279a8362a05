#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "client/dance_config.h"
#include "model/core/grid.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// What a server answers while it dances. Conventions are choreo_client.h's.
namespace choreo::client {

/// What the frames mean. The first answer.
struct Header {
  std::string model = {};
  std::string fingerprint = {};
  Skeleton skeleton = {};
  uint64_t seed = 0;
  double temperature = 0;
  double fps = kModelFps;        ///< of the frames received
  double model_fps = kModelFps;  ///< of every other frame number
  int64_t first_frame = 0;
  int latency_frames = 0;
  std::string server_version = {};
};

/// Consecutive frames.
struct FrameBlock {
  int64_t first_frame = 0;  ///< at Header::fps
  std::vector<Pose> poses = {};
  std::vector<Contacts> contacts = {};  ///< of Skeleton::feet, 0 to 1
  uint32_t candidate = 0;               ///< of a transition
};

/// What a dance promises of its keys: how far off any joint may be, in metres and degrees.
inline constexpr double kMostKeyError_m = 0.001, kMostKeyError_deg = 0.1;

/// How one key was hit. Distances and angles are the largest of any joint that the key asks for.
struct KeyReached {
  std::string id = {};
  int64_t frame = 0;
  double raw_error_m = 0;      ///< of the model's own frame, made after frames steered to the key
  double final_error_m = 0;    ///< of the frame that was sent
  double final_error_deg = 0;  ///< the same
  double correction_m = 0;     ///< furthest that a joint was moved on the way to the key
};

/// A key came too late, and nothing changed.
struct KeyRejected {
  enum class Code {
    kUnknown,         ///< an old server does not say
    kTooLate,         ///< the frame asked for is frozen
    kFrozen,          ///< the key of this id stands in frozen frames
    kRejectedBefore,  ///< of a removal: the key was rejected when it came
    kAlreadyDanced,   ///< the dance goes on from a continuation behind the frame
  };
  std::string id = {};
  int64_t frame = 0;           ///< asked for
  int64_t earliest_frame = 0;  ///< the first that a key could have now
  std::string reason = {};
  Code code = Code::kUnknown;
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
  bool downbeat =
      false;  ///< a bar begins, where somebody told or the server heard all of the music
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
  int64_t measured_from = 0;                  ///< at the model's rate
  std::optional<double> log_likelihood = {};  ///< nats a frame; of models that have one
  std::optional<double> beat_hit_rate = {};
  double skate_ratio = 0;
  std::optional<double> support = {};  ///< share of the frames in which something bears the body
  double max_key_acceleration = 0;     ///< of a joint, within two frames of any key, m/s^2
  double p95_acceleration = 0;         ///< of the frames' largest, m/s^2: to compare it with
  /// By BodyPart, metres a frame of the model, means over the frames of which velocity factors
  /// asked something; empty without.
  std::vector<PartSpeed> part_speeds = {};
  double first_frame_latency_s = 0;
  double elapsed_s = 0;
  double real_time_factor = 0;  ///< seconds of dance a second
};

using Message = std::variant<Header, FrameBlock, KeyReached, KeyRejected, Beat, Warning,
                             Continuation, Resumed, Report>;

}  // namespace choreo::client
