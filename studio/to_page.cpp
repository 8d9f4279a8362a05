#include "studio/to_page.h"

#include "proto/wire/convert.h"

namespace choreo::studio {
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

v1::StreamDanceResponse ToProto(const client::Report& report) {
  v1::StreamDanceResponse out;
  *out.mutable_summary()->mutable_report() = wire::ToProto(report);
  *out.mutable_summary()->mutable_timing() = wire::ToProto(report.timing);
  return out;
}

Clip ToProto(const client::FinishedDance& dance) {
  Clip out;
  out.set_frame_rate(dance.motion.fps);
  *out.mutable_frames() = wire::ToProto(0, dance.motion.frames, dance.contacts);
  return out;
}

}  // namespace choreo::studio
