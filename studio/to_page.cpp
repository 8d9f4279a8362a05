#include "studio/to_page.h"

#include "proto/wire/convert.h"

namespace choreo::studio {
namespace {

v1::Continuation ToContinuation(const client::Continuation& continuation) {
  v1::Continuation out;
  if (!out.ParseFromString(continuation.bytes))
    throw Error(ErrorCode::kInternal, "continuation", "cannot be read");
  return out;
}

}  // namespace

v1::StreamDanceResponse ToProto(const client::Header& header) {
  v1::StreamDanceResponse out;
  *out.mutable_header() = wire::ToProto(header);
  return out;
}

v1::StreamDanceResponse ToProto(const client::FrameBlock& block) {
  v1::StreamDanceResponse out;
  *out.mutable_frames() = wire::ToProto(block.first_frame, block.poses, block.contacts);
  out.mutable_frames()->set_candidate(block.candidate);
  return out;
}

v1::StreamDanceResponse ToProto(const DanceEvent& event, double fps) {
  v1::StreamDanceResponse out;
  *out.mutable_event() = wire::ToProto(event, fps);
  return out;
}

v1::StreamDanceResponse ToProto(const client::Continuation& continuation) {
  v1::StreamDanceResponse out;
  *out.mutable_continuation() = ToContinuation(continuation);
  return out;
}

v1::StreamDanceResponse ToProto(const client::Report& report) {
  v1::StreamDanceResponse out;
  *out.mutable_summary()->mutable_report() = wire::ToProto(report);
  *out.mutable_summary()->mutable_timing() = wire::ToProto(report.timing);
  return out;
}

std::vector<v1::GenerateTransitionResponse> ToProto(const client::TransitionResult& result) {
  std::vector<v1::GenerateTransitionResponse> out(1);
  *out.back().mutable_header() = wire::ToProto(result.header);
  for (const client::Warning& warning : result.warnings)
    *out.emplace_back().mutable_event() = wire::ToProto(warning, result.header.model_fps);
  v1::GenerateTransitionResponse summary;
  for (const client::TransitionCandidate& candidate : result.candidates) {
    v1::Frames* frames = out.emplace_back().mutable_frames();
    *frames = wire::ToProto(
        candidate.continuation.frame - static_cast<int64_t>(candidate.motion.frames.size()),
        candidate.motion.frames, candidate.contacts);
    frames->set_candidate(candidate.candidate);
    v1::Candidate* added = summary.mutable_summary()->add_candidates();
    added->set_candidate(candidate.candidate);
    *added->mutable_report() = wire::ToProto(candidate.report);
    *added->mutable_continuation() = ToContinuation(candidate.continuation);
  }
  // The client library gives each candidate the call's timing.
  if (!result.candidates.empty())
    *summary.mutable_summary()->mutable_timing() =
        wire::ToProto(result.candidates.front().report.timing);
  out.push_back(std::move(summary));
  return out;
}

Clip ToProto(const client::FinishedDance& dance) {
  Clip out;
  out.set_frame_rate(dance.motion.fps);
  *out.mutable_frames() = wire::ToProto(0, dance.motion.frames, dance.contacts);
  return out;
}

}  // namespace choreo::studio
