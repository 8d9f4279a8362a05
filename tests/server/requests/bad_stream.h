#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "tests/server/dances/merge.h"

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

using KeyMessage = v1::StreamDanceRequest;

struct BadStreamCase {
  std::string name;
  /// Makes the requests; `key` is a good one, at frame 40.
  std::function<Requests(KeyMessage key)> requests;
  std::string field;
  std::vector<std::string> says;
  grpc::StatusCode code = grpc::StatusCode::INVALID_ARGUMENT;
};

inline void PrintTo(const BadStreamCase& bad, std::ostream* out) { *out << bad.name; }

class BadStreamTest : public ServerTest, public testing::WithParamInterface<BadStreamCase> {};

/// For INSTANTIATE_TEST_SUITE_P: cases are known by their names.
inline std::string NameOf(const testing::TestParamInfo<BadStreamCase>& info) {
  return info.param.name;
}

/// These messages; "key" stands for the good one.
inline auto Sent(std::vector<std::string> texts) {
  return [texts = std::move(texts)](const KeyMessage& key) {
    Requests requests;
    for (const std::string& text : texts) {
      requests.push_back(key);
      if (text == "key") continue;
      requests.back().Clear();
      Merge(text, &requests.back());
    }
    return requests;
  };
}

/// A configuration with this besides, then a good key.
inline auto WithConfig(std::function<void(v1::DanceConfig&)> change) {
  return [change = std::move(change)](const KeyMessage& key) -> Requests {
    v1::StreamDanceRequest config = ConfigRequest();
    change(*config.mutable_config());
    return {config, key};
  };
}
inline auto WithConfig(const std::string& text) {
  return WithConfig([text](v1::DanceConfig& config) { Merge(text, &config); });
}

}  // namespace choreo
