#pragma once

#include <vector>

#include "client/choreo_client.h"
#include "client/edit.h"
#include "studio/studio.pb.h"

/// The page's messages (of choreo.v1) as the client library's structs, the inverse of ToProto in
/// client/convert.h. Checks values; throws Error(kInvalidArgument) naming the field of an unusable
/// one.
namespace choreo::studio {

client::KeyPose FromProto(const v1::Keyframe& key, const Skeleton& skeleton);
/// No model: the server's first one. Beats only if they differ from those this program finds.
/// Music, if any, as floats.
client::DanceConfig FromProto(const v1::DanceConfig& config, const Skeleton& skeleton);
client::TransitionRequest FromProto(const v1::GenerateTransitionRequest& request,
                                    const Skeleton& skeleton);
/// The samples of all pieces, in order.
std::vector<float> SamplesOf(const v1::Audio& audio);
client::FinishedDance FromProto(const Clip& clip, const Skeleton& skeleton);

}  // namespace choreo::studio
