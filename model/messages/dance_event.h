#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "model/core/error.h"
#include "model/core/hand_pose.h"

/// What a dance reports while it runs; shared by server and client. Frames are absolute, at the
/// model's rate.
namespace choreo {

/// The errors at a key. Distances and angles are the largest over the joints that the key
/// constrains.
struct KeyReached {
  std::string id = {};
  int64_t frame = 0;
  /// The error of the model's own frame at the key. Earlier frames had already been steered towards
  /// the key, so an unsteered dance would miss it by more.
  double raw_error_m = 0;
  double final_error_m = 0;    ///< of the danced frame
  double final_error_deg = 0;  ///< of the danced frame
  double correction_m = 0;     ///< the furthest that any joint was moved on the way to the key
  /// The largest acceleration of any joint within two frames of the key, m/s^2. Only reports have
  /// it.
  double max_acceleration = 0;
  /// The hands' pose at the key, if the key sets one. Only events have it.
  std::optional<HandPose> hands = {};
};

/// The answer to a message about a key that reaches no frame to come: its frames are frozen or
/// already danced, or it is invalid. The dance ignores the message, except with kAlreadyDanced.
/// Codes have the API's numbers, here and below.
struct KeyRejected {
  enum class Code {
    kUnknown,         ///< from an older server
    kTooLate,         ///< the requested frame is frozen
    kFrozen,          ///< the key of this id is in frozen frames
    kRejectedBefore,  ///< a removal of a key that had been rejected
    kAlreadyDanced,   ///< the dance resumes after the frame; the key is set or removed there
    kInvalid,         ///< the key cannot be used; only where the client asks for this answer
  };
  std::string id = {};
  int64_t frame = 0;           ///< the requested frame, -1 if it is none; for a removal, the key's
  int64_t earliest_frame = 0;  ///< the first that a new key may have now, -1 if none
  std::string reason = {};
  Code code = Code::kUnknown;
  std::string field = {};         ///< of kInvalid: the path in the message, as in BadRequest
  Remedy remedy = Remedy::kNone;  ///< only in the server, whose `reason` then names it
};

/// A beat of the music to which the dance is timed.
struct Beat {
  /// Where it comes from.
  enum class Source {
    kUnknown,    ///< from an older server
    kGiven,      ///< sent by the client
    kFound,      ///< in the whole music
    kPredicted,  ///< from the music before the transition's first frame
    kHeard,      ///< predicted, and confirmed by an onset when its frame was danced
  };
  int64_t frame = 0;  ///< once reported: the nearest danced frame
  double time_s = 0;  ///< exact
  Source source = Source::kUnknown;
  /// How much stronger onsets are on the beats around it, or on the beats that predicted it, than
  /// elsewhere: 0 to 1. 1 if given.
  double confidence = 1;
  bool downbeat = false;  ///< begins a bar, as far as known
};

/// A problem that does not stop the dance.
struct Warning {
  enum class Code {
    kUnknown,             ///< a client's own, or of another version
    kIntervalTooShort,    ///< reaching the key at `frame` takes more speed than people have
    kInexactResume,       ///< the continuation has another fingerprint; `frame` is its own
    kPathTooFast,         ///< at `frame` the root path is faster than people are
    kKeyOffPath,          ///< the root path does not lead to the key at `frame`
    kControlsTooLate,     ///< every frame of a root path is frozen; `frame` is its last
    kPathBehindEnd,       ///< the dance ends before the root path's first frame, `frame`
    kKeyOffHeight,        ///< the key at `frame` stands at another height than the path
    kPathAway,            ///< a root path begins at `frame`, away from the dancer
    kVelocityNotMet,      ///< at the end, `frame`: some parts missed their requested speed
    kBeatsTooLate,        ///< beats came after their frames were frozen; `frame` is the first's
    kTemperatureTooHigh,  ///< higher than the model was trained for; `frame` is the first
    kKeyImpossible,       ///< no body can take the pose of the key at `frame`
    kMusicDamaged,        ///< the music's file is damaged or ends early; `frame` is its last
    kMusicSilent,         ///< the music is silent, perhaps only as a mix; `frame` is its last
    kKeyBehindMusic,      ///< the key at `frame` is after the music's end
    kDanceBehindMusic,    ///< the music ends at `frame`, before the last requested frame
    kJointTooFast,        ///< a joint moves faster than people can, fastest at `frame`
    kFlightTooLong,       ///< from `frame` on nothing touches the floor for longer than people jump
    kBeatsBehindMusic,    ///< the music ends at `frame`, before the last given beats
  };
  int64_t frame = 0;
  std::string message = {};  ///< names the value and the limit
  Code code = Code::kUnknown;
  /// Id of the key at `frame`, or of the next key; empty if the warning is about no key.
  std::string key_id = {};
  double figure = 0, limit = 0;  ///< what `message` compares; 0 if it compares none
};

/// A Beat comes with its frame.
using DanceEvent = std::variant<KeyReached, KeyRejected, Warning, Beat>;

}  // namespace choreo
