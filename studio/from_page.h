#pragma once

#include <vector>

#include "client/choreo_client.h"
#include "client/edit.h"
#include "studio/studio.pb.h"

/// What the page says, in messages of choreo.v1, as the client library's structs: the other way
/// round than client/convert.h. It is checked; a value that cannot be used throws
/// Error(kInvalidArgument) naming its field.
namespace choreo::studio {

client::KeyPose FromProto(const v1::Keyframe& key, const Skeleton& skeleton);
/// Without a model, which is the server's first; with beats where they are others than this program
/// hears. Music comes in floats, if at all.
client::DanceConfig FromProto(const v1::DanceConfig& config, const Skeleton& skeleton);
client::TransitionRequest FromProto(const v1::GenerateTransitionRequest& request,
                                    const Skeleton& skeleton);
/// Each piece follows the one before.
std::vector<float> SamplesOf(const v1::Audio& audio);
client::FinishedDance FromProto(const Clip& clip, const Skeleton& skeleton);

}  // namespace choreo::studio
