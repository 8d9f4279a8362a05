#pragma once

#include <cstdint>
#include <string>
#include <variant>

/// What a dance reports while it runs, for server and client alike. Frames are absolute, at the
/// model's rate.
namespace choreo {

/// How a key was met. Distances and angles are the largest of any joint that the key asks for.
struct KeyReached {
  std::string id = {};
  int64_t frame = 0;
  /// Of the model's own frame at the key. It was made after frames that had already been steered
  /// towards the key, so an unsteered dance would miss the key by more.
  double raw_error_m = 0;
  double final_error_m = 0;    ///< of the frame that was danced
  double final_error_deg = 0;  ///< the same
  double correction_m = 0;     ///< furthest that a joint was moved on the way to the key
  /// Of a report alone: the largest acceleration of a joint, m/s^2, in the frames within two of the
  /// key's; less where the dance ends earlier.
  double max_acceleration = 0;
};

/// A message about a key came too late: the frames that it would change are frozen. Nothing
/// changed. Codes are numbered as the API's, here and below.
struct KeyRejected {
  enum class Code {
    kUnknown,         ///< an old server does not say
    kTooLate,         ///< the frame asked for is frozen
    kFrozen,          ///< the key of this id stands in frozen frames
    kRejectedBefore,  ///< of a removal: the key was rejected when it came
    kAlreadyDanced,   ///< the dance goes on from a continuation behind the frame
  };
  std::string id = {};
  int64_t frame = 0;           ///< asked for; of a removal, where the key stands
  int64_t earliest_frame = 0;  ///< the first that a new key could have now
  std::string reason = {};
  Code code = Code::kUnknown;
};

/// A beat of the music that a dance is timed to.
struct Beat {
  /// How it is known.
  enum class Source {
    kUnknown,    ///< an old server does not say
    kGiven,      ///< the client told
    kFound,      ///< in the whole music
    kPredicted,  ///< from the music before the transition's first frame
    kHeard,      ///< predicted, and an onset was there when its frame was danced
  };
  int64_t frame = 0;  ///< once told: the nearest that had been danced
  double time_s = 0;  ///< exact
  Source source = Source::kUnknown;
  double confidence = 1;  ///< of the pulse that it was predicted by, 0 to 1; 1 where none did
  bool downbeat = false;  ///< a bar begins, where somebody told or all of the music was heard
};

/// Something that a listener should know of, and that does not stop the dance.
struct Warning {
  enum class Code {
    kUnknown,           ///< a client's own, or of another version
    kIntervalTooShort,  ///< the way to the key at `frame` asks for more speed than people have
    kInexactResume,     ///< the continuation was of another fingerprint; `frame` is its own
    kPathTooFast,       ///< at `frame` the root path asks for more speed than people have
    kKeyOffPath,        ///< the root path does not lead to the key at `frame`
    kControlsTooLate,   ///< every frame that a root path speaks of is frozen; `frame` is its last
    kPathBehindEnd,     ///< the dance is over before the root path's first frame, `frame`
    kKeyOffHeight,      ///< the pose of the key at `frame` stands at another height than the path's
    kPathAway,          ///< a root path takes over at `frame`, away from the dancer
    kVelocityNotMet,    ///< by the end of the dance, `frame`, parts were not as fast as asked
    kBeatsTooLate,      ///< beats came when their frames were frozen; `frame` is the first one's
    kTemperatureTooHigh,  ///< the model is not trained for so high a one; `frame` is the first
  };
  int64_t frame = 0;
  std::string message = {};  ///< names the value and the limit
  Code code = Code::kUnknown;
};

/// A Beat is told of with the frame that it is in.
using DanceEvent = std::variant<KeyReached, KeyRejected, Warning, Beat>;

}  // namespace choreo
