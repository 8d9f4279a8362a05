#include <cmath>
#include <limits>

#include "tests/server/fixture.h"

namespace choreo {
namespace {

using Requests = std::vector<v1::StreamDanceRequest>;

v1::StreamDanceRequest ConfigRequest() {
  v1::StreamDanceRequest request;
  request.mutable_config()->set_seed(1);
  return request;
}

v1::StreamDanceRequest MusicConfigRequest() {
  v1::StreamDanceRequest request = ConfigRequest();
  v1::AudioFormat* format = request.mutable_config()->mutable_audio_format();
  format->set_encoding(v1::AUDIO_ENCODING_PCM_F32LE);
  format->set_sample_rate(22'050);
  format->set_channels(1);
  return request;
}

v1::StreamDanceRequest AudioRequest(int samples, int64_t first_sample) {
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

void PrintTo(const BadStreamCase& bad, std::ostream* out) { *out << bad.name; }

class BadStreamTest : public ServerTest, public testing::WithParamInterface<BadStreamCase> {};

TEST_P(BadStreamTest, IsNamedAndTheServerGoesOn) {
  Start();
  v1::StreamDanceRequest key;
  *key.mutable_keyframe() = Key("k", 40);
  const Answer answer = Dance(GetParam().requests(key));
  EXPECT_EQ(answer.status.error_code(), GetParam().code) << answer.status.error_message();
  EXPECT_FALSE(answer.summary);
  for (const std::string& word : GetParam().says) {
    EXPECT_NE(answer.status.error_message().find(word), std::string::npos)
        << '"' << word << "\" is not in: " << answer.status.error_message();
  }
  const Details details = DetailsOf(answer.status);
  ASSERT_TRUE(details.error_info);
  EXPECT_EQ(details.error_info->domain(), "choreo");
  ASSERT_TRUE(details.bad_request) << answer.status.error_message();
  EXPECT_EQ(details.bad_request->field_violations(0).field(), GetParam().field);

  const Answer good = Dance({ConfigRequest(), key});
  EXPECT_TRUE(good.status.ok()) << good.status.error_message();
  EXPECT_EQ(good.Join().count, 41);
  ExpectIdle();
}

constexpr auto kInvalid = grpc::StatusCode::INVALID_ARGUMENT;
using Key = v1::StreamDanceRequest;

// One bad key after a good configuration.
template <class Change>
auto WithKey(Change change) {
  return [change](Key key) -> Requests {
    change(*key.mutable_keyframe());
    return {ConfigRequest(), key};
  };
}
template <class Change>
auto WithConfig(Change change) {
  return [change](const Key& key) -> Requests {
    v1::StreamDanceRequest config = ConfigRequest();
    change(*config.mutable_config());
    return {config, key};
  };
}

INSTANTIATE_TEST_SUITE_P(
    Order, BadStreamTest,
    testing::Values(
        BadStreamCase{
            "Nothing", [](const Key&) { return Requests{}; }, kInvalid, "config", {"missing"}},
        BadStreamCase{"NoConfig",
                      [](const Key& key) { return Requests{key}; },
                      kInvalid,
                      "config",
                      {"missing", "first"}},
        BadStreamCase{"TwoConfigs",
                      [](const Key&) {
                        return Requests{ConfigRequest(), ConfigRequest()};
                      },
                      kInvalid,
                      "config",
                      {"once"}},
        BadStreamCase{"EmptyMessage",
                      [](const Key&) {
                        return Requests{ConfigRequest(), v1::StreamDanceRequest()};
                      },
                      kInvalid,
                      "request",
                      {"empty"}},
        BadStreamCase{"HalfCloseAfterConfig",
                      [](const Key&) { return Requests{ConfigRequest()}; },
                      kInvalid,
                      "keyframes_complete",
                      {"no end"}},
        BadStreamCase{"KeysAfterComplete",
                      [](const Key& key) {
                        v1::StreamDanceRequest complete;
                        complete.mutable_keyframes_complete();
                        v1::StreamDanceRequest config = MusicConfigRequest();
                        return Requests{config, key, complete, key};
                      },
                      kInvalid,
                      "keyframes[1]",
                      {"keyframes_complete"}},
        BadStreamCase{"GenerateUntilBackwards",
                      [](const Key&) {
                        v1::StreamDanceRequest until;
                        until.mutable_generate_until()->set_frame(50);
                        v1::StreamDanceRequest back;
                        back.mutable_generate_until()->set_frame(40);
                        return Requests{ConfigRequest(), until, back};
                      },
                      kInvalid,
                      "generate_until.frame",
                      {"40", "50"}},
        BadStreamCase{"RemovedIdThatNeverWas",
                      [](const Key& key) {
                        v1::StreamDanceRequest remove;
                        remove.mutable_remove_keyframe()->set_id("ghost");
                        return Requests{ConfigRequest(), key, remove};
                      },
                      grpc::StatusCode::NOT_FOUND,
                      "remove_keyframes[0].id",
                      {"ghost"}},
        BadStreamCase{"Control",
                      [](const Key&) {
                        v1::StreamDanceRequest controls;
                        controls.mutable_controls()->mutable_velocity_factors();
                        return Requests{ConfigRequest(), controls};
                      },
                      grpc::StatusCode::UNIMPLEMENTED,
                      "controls.velocity_factors",
                      {"fake"}}),
    [](const auto& suite) { return std::string(suite.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Config, BadStreamTest,
    testing::Values(
        BadStreamCase{"UnknownModel",
                      WithConfig([](auto& c) { c.set_model("paper"); }),
                      grpc::StatusCode::NOT_FOUND,
                      "config.model",
                      {"paper", "fake"}},
        BadStreamCase{"FrameRate",
                      WithConfig([](auto& c) { c.set_frame_rate(121); }),
                      kInvalid,
                      "config.frame_rate",
                      {"121", "120"}},
        BadStreamCase{"FrameRateNaN",
                      WithConfig([](auto& c) { c.set_frame_rate(std::nan("")); }),
                      kInvalid,
                      "config.frame_rate",
                      {"nan"}},
        BadStreamCase{"Temperature",
                      WithConfig([](auto& c) { c.set_temperature(-0.5); }),
                      kInvalid,
                      "config.temperature",
                      {"-0.5", "[0, 2]"}},
        BadStreamCase{"Frames",
                      WithConfig([](auto& c) { c.set_frames(0); }),
                      kInvalid,
                      "config.frames",
                      {"0", "108000"}},
        BadStreamCase{
            "Encoding",
            WithConfig([](auto& c) { c.set_encoding(static_cast<v1::RotationEncoding>(17)); }),
            kInvalid,
            "config.encoding",
            {"17"}},
        BadStreamCase{"AudioEncoding",
                      WithConfig([](auto& c) { c.mutable_audio_format(); }),
                      kInvalid,
                      "config.audio_format.encoding",
                      {"PCM_F32LE"}},
        BadStreamCase{"SampleRate",
                      WithConfig([](auto& c) {
                        c.mutable_audio_format()->set_encoding(v1::AUDIO_ENCODING_PCM_S16LE);
                        c.mutable_audio_format()->set_sample_rate(7999);
                        c.mutable_audio_format()->set_channels(1);
                      }),
                      kInvalid,
                      "config.audio_format.sample_rate",
                      {"7999", "8000"}},
        BadStreamCase{"Channels",
                      WithConfig([](auto& c) {
                        c.mutable_audio_format()->set_encoding(v1::AUDIO_ENCODING_PCM_S16LE);
                        c.mutable_audio_format()->set_sample_rate(44100);
                        c.mutable_audio_format()->set_channels(9);
                      }),
                      kInvalid,
                      "config.audio_format.channels",
                      {"9", "8"}},
        BadStreamCase{"Beats",
                      WithConfig([](auto& c) {
                        c.add_music_beats(1);
                        c.add_music_beats(1);
                      }),
                      kInvalid,
                      "config.music_beats[1]",
                      {"1 s"}},
        BadStreamCase{"ShortContinuation",
                      WithConfig([](auto& c) {
                        c.mutable_continuation()->set_skeleton("smpl24");
                        c.mutable_continuation()->add_root_positions(1);
                      }),
                      kInvalid,
                      "config.continuation.root_positions",
                      {"1 ", "30"}}),
    [](const auto& suite) { return std::string(suite.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Keys, BadStreamTest,
    testing::Values(
        BadStreamCase{"NoPose",
                      WithKey([](auto& k) { k.clear_pose(); }),
                      kInvalid,
                      "keyframes[0].pose",
                      {"missing"}},
        BadStreamCase{"NoWhen",
                      WithKey([](auto& k) { k.clear_when(); }),
                      kInvalid,
                      "keyframes[0]",
                      {"frame, time"}},
        BadStreamCase{"NoId",
                      WithKey([](auto& k) { k.clear_id(); }),
                      kInvalid,
                      "keyframes[0].id",
                      {"0 bytes"}},
        BadStreamCase{"NoJoints",
                      WithKey([](auto& k) { k.mutable_pose()->clear_rotations(); }),
                      kInvalid,
                      "keyframes[0].rotations",
                      {"0 joints", "24"}},
        BadStreamCase{"Joints23",
                      WithKey([](auto& k) { k.mutable_pose()->mutable_rotations()->Truncate(69); }),
                      kInvalid,
                      "keyframes[0].rotations",
                      {"23 joints", "24"}},
        BadStreamCase{"Joints25",
                      WithKey([](auto& k) {
                        for (int i = 0; i < 3; ++i) k.mutable_pose()->add_rotations(0);
                      }),
                      kInvalid,
                      "keyframes[0].rotations",
                      {"25 joints", "24"}},
        BadStreamCase{"NaN",
                      WithKey([](auto& k) {
                        k.mutable_pose()->set_rotations(50,
                                                        std::numeric_limits<float>::quiet_NaN());
                      }),
                      kInvalid,
                      "keyframes[0].rotations[16]",
                      {"nan", "not finite"}},
        BadStreamCase{"Infinite",
                      WithKey([](auto& k) {
                        k.mutable_pose()->set_rotations(0, std::numeric_limits<float>::infinity());
                      }),
                      kInvalid,
                      "keyframes[0].rotations[0]",
                      {"inf", "not finite"}},
        BadStreamCase{"AbsurdRotation",
                      WithKey([](auto& k) { k.mutable_pose()->set_rotations(48, 7.9F); }),
                      kInvalid,
                      "keyframes[0].rotations[16]",
                      {"7.9 rad", "2π"}},
        BadStreamCase{
            "AbsurdPosition",
            WithKey([](auto& k) { k.mutable_pose()->mutable_root_position()->set_z(2e4); }),
            kInvalid,
            "keyframes[0].root_position[2]",
            {"20000", "10000"}},
        BadStreamCase{"PositionNaN",
                      WithKey([](auto& k) {
                        k.mutable_pose()->mutable_root_position()->set_x(std::nan(""));
                      }),
                      kInvalid,
                      "keyframes[0].root_position[0]",
                      {"nan"}},
        BadStreamCase{"NegativeFrame",
                      WithKey([](auto& k) { k.set_frame(-1); }),
                      kInvalid,
                      "keyframes[0].frame",
                      {"-1"}},
        BadStreamCase{"HugeFrame",
                      WithKey([](auto& k) { k.set_frame(int64_t{1} << 62); }),
                      kInvalid,
                      "keyframes[0].frame",
                      {"4611686018427387904"}},
        BadStreamCase{"TimeNaN",
                      WithKey([](auto& k) { k.set_time(std::nan("")); }),
                      kInvalid,
                      "keyframes[0].time",
                      {"nan"}},
        BadStreamCase{"IntervalZero",
                      WithKey([](auto& k) { k.set_interval_after_previous(0); }),
                      kInvalid,
                      "keyframes[0].interval_after_previous",
                      {"0 ", "[2, "}},
        BadStreamCase{"IntervalNegative",
                      WithKey([](auto& k) { k.set_interval_after_previous(-7); }),
                      kInvalid,
                      "keyframes[0].interval_after_previous",
                      {"-7"}},
        BadStreamCase{"IntervalHuge",
                      WithKey([](auto& k) {
                        k.set_interval_after_previous(std::numeric_limits<int64_t>::max());
                      }),
                      kInvalid,
                      "keyframes[0].interval_after_previous",
                      {"9223372036854775807"}},
        BadStreamCase{"MaskTwice",
                      WithKey([](auto& k) {
                        k.mutable_mask()->add_joints(3);
                        k.mutable_mask()->add_joints(3);
                      }),
                      kInvalid,
                      "keyframes[0].mask.joints[1]",
                      {"3"}},
        BadStreamCase{"MaskBeyond",
                      WithKey([](auto& k) { k.mutable_mask()->add_joints(24); }),
                      kInvalid,
                      "keyframes[0].mask.joints[0]",
                      {"24", "23"}},
        BadStreamCase{"TooClose",
                      [](Key key) {
                        Requests requests = {MusicConfigRequest(), key};
                        key.mutable_keyframe()->set_id("next");
                        key.mutable_keyframe()->set_frame(41);
                        requests.push_back(key);
                        return requests;
                      },
                      kInvalid,
                      "keyframes[1].frame",
                      {"41", "40"}},
        BadStreamCase{"TwoIdsOnOneFrame",
                      [](Key key) {
                        Requests requests = {MusicConfigRequest(), key};
                        key.mutable_keyframe()->set_id("twin");
                        requests.push_back(key);
                        return requests;
                      },
                      kInvalid,
                      "keyframes[1].frame",
                      {"40", "k"}}),
    [](const auto& suite) { return std::string(suite.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Audio, BadStreamTest,
    testing::Values(
        BadStreamCase{
            "Gap",
            [](const Key&) {
              return Requests{MusicConfigRequest(), AudioRequest(100, 0), AudioRequest(100, 101)};
            },
            grpc::StatusCode::OUT_OF_RANGE,
            "audio.first_sample",
            {"101", "100"}},
        BadStreamCase{
            "Overlap",
            [](const Key&) {
              return Requests{MusicConfigRequest(), AudioRequest(100, 0), AudioRequest(100, 99)};
            },
            grpc::StatusCode::OUT_OF_RANGE,
            "audio.first_sample",
            {"99", "100"}},
        BadStreamCase{"LateStart",
                      [](const Key&) {
                        v1::StreamDanceRequest config = MusicConfigRequest();
                        config.mutable_config()->mutable_audio_format()->set_first_sample(5000);
                        return Requests{config};
                      },
                      grpc::StatusCode::OUT_OF_RANGE,
                      "config.audio_format.first_sample",
                      {"5000"}},
        BadStreamCase{"NaN",
                      [](const Key&) {
                        v1::StreamDanceRequest audio = AudioRequest(100, 0);
                        const float nan = std::numeric_limits<float>::quiet_NaN();
                        audio.mutable_audio()->mutable_data()->replace(
                            4 * 42, 4, reinterpret_cast<const char*>(&nan), 4);
                        return Requests{MusicConfigRequest(), audio};
                      },
                      kInvalid,
                      "audio.data",
                      {"nan", "42"}},
        BadStreamCase{"HalfASample",
                      [](const Key&) {
                        v1::StreamDanceRequest audio = AudioRequest(100, 0);
                        audio.mutable_audio()->mutable_data()->pop_back();
                        return Requests{MusicConfigRequest(), audio};
                      },
                      kInvalid,
                      "audio.data",
                      {"399"}},
        BadStreamCase{"WithoutFormat",
                      [](const Key&) {
                        return Requests{ConfigRequest(), AudioRequest(100, 0)};
                      },
                      kInvalid,
                      "audio",
                      {"config.audio_format"}},
        BadStreamCase{"None",
                      [](const Key&) { return Requests{MusicConfigRequest()}; },
                      kInvalid,
                      "audio",
                      {"without a sample"}},
        BadStreamCase{"NotAFile",
                      [](const Key&) {
                        v1::StreamDanceRequest config = ConfigRequest();
                        config.mutable_config()->mutable_audio_format()->set_encoding(
                            v1::AUDIO_ENCODING_FILE);
                        return Requests{config, AudioRequest(1000, 0)};
                      },
                      kInvalid,
                      "audio",
                      {}}),
    [](const auto& suite) { return std::string(suite.param.name); });

class MessageLimitTest : public ServerTest {};

TEST_F(MessageLimitTest, OversizeMessagesAreRefused) {
  Start();
  const Answer answer = Dance({MusicConfigRequest(), AudioRequest(5 << 20, 0)});
  EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_NE(answer.status.error_message().find(std::to_string(16 << 20)), std::string::npos)
      << answer.status.error_message();
  ExpectIdle();
}

}  // namespace
}  // namespace choreo
