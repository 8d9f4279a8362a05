#pragma once

#include <cstdint>
#include <string>

#include "model/dance/transition.h"

namespace choreo {

/// Something that a listener should know of, and that does not stop the dance.
struct DanceWarning {
  enum class Kind {
    kIntervalTooShort,  ///< the way to the key at `frame` asks for more speed than people have
    kInexactResume,     ///< the continuation was of another fingerprint; `frame` is its own
    kPathTooFast,       ///< at `frame` the root path asks for more speed than people have
    kKeyOffPath,        ///< the root path does not lead to the key at `frame`
    kControlsTooLate,   ///< every frame that a root path speaks of is frozen; `frame` is its last
    kPathBehindEnd,     ///< the dance is over before the root path's first frame, `frame`
    kKeyOffHeight,      ///< the pose of the key at `frame` stands at another height than the path's
    kPathAway,          ///< a root path takes over at `frame`, away from the dancer
    kBeatsTooLate,      ///< beats came when their frames were frozen; `frame` is the first one's
    kTemperatureTooHigh,  ///< the model is not trained for so high a one; `frame` is the first
    kVelocityNotMet,      ///< by the end of the dance, `frame`, parts were not as fast as asked
  };
  Kind kind = Kind::kIntervalTooShort;
  int64_t frame = 0;  ///< model rate, absolute
  std::string message;
};

/// For the transition of `frames` frames from `first_frame` on to the key `id`.
DanceWarning IntervalTooShort(const Skeleton& skeleton, const std::string& id, int64_t first_frame,
                              int64_t frames, const RequiredSpeed& speed);

DanceWarning InexactResume(const Continuation& continuation, const ModelInfo& model);

/// `frame`: the dance's first.
DanceWarning TemperatureTooHigh(int64_t frame, double asked, double most);

DanceWarning PathTooFast(int64_t frame, double m_per_s);
DanceWarning PathAway(int64_t frame, double metres);
DanceWarning KeyOffPath(const std::string& id, int64_t frame, double metres);
/// Root heights of the standing key and of the path, metres.
DanceWarning KeyOffHeight(const std::string& id, int64_t frame, double standing, double height);
/// `earliest`: the first frame that is not frozen.
DanceWarning ControlsTooLate(int64_t last_frame, int64_t earliest);
DanceWarning BeatsTooLate(int64_t frame, int64_t count, int64_t earliest);
DanceWarning PathBehindEnd(int64_t first_frame, int64_t end);
/// `misses`: "left_leg 1.69 instead of 0.70", of at least one part, centimetres a frame.
DanceWarning VelocityNotMet(int64_t last_frame, const std::string& misses);

}  // namespace choreo
