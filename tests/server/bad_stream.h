#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "tests/server/fixture.h"

/// Streams that are refused: their messages, and what the answer must name. The test itself is in
/// bad_stream_test.cpp; its cases are in the files beside it, by theme.
namespace choreo {

using Requests = std::vector<v1::StreamDanceRequest>;

inline v1::StreamDanceRequest ConfigRequest() {
  v1::StreamDanceRequest request;
  request.mutable_config()->set_seed(1);
  return request;
}

inline v1::StreamDanceRequest MusicConfigRequest() {
  v1::StreamDanceRequest request = ConfigRequest();
  v1::AudioFormat* format = request.mutable_config()->mutable_audio_format();
  format->set_encoding(v1::AUDIO_ENCODING_PCM_F32LE);
  format->set_sample_rate(22'050);
  format->set_channels(1);
  return request;
}

inline v1::StreamDanceRequest AudioRequest(int samples, int64_t first_sample) {
  v1::StreamDanceRequest request;
  request.mutable_audio()->set_data(std::string(4 * static_cast<size_t>(samples), '\0'));
  request.mutable_audio()->set_first_sample(first_sample);
  return request;
}

struct BadStreamCase {
  const char* name;
  /// Makes the requests; `key` is a good one, at frame 40.
  std::function<Requests(v1::StreamDanceRequest key)> requests;
  grpc::StatusCode code;
  const char* field;
  std::vector<std::string> says;
};

inline void PrintTo(const BadStreamCase& bad, std::ostream* out) { *out << bad.name; }

class BadStreamTest : public ServerTest, public testing::WithParamInterface<BadStreamCase> {};

inline constexpr auto kInvalidStatus = grpc::StatusCode::INVALID_ARGUMENT;
using KeyMessage = v1::StreamDanceRequest;

/// For INSTANTIATE_TEST_SUITE_P: cases are known by their names.
inline std::string NameOf(const testing::TestParamInfo<BadStreamCase>& info) {
  return info.param.name;
}

// One bad key after a good configuration.
template <class Change>
auto WithKey(Change change) {
  return [change](KeyMessage key) -> Requests {
    change(*key.mutable_keyframe());
    return {ConfigRequest(), key};
  };
}
template <class Change>
auto WithConfig(Change change) {
  return [change](const KeyMessage& key) -> Requests {
    v1::StreamDanceRequest config = ConfigRequest();
    change(*config.mutable_config());
    return {config, key};
  };
}

}  // namespace choreo
