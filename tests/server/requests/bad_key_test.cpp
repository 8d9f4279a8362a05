#include <limits>
#include <utility>

#include "tests/server/requests/bad_stream.h"

namespace choreo::bad_key_test {

// One key changed after a good configuration; errors are in "keyframes[0]" + `at`.
BadStreamCase Bad(const std::string& name, std::function<void(v1::Keyframe&)> change,
                  const std::string& at, std::vector<std::string> says) {
  return {name,
          [change = std::move(change)](KeyMessage key) -> Requests {
            change(*key.mutable_keyframe());
            return {ConfigRequest(), key};
          },
          "keyframes[0]" + at, std::move(says)};
}
BadStreamCase Bad(const std::string& name, const std::string& text, const std::string& at,
                  std::vector<std::string> says) {
  return Bad(
      name, [text](v1::Keyframe& key) { Merge(text, &key); }, at, std::move(says));
}

auto WithRotation(int index, float value) {
  return [=](v1::Keyframe& key) { key.mutable_pose()->set_rotations(index, value); };
}

// Another key after the good one.
auto WithNext(const std::string& text) {
  return [text](const KeyMessage& key) {
    Requests requests = {MusicConfigRequest(), key, key};
    Merge(text, requests.back().mutable_keyframe());
    return requests;
  };
}

// A key at 10 s, in a dance of 2.
Requests BeyondTheEnd(KeyMessage key) {
  Requests requests = {ConfigRequest(), std::move(key)};
  requests[0].mutable_config()->set_frames(60);
  requests[1].mutable_keyframe()->set_time(10);
  return requests;
}

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

INSTANTIATE_TEST_SUITE_P(
    Keys, BadStreamTest,
    testing::Values(
        Bad("NoPose", [](auto& k) { k.clear_pose(); }, ".pose", {"missing"}),
        Bad("NoWhen", [](auto& k) { k.clear_when(); }, "", {"frame, time"}),
        Bad("NoId", [](auto& k) { k.clear_id(); }, ".id", {"0 bytes"}),
        Bad("NoJoints", [](auto& k) { k.mutable_pose()->clear_rotations(); }, ".rotations",
            {"0 joints", "24"}),
        Bad("Joints23", [](auto& k) { k.mutable_pose()->mutable_rotations()->Truncate(69); },
            ".rotations", {"23 joints", "24"}),
        Bad("Joints25", "pose { rotations: [0, 0, 0] }", ".rotations", {"25 joints", "24"}),
        Bad("HitNaN", "hit: nan", ".hit", {"nan", "[0, 3]"}),
        Bad("Hands", "hands: 9", ".hands", {"9", "0 to 5"}),
        Bad("NaN", WithRotation(50, kNaN), ".rotations[16]", {"nan", "not finite"}),
        Bad("Infinite", WithRotation(0, kInfinity), ".rotations[0]", {"inf", "not finite"}),
        Bad("AbsurdRotation", WithRotation(48, 7.9F), ".rotations[16]", {"7.9 rad", "2π"}),
        Bad("AbsurdPosition", "pose { root_position { z: 2e4 } }", ".root_position[2]",
            {"20000", "10000"}),
        Bad("PositionNaN", "pose { root_position { x: nan } }", ".root_position[0]",
            {"nan", "not finite"}),
        Bad("PositionInfinite", "pose { root_position { y: inf } }", ".root_position[1]",
            {"inf", "not finite"}),
        Bad("NegativeFrame", "frame: -1", ".frame", {"-1", "108000"}),
        Bad("HugeFrame", "frame: 4611686018427387904", ".frame", {"4611686018427387904", "108000"}),
        Bad("TimeNaN", "time: nan", ".time", {"nan", "not finite"}),
        Bad("IntervalZero", "interval_after_previous: 0", ".interval_after_previous",
            {"0 ", "[2, "}),
        Bad("IntervalNegative", "interval_after_previous: -7", ".interval_after_previous",
            {"-7", "[2, "}),
        Bad("IntervalHuge", "interval_after_previous: 9223372036854775807",
            ".interval_after_previous", {"9223372036854775807", "[2, "}),
        Bad("MaskTwice", "mask { joints: [3, 3] }", ".mask.joints[1]",
            {"3 is not after", "strictly increasing"}),
        Bad("MaskBeyond", "mask { joints: 24 }", ".mask.joints[0]", {"24", "23"}),
        BadStreamCase{"BeyondTheEnd",
                      BeyondTheEnd,
                      "keyframes[0].time",
                      {"10 s is not before the end of the dance, 2 s"}},
        BadStreamCase{
            "TooClose", WithNext("id: 'next' frame: 41"), "keyframes[1].frame", {"41", "40"}},
        BadStreamCase{
            "TwoIdsOnOneFrame", WithNext("id: 'twin'"), "keyframes[1].frame", {"40", "k"}}),
    NameOf);

}  // namespace choreo::bad_key_test
