#pragma once

#include <vector>

#include "client/authoring/fields/counts.h"
#include "client/choreo_client.h"
#include "client/edit.h"
#include "client/live/beat_ear.h"
#include "model/audio/signal/format.h"
#include "studio/studio.pb.h"

/// The page's messages (of choreo.v1) as the client library's structs, the inverse of ToProto in
/// client/convert.h. Throws Error(kInvalidArgument), naming the field, for an unusable value.
namespace choreo::studio {

/// `field`, `pose`: the paths of the key and of its pose in errors.
client::KeyPose FromProto(const v1::Keyframe& key, const Skeleton& skeleton,
                          const std::string& field = "keyframe",
                          const std::string& pose = "keyframe.pose");
client::AudioFormat FromProto(const v1::AudioFormat& format);
/// Normalises rotations, which in files may exceed a half turn.
std::vector<Pose> PosesOf(const v1::History& history, const Skeleton& skeleton);
live::LiveBeatHint FromProto(const LiveBeats& beats);
client::FinishedDance FromProto(const Clip& clip, const Skeleton& skeleton);

/// The music's counts, from a message with its beats and ones.
template <typename Message>
authoring::Counts CountsIn(const Message& message) {
  const std::vector<double> ones(message.ones().begin(), message.ones().end());
  const std::vector<double> beats(message.beats().begin(), message.beats().end());
  CheckBeats(beats, "beats");
  return authoring::CountsFrom(beats, ones);
}

}  // namespace choreo::studio
