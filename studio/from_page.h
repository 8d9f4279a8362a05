#pragma once

#include <vector>

#include "client/authoring/counts.h"
#include "client/choreo_client.h"
#include "client/edit.h"
#include "client/live/beat_ear.h"
#include "model/audio/format.h"
#include "studio/studio.pb.h"

/// The page's messages (of choreo.v1) as the client library's structs, the inverse of ToProto in
/// client/convert.h. Checks values; throws Error(kInvalidArgument) naming the field of an unusable
/// one.
namespace choreo::studio {

client::KeyPose FromProto(const v1::Keyframe& key, const Skeleton& skeleton);
/// Leaves the model open: the server's first. Keeps beats only if they differ from those this
/// program finds. Music, if any, becomes floats.
client::DanceConfig FromProto(const v1::DanceConfig& config, const Skeleton& skeleton);
client::TransitionRequest FromProto(const v1::GenerateTransitionRequest& request,
                                    const Skeleton& skeleton);
live::LiveBeatHint FromProto(const LiveBeats& beats);
/// The samples of all pieces, in order.
std::vector<float> SamplesOf(const v1::Audio& audio);
client::FinishedDance FromProto(const Clip& clip, const Skeleton& skeleton);

/// The counts of the music, of a message with its beats and ones.
template <typename Message>
authoring::Counts CountsIn(const Message& message) {
  const std::vector<double> ones(message.ones().begin(), message.ones().end());
  const std::vector<double> beats(message.beats().begin(), message.beats().end());
  CheckBeats(beats, "beats");
  return authoring::CountsFrom(beats, ones);
}

}  // namespace choreo::studio
