#include <cmath>
#include <limits>

#include "tests/server/bad_stream.h"

namespace choreo::bad_key_test {

INSTANTIATE_TEST_SUITE_P(
    Keys, BadStreamTest,
    testing::Values(
        BadStreamCase{"NoPose",
                      WithKey([](auto& k) { k.clear_pose(); }),
                      kInvalidStatus,
                      "keyframes[0].pose",
                      {"missing"}},
        BadStreamCase{"NoWhen",
                      WithKey([](auto& k) { k.clear_when(); }),
                      kInvalidStatus,
                      "keyframes[0]",
                      {"frame, time"}},
        BadStreamCase{"NoId",
                      WithKey([](auto& k) { k.clear_id(); }),
                      kInvalidStatus,
                      "keyframes[0].id",
                      {"0 bytes"}},
        BadStreamCase{"NoJoints",
                      WithKey([](auto& k) { k.mutable_pose()->clear_rotations(); }),
                      kInvalidStatus,
                      "keyframes[0].rotations",
                      {"0 joints", "24"}},
        BadStreamCase{"Joints23",
                      WithKey([](auto& k) { k.mutable_pose()->mutable_rotations()->Truncate(69); }),
                      kInvalidStatus,
                      "keyframes[0].rotations",
                      {"23 joints", "24"}},
        BadStreamCase{"Joints25",
                      WithKey([](auto& k) {
                        for (int i = 0; i < 3; ++i) k.mutable_pose()->add_rotations(0);
                      }),
                      kInvalidStatus,
                      "keyframes[0].rotations",
                      {"25 joints", "24"}},
        BadStreamCase{"HitNaN",
                      WithKey([](auto& k) { k.set_hit(std::nan("")); }),
                      kInvalidStatus,
                      "keyframes[0].hit",
                      {"nan", "[0, 3]"}},
        BadStreamCase{"Hands",
                      WithKey([](auto& k) { k.set_hands(static_cast<v1::HandPose>(9)); }),
                      kInvalidStatus,
                      "keyframes[0].hands",
                      {"9", "0 to 5"}},
        BadStreamCase{"NaN",
                      WithKey([](auto& k) {
                        k.mutable_pose()->set_rotations(50,
                                                        std::numeric_limits<float>::quiet_NaN());
                      }),
                      kInvalidStatus,
                      "keyframes[0].rotations[16]",
                      {"nan", "not finite"}},
        BadStreamCase{"Infinite",
                      WithKey([](auto& k) {
                        k.mutable_pose()->set_rotations(0, std::numeric_limits<float>::infinity());
                      }),
                      kInvalidStatus,
                      "keyframes[0].rotations[0]",
                      {"inf", "not finite"}},
        BadStreamCase{"AbsurdRotation",
                      WithKey([](auto& k) { k.mutable_pose()->set_rotations(48, 7.9F); }),
                      kInvalidStatus,
                      "keyframes[0].rotations[16]",
                      {"7.9 rad", "2π"}},
        BadStreamCase{
            "AbsurdPosition",
            WithKey([](auto& k) { k.mutable_pose()->mutable_root_position()->set_z(2e4); }),
            kInvalidStatus,
            "keyframes[0].root_position[2]",
            {"20000", "10000"}},
        BadStreamCase{"PositionNaN",
                      WithKey([](auto& k) {
                        k.mutable_pose()->mutable_root_position()->set_x(std::nan(""));
                      }),
                      kInvalidStatus,
                      "keyframes[0].root_position[0]",
                      {"nan", "not finite"}},
        BadStreamCase{"PositionInfinite",
                      WithKey([](auto& k) {
                        k.mutable_pose()->mutable_root_position()->set_y(
                            std::numeric_limits<double>::infinity());
                      }),
                      kInvalidStatus,
                      "keyframes[0].root_position[1]",
                      {"inf", "not finite"}},
        BadStreamCase{"NegativeFrame",
                      WithKey([](auto& k) { k.set_frame(-1); }),
                      kInvalidStatus,
                      "keyframes[0].frame",
                      {"-1", "108000"}},
        BadStreamCase{"HugeFrame",
                      WithKey([](auto& k) { k.set_frame(int64_t{1} << 62); }),
                      kInvalidStatus,
                      "keyframes[0].frame",
                      {"4611686018427387904", "108000"}},
        BadStreamCase{"TimeNaN",
                      WithKey([](auto& k) { k.set_time(std::nan("")); }),
                      kInvalidStatus,
                      "keyframes[0].time",
                      {"nan", "not finite"}},
        BadStreamCase{"IntervalZero",
                      WithKey([](auto& k) { k.set_interval_after_previous(0); }),
                      kInvalidStatus,
                      "keyframes[0].interval_after_previous",
                      {"0 ", "[2, "}},
        BadStreamCase{"IntervalNegative",
                      WithKey([](auto& k) { k.set_interval_after_previous(-7); }),
                      kInvalidStatus,
                      "keyframes[0].interval_after_previous",
                      {"-7", "[2, "}},
        BadStreamCase{"IntervalHuge",
                      WithKey([](auto& k) {
                        k.set_interval_after_previous(std::numeric_limits<int64_t>::max());
                      }),
                      kInvalidStatus,
                      "keyframes[0].interval_after_previous",
                      {"9223372036854775807", "[2, "}},
        BadStreamCase{"MaskTwice",
                      WithKey([](auto& k) {
                        k.mutable_mask()->add_joints(3);
                        k.mutable_mask()->add_joints(3);
                      }),
                      kInvalidStatus,
                      "keyframes[0].mask.joints[1]",
                      {"3"}},
        BadStreamCase{"MaskBeyond",
                      WithKey([](auto& k) { k.mutable_mask()->add_joints(24); }),
                      kInvalidStatus,
                      "keyframes[0].mask.joints[0]",
                      {"24", "23"}},
        BadStreamCase{"TooClose",
                      [](KeyMessage key) {
                        Requests requests = {MusicConfigRequest(), key};
                        key.mutable_keyframe()->set_id("next");
                        key.mutable_keyframe()->set_frame(41);
                        requests.push_back(key);
                        return requests;
                      },
                      kInvalidStatus,
                      "keyframes[1].frame",
                      {"41", "40"}},
        BadStreamCase{"TwoIdsOnOneFrame",
                      [](KeyMessage key) {
                        Requests requests = {MusicConfigRequest(), key};
                        key.mutable_keyframe()->set_id("twin");
                        requests.push_back(key);
                        return requests;
                      },
                      kInvalidStatus,
                      "keyframes[1].frame",
                      {"40", "k"}}),
    NameOf);

}  // namespace choreo::bad_key_test
