#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/core/hand_pose.h"
#include "model/core/hit.h"
#include "model/messages/dance_manner.h"
#include "model/motion/controls/control_request.h"
#include "model/motion/motion.h"

/// A client's request: music, key poses, controls, and the settings of the dance. Frames are
/// counted at the model's rate; for other conventions see choreo_client.h.
namespace choreo::client {

using choreo::DanceManner, choreo::KnownMusic;

/// The encoding of the music's bytes.
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

/// A whole piece of music.
struct Audio {
  AudioFormat format = {};
  std::vector<float> samples = {};    ///< of kPcmFloat, interleaved
  std::vector<std::byte> bytes = {};  ///< of kFile
};

/// A pose for the dance to reach.
struct KeyPose {
  std::string id = {};                ///< unique; a key sent again with the same id is replaced
  std::optional<int64_t> frame = {};  ///< at the model's rate; or else:
  double time_s = 0;                  ///< rounded to the nearest frame
  Pose pose = {};
  PoseMask mask = {};
  /// How hard the dancer hits the pose, 0 (gently) to kMaxHit (late and fast), coming to rest in
  /// it. None: the dance passes through it.
  std::optional<double> hit = {};
  /// The hands' pose at the key. Kept for characters with fingers; does not affect the dance.
  std::optional<HandPose> hands = {};
};

/// A point where any server of the same fingerprint can resume a dance. Opaque except for the
/// members below.
struct Continuation {
  int64_t frame = 0;              ///< the first frame to generate
  int64_t audio_from_sample = 0;  ///< music before it need not be sent again
  std::string fingerprint = {};
  std::string bytes = {};  ///< the whole continuation, serialised
};

/// The configuration of a dance.
struct DanceConfig {
  std::string model = {};  ///< empty: the server's first
  double fps = 0;          ///< of the frames received, 1 to 120; 0: the model's
  std::optional<uint64_t> seed = {};
  DanceManner manner = {};
  /// Poses right before the dance, at the model's rate, oldest first. Empty: the dancer stands at
  /// rest, facing +Z, at the origin or, if a path begins at frame 0, at the path's beginning.
  std::vector<Pose> history = {};
  int64_t first_frame = 0;  ///< number of the first generated frame, with `history`
  std::optional<Continuation> continuation = {};  ///< instead of `history`
  AudioFormat audio = {};
  std::optional<int64_t> frames =
      {};  ///< the dance ends before this frame; none: with the music or the last key
  KnownMusic known = {};  ///< of the music
  /// Acts like RemoteDance::GenerateUntil before any other request. Keys then permit no frames, so
  /// that they can be edited.
  std::optional<int64_t> generate_until = {};
  /// Answers an unusable key with a KeyRejected message instead of ending the dance.
  bool reject_invalid_keys = false;
  /// Controls from the first frame on, for models that support them (ModelDescription::controls).
  ControlRequest controls = {};
};

}  // namespace choreo::client
