#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/dance/spec_poses.h"
#include "model/messages/continuation.h"
#include "model/messages/dance_event.h"

namespace choreo {

/// Warns about the transition of `frames` frames from `first_frame` to the key `id`.
Warning IntervalTooShort(const Skeleton& skeleton, const std::string& id, int64_t first_frame,
                         int64_t frames, const RequiredSpeed& speed);

Warning InexactResume(const Continuation& continuation, const ModelInfo& model);

/// `frame`: the first of the dance.
Warning TemperatureTooHigh(int64_t frame, double requested, double most);

Warning PathTooFast(int64_t frame, double m_per_s);
Warning PathAway(int64_t frame, double metres);
Warning KeyOffPath(const std::string& id, int64_t frame, double metres);
/// `standing`, `height`: root heights of the standing key and of the path, metres.
Warning KeyOffHeight(const std::string& id, int64_t frame, double standing, double height);
/// `fault`: one of PoseFaults (pose_faults.h).
Warning KeyImpossible(const std::string& id, int64_t frame, const std::string& fault);
/// `control`: its label. `earliest`: the first frame that is not frozen.
Warning ControlsTooLate(std::string_view control, int64_t last_frame, int64_t earliest);
Warning BeatsTooLate(int64_t frame, int64_t count, int64_t earliest);
Warning PathBehindEnd(int64_t first_frame, int64_t end);
/// `seconds`: what could be read of the music. `notes`: at least one (decode.h).
Warning MusicDamaged(const std::vector<std::string>& notes, double seconds, double fps);
Warning MusicSilent(int64_t last_frame, double seconds);
Warning ChannelsCancel(int64_t last_frame);
/// `seconds`: between the end of the music and the key.
Warning KeyBehindMusic(const std::string& id, int64_t frame, double seconds);
/// `seconds`: of the dance after the music, which ends at `music_end`.
Warning DanceBehindMusic(int64_t music_end, double seconds);
/// On the way of `seconds` to the key `id`, if it is not empty.
Warning JointTooFast(const Skeleton& skeleton, int64_t frame, int joint, double m_per_s,
                     const std::string& id, double seconds);
/// `frame`: the first of the flight.
Warning FlightTooLong(int64_t frame, double seconds, const std::string& id);
/// `misses`: "left_leg 1.69 instead of 0.70", for at least one part, centimetres a frame.
Warning VelocityNotMet(int64_t last_frame, const std::string& misses);

}  // namespace choreo
