#pragma once

#include <vector>

#include "client/choreo_client.h"
#include "client/edit.h"
#include "studio/studio.pb.h"

/// Between the page's messages, which are those of choreo.v1, and the client library's structs: the
/// other way round than client/convert.h. What the page says is checked; a value that cannot be
/// used throws Error(kInvalidArgument) naming its field.
namespace choreo::studio {

client::KeyPose FromProto(const v1::Keyframe& key, const Skeleton& skeleton);
client::Controls FromProto(const v1::Controls& controls);
/// Without music, which is this program's, and without a model, which is the server's first.
client::DanceConfig FromProto(const v1::DanceConfig& config, const Skeleton& skeleton);
client::TransitionRequest FromProto(const v1::GenerateTransitionRequest& request,
                                    const Skeleton& skeleton);
client::FinishedDance FromProto(const Clip& clip, const Skeleton& skeleton);

v1::Skeleton ToProto(const Skeleton& skeleton);
v1::ModelInfo ToProto(const client::ModelDescription& model);
v1::StreamDanceResponse ToProto(const client::Header& header);
v1::StreamDanceResponse ToProto(const client::FrameBlock& block);
v1::StreamDanceResponse ToProto(const client::KeyReached& reached);
v1::StreamDanceResponse ToProto(const client::KeyRejected& rejected);
v1::StreamDanceResponse ToProto(const client::Beat& beat);
v1::StreamDanceResponse ToProto(const client::Warning& warning);
v1::StreamDanceResponse ToProto(const client::Continuation& continuation);
v1::StreamDanceResponse ToProto(const client::Report& report);
/// Header, frames and warnings, summary.
std::vector<v1::GenerateTransitionResponse> ToProto(const client::TransitionResult& result);
Clip ToProto(const client::FinishedDance& dance);

}  // namespace choreo::studio
