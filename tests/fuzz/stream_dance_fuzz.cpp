// A client of StreamDance that sends valid messages in any order, and others. A record of the input
// is a message, [kind, number, extra, bytes]: a valid message of that kind with `extra` bytes
// appended on the wire, which change its fields or make it invalid.
#include "tests/fuzz/rpc.h"

namespace choreo {
namespace {

using v1::StreamDanceRequest;
using v1::StreamDanceResponse;

class Script {
 public:
  explicit Script(fuzz::Decisions& decisions) : decisions_(decisions) {}

  StreamDanceRequest Next(uint8_t kind) {
    StreamDanceRequest request;
    const int number = decisions_.Byte();
    switch (kind % 10) {
      case 0:
        *request.mutable_config() = MakeConfig(number);
        break;
      case 1: {
        auto& key = *request.mutable_keyframe();
        key.set_id(std::to_string(number % 4));
        key.set_frame(number);
        *key.mutable_pose() = fuzz::GoodPose(0.3, 0.8F);
        break;
      }
      case 2:
        request.mutable_remove_keyframe()->set_id(std::to_string(number % 4));
        break;
      case 3:
        request.mutable_generate_until()->set_frame(granted_ += number % 80);
        break;
      case 4: {
        const size_t samples = 100 * static_cast<size_t>(number);
        request.mutable_audio()->set_data(fuzz::GoodMusic(samples));
        request.mutable_audio()->set_first_sample(sent_);
        sent_ += static_cast<int64_t>(samples);
        break;
      }
      case 5:
        request.mutable_keyframes_complete();
        break;
      case 6:
        request.mutable_end_of_audio();
        break;
      case 7: {
        auto& path = *request.mutable_controls()->mutable_root_path();
        for (const int frame : {granted_, granted_ + 1 + number}) path.add_frames(frame);
        for (const float place : {0.0F, 0.0F, 0.5F, 1.0F}) path.add_points(place);
        break;
      }
      case 8:
        request.mutable_controls()->mutable_velocity_factors()->add_factors(
            static_cast<float>(number) / 25);
        break;
      default:
        for (int beat = 0; beat < 8; ++beat)
          request.mutable_music_beats()->add_times(0.1 * number + 0.5 * beat);
    }
    return request;
  }

 private:
  static v1::DanceConfig MakeConfig(int flags) {
    v1::DanceConfig config;
    config.set_seed(7);
    if (flags & 1) *config.mutable_audio_format() = fuzz::GoodFormat();
    if (flags & 2) config.set_frames(flags);
    if (flags & 4) config.set_generate_until(0);
    if (flags & 8) config.set_frame_rate(60);
    if (flags & 16) {
      config.mutable_audio_format()->Clear();
      config.mutable_audio_format()->set_encoding(v1::AUDIO_ENCODING_FILE);
    }
    return config;
  }

  fuzz::Decisions& decisions_;
  int granted_ = 0;
  int64_t sent_ = 0;
};

}  // namespace
}  // namespace choreo

FUZZ_TARGET(stream_dance) {
  using namespace choreo;
  static fuzz::RpcServer& server = *new fuzz::RpcServer;
  fuzz::Decisions decisions(data, size);
  Script script(decisions);
  fuzz::RawStream stream(server, "StreamDance");
  for (int messages = 0; !decisions.over() && messages < 100; ++messages) {
    const uint8_t kind = decisions.Byte();
    if (kind == 0xFE) stream.Cancel();
    if (kind == 0xFF) {  // nothing good, only what follows
      const auto bytes = decisions.Take(decisions.Byte());
      if (!stream.Send({bytes.begin(), bytes.end()})) break;
      continue;
    }
    std::string message = script.Next(kind).SerializeAsString();
    const auto extra = decisions.Take(kind < 0x80 ? 0 : decisions.Byte());
    message.append(extra.begin(), extra.end());
    if (!stream.Send(message)) break;
  }
  stream.Finish<v1::StreamDanceResponse>();
  return 0;
}
