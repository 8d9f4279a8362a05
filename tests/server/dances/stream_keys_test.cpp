#include <gmock/gmock.h>

#include <algorithm>

#include "tests/server/fixture.h"

namespace choreo::stream_keys_test {

class StreamKeysTest : public ServerTest {
 protected:
  // Starts a dance of 120 frames whose keys will be edited.
  void Begin(DanceClient& client) {
    v1::DanceConfig config = Config();
    config.set_frames(120);
    client.Send(config);
    client.SendGenerateUntil(1);
  }
};

TEST_F(StreamKeysTest, LateKeysAreRejectedByEvent) {
  Start();
  DanceClient client(stub());
  Begin(client);
  client.SendKeyframe(Key("a", 50));
  client.SendKeyframe(Key("b", 100));
  client.SendGenerateUntil(60);
  ASSERT_TRUE(client.ReadFrames(51));
  client.SendKeyframe(Key("late", 20));
  client.SendKeyframe(Key("b", 90));  // moved, in time
  const Answer& answer = client.Finish();
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_EQ(answer.Join().count, 120);
  const auto rejected = std::find_if(answer.events.begin(), answer.events.end(),
                                     [](const auto& e) { return e.has_keyframe_rejected(); });
  ASSERT_NE(rejected, answer.events.end());
  EXPECT_EQ(rejected->frame(), 20);
  EXPECT_EQ(rejected->keyframe_rejected().id(), "late");
  EXPECT_GE(rejected->keyframe_rejected().earliest_frame(), 60);
  ASSERT_EQ(answer.summary->report().keyframes_size(), 2);
  EXPECT_EQ(answer.summary->report().keyframes(1).frame(), 90);
}

TEST_F(StreamKeysTest, RejectionsSayWhyToPrograms) {
  Start();
  using Said = std::pair<std::string, v1::RejectionCode>;
  const auto rejections = [](const Answer& answer) {
    std::vector<Said> said;
    for (const v1::Event& event : answer.events) {
      const auto& rejected = event.keyframe_rejected();
      if (event.has_keyframe_rejected()) said.emplace_back(rejected.id(), rejected.code());
    }
    return said;
  };
  const auto remove = [](DanceClient& client, const std::string& id) {
    v1::StreamDanceRequest request;
    request.mutable_remove_keyframe()->set_id(id);
    client.Send(request);
  };
  DanceClient client(stub());
  Begin(client);
  client.SendKeyframe(Key("a", 50));
  client.SendGenerateUntil(60);
  ASSERT_TRUE(client.ReadFrames(51));
  client.SendKeyframe(Key("late", 20));
  client.SendKeyframe(Key("a", 80));
  remove(client, "a");
  remove(client, "late");
  const Answer& answer = client.Finish();
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_EQ(rejections(answer), (std::vector<Said>{{"late", v1::REJECTION_CODE_TOO_LATE},
                                                   {"a", v1::REJECTION_CODE_FROZEN},
                                                   {"a", v1::REJECTION_CODE_FROZEN},
                                                   {"late", v1::REJECTION_CODE_REJECTED_BEFORE}}));

  DanceClient other(stub());
  v1::DanceConfig config = Config();
  const auto after = std::ranges::find_if(
      answer.continuations, [](const v1::Continuation& from) { return from.frame() > 50; });
  ASSERT_NE(after, answer.continuations.end());
  *config.mutable_continuation() = *after;
  config.set_frames(120);
  other.Send(config);
  other.SendKeyframe(Key("never", 40));
  other.SendKeyframe(Key("a", 50));
  const Answer& rest = other.Finish();
  ASSERT_TRUE(rest.status.ok()) << rest.status.error_message();
  EXPECT_EQ(rejections(rest), (std::vector<Said>{{"never", v1::REJECTION_CODE_ALREADY_DANCED}}));
  // As it was reached before, with the same figures.
  const auto first = [](const Answer& said) {
    return std::ranges::find_if(said.events, &v1::Event::has_keyframe_reached)->SerializeAsString();
  };
  EXPECT_EQ(first(rest), first(answer));
  const v1::QualityReport& report = rest.summary->report();
  ASSERT_EQ(report.keyframes_size(), answer.summary->report().keyframes_size());
  EXPECT_EQ(report.keyframes(0).errors().SerializeAsString(),
            answer.summary->report().keyframes(0).errors().SerializeAsString());
}

TEST_F(StreamKeysTest, InvalidKeysAreRejectedAndTheDanceGoesOnWhereThatIsAskedFor) {
  Start();
  const auto dance = [&](bool rejects, bool invalid) {
    auto client = std::make_unique<DanceClient>(stub());
    v1::DanceConfig config = Config();
    config.set_frames(120);
    config.set_reject_invalid_keys(rejects);
    client->Send(config);
    client->SendGenerateUntil(1);
    client->SendKeyframe(Key("a", 50));
    if (invalid) {
      v1::Keyframe bodiless = Key("bodiless", 80);
      bodiless.mutable_pose()->mutable_rotations()->Truncate(7);
      client->SendKeyframe(bodiless);
      v1::Keyframe timeless = Key("timeless", 80);
      timeless.set_time(-1);
      client->SendKeyframe(timeless);
      client->SendKeyframe(Key("near", 51));
      client->SendKeyframe(Key("behind", 120));
      client->SendKeyframe(Key("", 90));
    }
    client->SendKeyframe(Key("b", 100));
    return client;
  };
  const auto calm = dance(true, false), ended = dance(false, true), disturbed = dance(true, true);
  EXPECT_EQ(ended->Finish().status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  const Answer& answer = disturbed->Finish();
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_EQ(answer.Join(), calm->Finish().Join()) << "they change nothing";
  using Said = std::tuple<std::string, int64_t, std::string, std::string>;
  std::vector<Said> said;
  for (const v1::Event& event : answer.events) {
    if (!event.has_keyframe_rejected()) continue;
    const auto& rejected = event.keyframe_rejected();
    EXPECT_EQ(rejected.code(), v1::REJECTION_CODE_INVALID);
    said.emplace_back(rejected.id(), event.frame(), rejected.field(), rejected.reason());
  }
  ASSERT_EQ(said.size(), 5U);
  EXPECT_EQ(std::get<2>(said[0]), "keyframe.pose.rotations");
  EXPECT_EQ(said[1], Said("timeless", -1, "keyframe.time", "-1 s is not in [0, 3600]"));
  EXPECT_EQ(said[2], Said("near", 51, "keyframe.frame",
                          "frame 51 is closer than 2 frames to key \"a\" at 50"));
  EXPECT_EQ(std::get<1>(said[3]), 120);
  EXPECT_EQ(std::get<2>(said[4]), "keyframe.id");
}

TEST_F(StreamKeysTest, RemovalsOfUnknownKeysAreRejectedWhereThatIsAskedFor) {
  Start();
  const auto dance = [&](bool rejects) {
    DanceClient client(stub());
    v1::DanceConfig config = Config();
    config.set_frames(60);
    config.set_reject_invalid_keys(rejects);
    client.Send(config);
    v1::StreamDanceRequest removal;
    removal.mutable_remove_keyframe()->set_id("nobody");
    client.Send(removal);
    return client.Finish();
  };
  EXPECT_EQ(dance(false).status.error_code(), grpc::StatusCode::NOT_FOUND);
  const Answer answer = dance(true);
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  const auto rejected = std::ranges::find_if(answer.events, &v1::Event::has_keyframe_rejected);
  ASSERT_NE(rejected, answer.events.end());
  EXPECT_EQ(rejected->frame(), -1);
  EXPECT_EQ(rejected->keyframe_rejected().id(), "nobody");
  EXPECT_EQ(rejected->keyframe_rejected().code(), v1::REJECTION_CODE_INVALID);
  EXPECT_EQ(rejected->keyframe_rejected().field(), "remove_keyframe.id");
}

TEST_F(StreamKeysTest, RemovalsAfterTheLastKeyAreRejectedWhereThatIsAskedFor) {
  Start();
  const auto dance = [&](bool rejects) {
    DanceClient client(stub());
    v1::DanceConfig config = Config();
    config.set_frames(60);
    config.set_reject_invalid_keys(rejects);
    client.Send(config);
    client.SendKeyframe(Key("a", 30));
    v1::StreamDanceRequest request;
    request.mutable_keyframes_complete();
    client.Send(request);
    request.mutable_remove_keyframe()->set_id("a");
    client.Send(request);
    return client.Finish();
  };
  EXPECT_EQ(dance(false).status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  const Answer answer = dance(true);
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  const auto rejected = std::ranges::find_if(answer.events, &v1::Event::has_keyframe_rejected);
  ASSERT_NE(rejected, answer.events.end());
  EXPECT_EQ(rejected->keyframe_rejected().id(), "a");
  EXPECT_EQ(rejected->keyframe_rejected().code(), v1::REJECTION_CODE_INVALID);
  EXPECT_EQ(rejected->keyframe_rejected().field(), "remove_keyframe");
  EXPECT_EQ(rejected->keyframe_rejected().earliest_frame(), -1);
}

TEST_F(StreamKeysTest, ImpossibleKeysAreWarnedOfOnce) {
  Start();
  DanceClient client(stub());
  Begin(client);
  for (const auto& [id, frame] : {std::pair("a", 50), {"held", 56}, {"b", 100}}) {
    v1::Keyframe key = Key(id, frame);
    key.mutable_pose()->set_rotations(3 * Skeleton::Smpl24().left_knee,
                                      id[0] == 'b' ? 3.0F : -0.7F);
    client.SendKeyframe(key);
  }
  const Answer& answer = client.Finish();
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  std::vector<std::pair<int64_t, std::string>> said;
  for (const v1::Event& event : answer.events) {
    const bool of_knee = event.warning().message().find("left_knee") != std::string::npos;
    if (of_knee && event.warning().code() == v1::WARNING_CODE_KEY_IMPOSSIBLE)
      said.emplace_back(event.frame(), event.warning().message());
  }
  EXPECT_THAT(
      said, testing::ElementsAre(
                testing::Pair(50,
                              "key \"a\": left_knee bends 39.86 degrees backwards, "
                              "further than 15"),
                testing::Pair(100, "key \"b\": left_knee bends 170.81 degrees, further than 165")));
}

TEST_F(StreamKeysTest, EventsRepeatWhatHandsDoAndFramesDoNot) {
  Start();
  const auto dance = [&](v1::HandPose hands) {
    DanceClient client(stub());
    Begin(client);
    v1::Keyframe key = Key("a", 50);
    key.set_hands(hands);
    client.SendKeyframe(key);
    client.SendKeyframe(Key("b", 100));
    return client.Finish();
  };
  const Answer fist = dance(v1::HAND_POSE_FIST), none = dance(v1::HAND_POSE_UNSPECIFIED);
  std::vector<v1::HandPose> said;
  for (const v1::Event& event : fist.events)
    if (event.has_keyframe_reached()) said.push_back(event.keyframe_reached().hands());
  EXPECT_EQ(said, (std::vector{v1::HAND_POSE_FIST, v1::HAND_POSE_UNSPECIFIED}));
  EXPECT_EQ(fist.Join().rotations, none.Join().rotations);
}

TEST_F(StreamKeysTest, HandsOfAKeyThatComesTooLateAreNotRepeated) {
  Start();
  DanceClient client(stub());
  Begin(client);
  v1::Keyframe key = Key("a", 50);
  key.set_hands(v1::HAND_POSE_FIST);
  client.SendKeyframe(key);
  client.SendGenerateUntil(51);
  key.set_hands(v1::HAND_POSE_OPEN);
  client.SendKeyframe(key);
  const Answer answer = client.Finish();
  std::vector<v1::HandPose> said;
  int rejected = 0;
  for (const v1::Event& event : answer.events) {
    if (event.has_keyframe_reached()) said.push_back(event.keyframe_reached().hands());
    rejected += event.has_keyframe_rejected();
  }
  EXPECT_EQ(rejected, 1);
  EXPECT_EQ(said, std::vector{v1::HAND_POSE_FIST});
}

TEST_F(StreamKeysTest, KeysAreAddedMovedAndRemovedAfterTheFrontier) {
  Start();
  DanceClient client(stub());
  Begin(client);
  client.SendKeyframe(Key("a", 30));
  client.SendKeyframe(Key("b", 60));
  client.SendKeyframe(Key("c", 90));
  client.SendGenerateUntil(31);
  ASSERT_TRUE(client.ReadFrames(31));
  v1::StreamDanceRequest remove;
  remove.mutable_remove_keyframe()->set_id("b");
  client.Send(remove);
  client.SendKeyframe(Key("c", 100));
  v1::Keyframe added = Key("d", 75);
  added.mutable_pose()->clear_root_position();
  client.SendKeyframe(added);
  const Answer& answer = client.Finish();
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_EQ(answer.Join().count, 120);
  EXPECT_EQ(answer.ReachedKeys(), (std::vector<std::string>{"a", "d", "c"}));
  const v1::QualityReport& report = answer.summary->report();
  ASSERT_EQ(report.keyframes_size(), 3);
  EXPECT_EQ(report.keyframes(1).frame(), 75);
  EXPECT_EQ(report.keyframes(2).frame(), 100);
}

TEST_F(StreamKeysTest, TimesAndIntervalsPlaceKeys) {
  Start();
  DanceClient client(stub());
  client.Send(Config());
  v1::Keyframe first = Key("first", 0);
  first.set_time(1.01);  // nearest frame: 30
  client.SendKeyframe(first);
  v1::Keyframe second = Key("second", 0, 0.1, 0.5);
  second.set_interval_after_previous(25);
  client.SendKeyframe(second);
  const Answer& answer = client.Finish();
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  ASSERT_EQ(answer.summary->report().keyframes_size(), 2);
  EXPECT_EQ(answer.summary->report().keyframes(0).frame(), 30);
  EXPECT_EQ(answer.summary->report().keyframes(1).frame(), 55);
}

TEST_F(StreamKeysTest, MaskedKeysLeaveTheRestAlone) {
  Start();
  const auto elbow = static_cast<size_t>(Skeleton::Smpl24().left_elbow);
  auto dance = [&](float other_elbow) {
    v1::Keyframe key = Key("masked", 40);
    key.mutable_pose()->clear_root_position();
    key.mutable_mask()->add_joints(static_cast<int>(elbow));
    const int right = 3 * Skeleton::Smpl24().right_elbow + 1;
    key.mutable_pose()->set_rotations(right, other_elbow);  // masked out
    DanceClient client(stub());
    client.Send(Config());
    client.SendKeyframe(key);
    return client.Finish();
  };
  const Answer answer = dance(0);
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  const Answer::Joined joined = answer.Join();
  EXPECT_NEAR(joined.rotations[40 * 72 + 3 * elbow + 1], 0.8, 1e-5);
  EXPECT_TRUE(joined == dance(1.2F).Join());
}

// Frames are sent up to generate_until, and the key after it moves, in any order of keys.
TEST_F(StreamKeysTest, KeysMoveDuringTheirTransition) {
  Start();
  const auto dance = [this](bool move) {
    DanceClient client(stub());
    v1::DanceConfig config = Config();
    config.set_frames(150);
    config.set_generate_until(0);
    client.Send(config);
    client.SendKeyframe(Key("b", 110));
    client.SendKeyframe(Key("a", 60, -0.2, 0.9, 1.5F));
    client.SendGenerateUntil(20);
    EXPECT_TRUE(client.ReadFrames(20));
    if (move) client.SendKeyframe(Key("a", 50, -0.2, 0.9, 1.5F));
    for (int64_t frame = 21; frame <= 40; ++frame) client.SendGenerateUntil(frame);
    EXPECT_TRUE(client.ReadFrames(40));
    return client.Finish();
  };
  const Answer plain = dance(false), moved = dance(true);
  ASSERT_TRUE(plain.status.ok()) << plain.status.error_message();
  ASSERT_TRUE(moved.status.ok()) << moved.status.error_message();
  EXPECT_EQ(moved.ReachedKeys(), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(moved.summary->report().keyframes(0).frame(), 50);
  EXPECT_LE(moved.summary->report().keyframes(0).errors().final_error_m(), 1e-3);
  const Answer::Joined a = plain.Join(), b = moved.Join();
  EXPECT_TRUE(std::equal(a.rotations.begin(), a.rotations.begin() + std::ptrdiff_t{20} * 72,
                         b.rotations.begin()));
  EXPECT_FALSE(a == b);
  ASSERT_FALSE(moved.continuations.empty());
  EXPECT_EQ(moved.continuations[0].frame(), 20) << "there the way to the former place ends";
  EXPECT_EQ(plain.continuations[0].frame(), 61);
}

// So that a page can mark it.
TEST_F(StreamKeysTest, ErrorsAndWarningsNameTheirKey) {
  Start();
  DanceClient bad(stub());
  bad.Send(Config());
  v1::Keyframe wrong = Key("wrong", 20);
  wrong.mutable_pose()->set_rotations(0, 1000);
  bad.SendKeyframe(wrong);
  const Details details = DetailsOf(bad.Finish().status);
  EXPECT_EQ(details.error_info->metadata().at("keyframe_id"), "wrong");

  DanceClient far(stub());
  far.Send(Config());
  far.SendKeyframe(Key("near", 20));
  far.SendKeyframe(Key("far", 30, 50));
  std::map<v1::WarningCode, v1::Event> warnings;
  for (const v1::Event& event : far.Finish().events) {
    if (event.has_warning()) warnings[event.warning().code()] = event;
  }
  const v1::Event& warned = warnings[v1::WARNING_CODE_INTERVAL_TOO_SHORT];
  EXPECT_EQ(warned.frame(), 30);
  EXPECT_EQ(warned.warning().keyframe_id(), "far");
}

}  // namespace choreo::stream_keys_test
