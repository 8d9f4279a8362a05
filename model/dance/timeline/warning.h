#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/dance/timeline/spec_poses.h"
#include "model/messages/continuation.h"
#include "model/messages/dance_event.h"

namespace choreo {

/// A warning about the transition of `frames` frames from `first_frame` to the key `id`.
Warning IntervalTooShort(const Skeleton& skeleton, const std::string& id, int64_t first_frame,
                         int64_t frames, const RequiredSpeed& speed);

Warning InexactResume(const Continuation& continuation, const ModelInfo& model);

/// `frame`: the dance's first frame.
Warning TemperatureTooHigh(int64_t frame, double requested, double most);

Warning PathTooFast(int64_t frame, double m_per_s);
Warning PathAway(int64_t frame, double metres);
Warning KeyOffPath(const std::string& id, int64_t frame, double metres);
/// `standing`, `height`: the root's height in the standing key and on the path, metres.
Warning KeyOffHeight(const std::string& id, int64_t frame, double standing, double height);
/// `fault`: one of PoseFaults (pose_faults.h).
Warning KeyImpossible(const std::string& id, int64_t frame, const std::string& fault);
/// `control`: the control's label. `earliest`: the first frame that is not frozen.
Warning ControlsTooLate(std::string_view control, int64_t last_frame, int64_t earliest);
Warning BeatsTooLate(int64_t frame, int64_t count, int64_t earliest);
Warning PathBehindEnd(int64_t first_frame, int64_t end);
/// `seconds`: the length of the readable music. `notes`: at least one (decode.h).
Warning MusicDamaged(const std::vector<std::string>& notes, double seconds, double fps);
Warning MusicSilent(int64_t last_frame, double seconds);
Warning ChannelsCancel(int64_t last_frame);
/// `seconds`: from the music's end to the key.
Warning KeyBehindMusic(const std::string& id, int64_t frame, double seconds);
/// `count`: given beats after the music. `first`: the first of them, seconds.
Warning BeatsBehindMusic(int64_t music_end, size_t count, double first);
/// `seconds`: the length of the dance after the music. `music_end`: the frame at which the music
/// ends.
Warning DanceBehindMusic(int64_t music_end, double seconds);
/// `id`: the key to which the transition of `seconds` leads; may be empty.
Warning JointTooFast(const Skeleton& skeleton, int64_t frame, int joint, double m_per_s,
                     const std::string& id, double seconds);
/// `frame`: the flight's first frame.
Warning FlightTooLong(int64_t frame, double seconds, const std::string& id);
/// `misses`: text such as "left_leg 1.69 instead of 0.70" for at least one part, in centimetres per
/// frame.
Warning VelocityNotMet(int64_t last_frame, const std::string& misses);

}  // namespace choreo
