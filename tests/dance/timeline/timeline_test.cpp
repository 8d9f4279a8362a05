#include "model/dance/timeline/timeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "model/core/error.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo::timeline_test {

using ::testing::HasSubstr;

Pose Rest() { return RestPose(Skeleton::Smpl24()); }

std::optional<KeyRejected> Set(Timeline& timeline, const std::string& id, const KeyMoment& when) {
  return timeline.Set({.id = id, .pose = Rest()}, when, "keyframes[0]");
}

struct Span {
  int64_t from, to;
  std::string key;  // empty: none
  bool operator==(const Span&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Span& span) {
  return out << "[" << span.from << ", " << span.to << ") " << span.key;
}

// The dance so far: transitions that are completely granted. `turn` says for each where music ends
// it. One that would begin after the end has no frames, and counts as none.
std::vector<Span> Drain(Timeline& timeline, size_t limit = 1000,
                        int64_t (*turn)(const Segment&) = nullptr) {
  std::vector<Span> spans;
  while (spans.size() < limit) {
    const Segment* segment = timeline.Planned();
    if (segment == nullptr || segment->from >= timeline.End().value_or(INT64_MAX)) break;
    if (turn != nullptr) timeline.StopAt(turn(*segment));
    const int64_t last = std::min(segment->stop, timeline.End().value_or(segment->stop)) - 1;
    if (last >= segment->from && !timeline.IsCertain(last)) break;
    spans.push_back({segment->from, segment->stop, segment->key ? segment->key->id : ""});
    timeline.Finish();
  }
  return spans;
}

template <typename Call>
std::string Refusal(Call call, ErrorCode code = ErrorCode::kInvalidArgument) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return "";
}

TEST(Timeline, TransitionsWithoutAKeyEndAtCuts) {
  Timeline timeline({.end_frame = 400});
  timeline.SetCuts({70, 100, 300});
  timeline.GenerateUntil(400);
  EXPECT_EQ(Drain(timeline), (std::vector<Span>{{0, 70, ""},
                                                {70, 100, ""},
                                                {100, 160, ""},
                                                {160, 220, ""},
                                                {220, 300, ""},
                                                {300, 360, ""},
                                                {360, 420, ""}}));
}

TEST(Timeline, CutsApplyToEarlierPlans) {
  Timeline timeline({.end_frame = 200});
  timeline.GenerateUntil(200);
  timeline.SetCuts({70, 75});
  EXPECT_EQ(Drain(timeline),
            (std::vector<Span>{{0, 70, ""}, {70, 130, ""}, {130, 190, ""}, {190, 250, ""}}));
}

TEST(Timeline, CutsDoNotSplitTransitionsToAKey) {
  Timeline timeline({});
  timeline.SetCuts({20});
  EXPECT_EQ(Set(timeline, "a", AtFrame{40}), std::nullopt);
  EXPECT_EQ(Drain(timeline), (std::vector<Span>{{0, 41, "a"}}));
}

TEST(Timeline, ARuleReplacesCutsWhereNoKeyIsAhead) {
  Timeline timeline({.end_frame = 150});
  timeline.SetCuts({50, 100});
  timeline.SetCutRule([](int64_t from) { return from + 45; });
  EXPECT_EQ(Set(timeline, "a", AtFrame{30}), std::nullopt);
  timeline.GenerateUntil(150);
  EXPECT_EQ(Drain(timeline),
            (std::vector<Span>{{0, 31, "a"}, {31, 76, ""}, {76, 121, ""}, {121, 166, ""}}));
}

TEST(Timeline, EachKeyGrantsUpToItself) {
  Timeline timeline({});
  EXPECT_EQ(Set(timeline, "a", AtFrame{30}), std::nullopt);
  EXPECT_EQ(Drain(timeline), (std::vector<Span>{{0, 31, "a"}}));
  EXPECT_EQ(Set(timeline, "b", AtFrame{90}), std::nullopt);
  EXPECT_EQ(Drain(timeline), (std::vector<Span>{{31, 91, "b"}}));
  timeline.Complete();
  EXPECT_EQ(Drain(timeline), std::vector<Span>());
  EXPECT_EQ(timeline.End(), 91);
}

// A client that grants frames may continue after its last key; the music's end is unknown yet.
TEST(Timeline, GrantsAfterTheLastKeyChangeNothing) {
  Timeline timeline({.has_music = true});
  timeline.Complete();
  timeline.GenerateUntil(0);
  timeline.GenerateUntil(500);
  EXPECT_THAT(Refusal([&] { timeline.GenerateUntil(499); }), HasSubstr("until: 499"));
  timeline.SetAudioEnd(100);
  EXPECT_EQ(Drain(timeline), (std::vector<Span>{{0, 60, ""}, {60, 120, ""}}));
  EXPECT_EQ(timeline.End(), 100);
}

TEST(Timeline, TimesRoundToTheGrid) {
  Timeline timeline({});
  Set(timeline, "a", AtTime{1.016});      // 30.48
  Set(timeline, "b", AtTime{2.0168});     // 60.504
  Set(timeline, "c", AfterPrevious{15});  // after 61
  EXPECT_EQ(Drain(timeline), (std::vector<Span>{{0, 31, "a"}, {31, 62, "b"}, {62, 77, "c"}}));
}

// A key may lie further ahead than the longest transition, by frame, time or interval.
TEST(Timeline, AnIntervalMayBeLongerThanATransition) {
  Timeline timeline({});
  timeline.GenerateUntil(0);
  Set(timeline, "a", AtFrame{30});
  EXPECT_EQ(Set(timeline, "b", AfterPrevious{2 * kMaxTransitionFrames}), std::nullopt);
  timeline.Complete();
  EXPECT_EQ(timeline.End(), 30 + 2 * kMaxTransitionFrames + 1);
}

TEST(Timeline, IntervalsCountFromRejectedKeysToo) {
  Timeline timeline({.granted = 0});
  Set(timeline, "a", AtFrame{30});
  EXPECT_EQ(timeline.RejectInvalid("b", AfterPrevious{30}, "its pose is wrong").frame, 60);
  EXPECT_EQ(Set(timeline, "c", AfterPrevious{30}), std::nullopt);
  timeline.GenerateUntil(20);
  EXPECT_EQ(Set(timeline, "late", AtFrame{10})->code, KeyRejected::Code::kTooLate);
  EXPECT_EQ(Set(timeline, "d", AfterPrevious{90}), std::nullopt);
  // Those without a moment of the dance do not count.
  EXPECT_EQ(timeline.RejectInvalid("e", std::nullopt, "it has no moment").frame, -1);
  EXPECT_EQ(timeline.RejectInvalid("f", AfterPrevious{1}, "it is too near").frame, -1);
  EXPECT_EQ(Set(timeline, "g", AfterPrevious{10}), std::nullopt);
  timeline.Complete();
  EXPECT_EQ(Drain(timeline),
            (std::vector<Span>{{0, 31, "a"}, {31, 91, "c"}, {91, 101, "d"}, {101, 111, "g"}}));
}

TEST(Timeline, KeysAreEditedAfterTheFrontier) {
  Timeline timeline({});
  timeline.GenerateUntil(0);
  Set(timeline, "c", AtFrame{150});
  Set(timeline, "a", AtFrame{30});
  Set(timeline, "b", AtFrame{90});
  EXPECT_EQ(Drain(timeline), std::vector<Span>());
  timeline.GenerateUntil(31);
  EXPECT_EQ(Drain(timeline), (std::vector<Span>{{0, 31, "a"}}));
  Set(timeline, "b", AtFrame{60});  // moved
  timeline.Remove("c", "remove");
  timeline.GenerateUntil(61);
  EXPECT_EQ(Drain(timeline), (std::vector<Span>{{31, 61, "b"}}));
}

TEST(Timeline, RejectionsNameNoEarliestFrameWhereNoneIsOpen) {
  Timeline timeline({.end_frame = 100, .granted = 0});
  Set(timeline, "last", AtFrame{98});
  timeline.GenerateUntil(97);
  const auto late = Set(timeline, "late", AtFrame{50});
  ASSERT_TRUE(late);
  EXPECT_EQ(late->earliest_frame, -1);  // 99 would be too near to the last key
  timeline.Remove("last", "remove");
  EXPECT_EQ(Set(timeline, "late", AtFrame{50})->earliest_frame, 97);
  timeline.Complete();
  EXPECT_EQ(timeline.RejectInvalid("late", AtFrame{99}, "it is over").earliest_frame, -1);
}

TEST(Timeline, LateMessagesAreRejectedWithTheEarliestFrame) {
  Timeline timeline({});
  timeline.GenerateUntil(0);
  Set(timeline, "a", AtFrame{99});
  timeline.GenerateUntil(100);
  const auto late = Set(timeline, "b", AtFrame{50});
  ASSERT_TRUE(late);
  EXPECT_EQ(late->frame, 50);
  EXPECT_EQ(late->earliest_frame, 101);  // 100 would be closer than two frames to a
  EXPECT_EQ(Set(timeline, "b", AtFrame{101}), std::nullopt);
  ASSERT_TRUE(Set(timeline, "a", AtFrame{200}));  // danced already
  ASSERT_TRUE(timeline.Remove("a", "remove"));
  EXPECT_EQ(timeline.Remove("b", "remove"), std::nullopt);
}

// Keys that freeze without a grant surprise whoever edits them, so the rejection has a remedy.
TEST(Timeline, RejectionsExplainFreezingWithoutGrants) {
  for (const bool grants : {false, true}) {
    Timeline timeline({});
    if (grants) timeline.GenerateUntil(100);
    Set(timeline, "a", AtFrame{grants ? 110 : 99});
    if (grants) timeline.GenerateUntil(111);
    for (const auto& late : {Set(timeline, "b", AtFrame{50}), Set(timeline, "a", AtFrame{200}),
                             timeline.Remove("a", "remove")}) {
      ASSERT_TRUE(late);
      EXPECT_EQ(late->reason.ends_with("each key freezes what lies before it"), !grants)
          << late->reason;
      EXPECT_EQ(late->remedy, grants ? Remedy::kNone : Remedy::kGrantFrames);
    }
  }
}

TEST(Timeline, RefusesImpossibleKeys) {
  Timeline timeline({.end_frame = 300});
  timeline.GenerateUntil(0);
  Set(timeline, "a", AtFrame{30});
  EXPECT_THAT(Refusal([&] { Set(timeline, "b", AtFrame{30}); }),
              HasSubstr("keyframes[0].at_frame: frame 30 is already that of key \"a\""));
  EXPECT_THAT(Refusal([&] { Set(timeline, "b", AtFrame{31}); }), HasSubstr("closer than 2 frames"));
  EXPECT_THAT(Refusal([&] { Set(timeline, "b", AtFrame{29}); }), HasSubstr("closer than 2 frames"));
  EXPECT_THAT(Refusal([&] { Set(timeline, "", AtFrame{50}); }), HasSubstr("keyframes[0].id"));
  EXPECT_THAT(Refusal([&] { Set(timeline, "b", AtFrame{300}); }), HasSubstr("300"));
  EXPECT_THAT(Refusal([&] { Set(timeline, "b", AtFrame{-1}); }), HasSubstr("-1"));
  EXPECT_THAT(Refusal([&] { Set(timeline, "b", AtFrame{1LL << 60}); }), HasSubstr("108000"));
  EXPECT_THAT(Refusal([&] { Set(timeline, "b", AtTime{-0.5}); }), HasSubstr("-0.5 s"));
  EXPECT_THAT(Refusal([&] { Set(timeline, "b", AtTime{std::nan("")}); }), HasSubstr("nan"));
  EXPECT_THAT(Refusal([&] { Set(timeline, "b", AtTime{1e300}); }), HasSubstr("1e+300"));
  for (const int64_t frames : {INT64_MIN, int64_t{1}, int64_t{108'001}, INT64_MAX}) {
    EXPECT_THAT(Refusal([&] { Set(timeline, "b", AfterPrevious{frames}); }),
                HasSubstr("keyframes[0].after_previous: " + std::to_string(frames) +
                          " is not in [2, 108000]"));
  }
  EXPECT_THAT(
      Refusal([&] { Set(timeline, "b", AfterPrevious{107'971}); }),  // a stands at 30
      HasSubstr("keyframes[0].after_previous: leads to frame 108001, beyond the limit 108000"));
  EXPECT_THAT(Refusal([&] { timeline.Remove("b", "remove_keyframes[0]"); }, ErrorCode::kNotFound),
              HasSubstr("remove_keyframes[0].id: there is no key \"b\""));
  timeline.GenerateUntil(20);
  EXPECT_THAT(Refusal([&] { timeline.GenerateUntil(19); }), HasSubstr("until: 19"));
  EXPECT_THAT(Refusal([&] { timeline.GenerateUntil(1LL << 60); }), HasSubstr("108000"));
  // A key may move next to its own former place.
  EXPECT_EQ(Set(timeline, "a", AtFrame{31}), std::nullopt);
  timeline.Complete();
  EXPECT_THAT(Refusal([&] { Set(timeline, "b", AtFrame{60}); }),
              HasSubstr("comes after the keys are complete"));
  EXPECT_THAT(Refusal([&] { timeline.Complete(); }), HasSubstr("keys_complete"));
}

TEST(Timeline, HoldsAThousandKeys) {
  Timeline timeline({});
  timeline.GenerateUntil(0);
  for (int i = 0; i < kMaxKeys; ++i) Set(timeline, std::to_string(i), AtFrame{2 * i});
  EXPECT_THAT(Refusal([&] { Set(timeline, "more", AtFrame{5000}); }), HasSubstr("1000"));
  EXPECT_EQ(Set(timeline, "999", AtFrame{5000}), std::nullopt);  // moving one is free
}

TEST(Timeline, WithoutKeysTransitionsHaveAFixedLength) {
  Timeline timeline({.has_music = true});
  timeline.GenerateUntil(130);
  EXPECT_EQ(Drain(timeline), (std::vector<Span>{{0, 60, ""}, {60, 120, ""}}));
  Set(timeline, "a", AtFrame{150});
  EXPECT_EQ(Drain(timeline), std::vector<Span>());
  timeline.GenerateUntil(151);
  EXPECT_EQ(Drain(timeline), (std::vector<Span>{{120, 130, ""}, {130, 151, "a"}}));
  timeline.Complete();
  EXPECT_EQ(timeline.End(), std::nullopt);  // the music goes on
  EXPECT_EQ(Drain(timeline, 2), (std::vector<Span>{{151, 211, ""}, {211, 271, ""}}));
  timeline.SetAudioEnd(300);
  EXPECT_EQ(timeline.End(), 300);
  EXPECT_EQ(Drain(timeline), (std::vector<Span>{{271, 331, ""}}));
}

TEST(Timeline, GapsBeyondTheLongestTransitionAreCut) {
  Timeline timeline({.max_transition_frames = 100});
  Set(timeline, "a", AtFrame{249});
  // Free transitions are at most half the longest, so that the rest before the key is never tiny.
  EXPECT_EQ(Drain(timeline),
            (std::vector<Span>{{0, 50, ""}, {50, 100, ""}, {100, 150, ""}, {150, 250, "a"}}));
}

TEST(Timeline, KeysAheadAreSeenBeforeTheyAreReached) {
  Timeline timeline({.granted = 0, .sight_frames = 192});
  Set(timeline, "a", AtFrame{299});
  timeline.GenerateUntil(300);
  std::vector<Span> spans;
  std::vector<std::string> seen;
  for (; timeline.Planned() != nullptr && timeline.Planned()->from < 300; timeline.Finish()) {
    const Segment& segment = *timeline.Planned();
    spans.push_back({segment.from, segment.to, segment.key ? segment.key->id : ""});
    seen.push_back(segment.later ? segment.later->id : "");
  }
  EXPECT_EQ(spans,
            (std::vector<Span>{{0, 60, ""}, {60, 120, ""}, {120, 180, ""}, {180, 300, "a"}}));
  EXPECT_EQ(seen, (std::vector<std::string>{"", "", "a", ""})) << "299 is 180 frames after 120";
}

TEST(Timeline, AChangedKeyAheadStopsTransitionsThatSeeIt) {
  Timeline timeline({.granted = 0, .sight_frames = 192});
  Set(timeline, "far", AtFrame{300});
  timeline.GenerateUntil(10);
  Set(timeline, "far", AtFrame{310});
  timeline.GenerateUntil(20);
  EXPECT_EQ(timeline.Planned()->stop, 60) << "neither is in sight";
  Set(timeline, "near", AtFrame{150});
  timeline.GenerateUntil(60);
  EXPECT_EQ(timeline.Planned()->stop, 20);
  EXPECT_EQ(timeline.Planned()->later, std::nullopt);
  timeline.Finish();
  EXPECT_EQ(timeline.Planned()->to, 80);
  EXPECT_EQ(timeline.Planned()->later->id, "near");
}

TEST(Timeline, EndsWhereTheConfigSays) {
  Timeline timeline({.end_frame = 100});
  timeline.GenerateUntil(100);
  // The last transition is planned at its full length; its dance cuts it short.
  EXPECT_EQ(Drain(timeline), (std::vector<Span>{{0, 60, ""}, {60, 120, ""}}));
  EXPECT_TRUE(timeline.IsCertain(99));
  EXPECT_FALSE(timeline.IsCertain(100));
}

TEST(Timeline, FramesAfterTheMusicNeedAFrozenKey) {
  Timeline timeline({.has_music = true});
  timeline.GenerateUntil(120);
  timeline.SetAudioEnd(80);
  EXPECT_TRUE(timeline.IsCertain(79));
  EXPECT_FALSE(timeline.IsCertain(80));
  Set(timeline, "a", AtFrame{130});
  EXPECT_FALSE(timeline.IsCertain(80));  // it may be removed
  timeline.GenerateUntil(140);
  EXPECT_TRUE(timeline.IsCertain(130));
  EXPECT_FALSE(timeline.IsCertain(131));
  timeline.Complete();
  EXPECT_EQ(timeline.End(), 131);
}

TEST(Timeline, RejectedIdsCanBeReused) {
  Timeline timeline({.granted = 60});
  ASSERT_TRUE(Set(timeline, "a", AtFrame{30}));
  ASSERT_TRUE(timeline.Remove("a", "remove"));
  EXPECT_EQ(Set(timeline, "a", AtFrame{90}), std::nullopt);
  timeline.GenerateUntil(91);
  EXPECT_EQ(Drain(timeline), (std::vector<Span>{{0, 60, ""}, {60, 91, "a"}}));
}

// A resumed dance gets all messages again, also of keys that moved across its first frame.
TEST(Timeline, KeysBeforeTheFirstFrameKeepTheirFrames) {
  Timeline timeline({.first_frame = 60, .granted = 0});
  ASSERT_EQ(Set(timeline, "a", AtFrame{100}), std::nullopt);
  const auto before = Set(timeline, "a", AtFrame{50});
  ASSERT_TRUE(before);
  EXPECT_EQ(before->earliest_frame, 60);
  ASSERT_TRUE(Set(timeline, "b", AtFrame{40}));
  EXPECT_EQ(Set(timeline, "b", AtFrame{80}), std::nullopt);
  timeline.GenerateUntil(60);
  EXPECT_TRUE(Set(timeline, "a", AtFrame{90})) << "it was danced";
  timeline.Complete();
  EXPECT_EQ(Drain(timeline), (std::vector<Span>{{60, 81, "b"}}));
}

TEST(Timeline, GrantAloneDoesNotReplan) {
  for (const int64_t stride : {1, 7, 200}) {
    Timeline timeline({.has_music = true, .granted = 0});
    Set(timeline, "a", AtFrame{99});
    for (int64_t frame = stride; frame < 200; frame += stride) timeline.GenerateUntil(frame);
    timeline.GenerateUntil(200);
    EXPECT_EQ(Drain(timeline), (std::vector<Span>{{0, 100, "a"}, {100, 160, ""}})) << stride;
    EXPECT_TRUE(timeline.IsCertain(199));
    EXPECT_FALSE(timeline.IsCertain(200));
  }
}

TEST(Timeline, AChangeAheadStopsTheTransitionAtTheFrontier) {
  Timeline timeline({.granted = 0});
  Set(timeline, "a", AtFrame{99});
  timeline.GenerateUntil(30);
  Set(timeline, "a", AtFrame{79});   // moved
  Set(timeline, "a", AtFrame{99});   // and back: nothing changed
  Set(timeline, "b", AtFrame{150});  // after it
  timeline.GenerateUntil(40);
  Set(timeline, "a", AtFrame{79});
  Set(timeline, "c", AtFrame{60});
  EXPECT_EQ(timeline.Planned()->stop, 100) << "until more is granted, it may be moved back";
  timeline.GenerateUntil(50);
  EXPECT_EQ(timeline.Planned()->stop, 40);
  EXPECT_EQ(timeline.Planned()->to, 100);
  timeline.Remove("c", "remove");
  timeline.GenerateUntil(80);
  EXPECT_EQ(Drain(timeline), (std::vector<Span>{{0, 40, "a"}, {40, 50, "c"}, {50, 80, "a"}}));
}

TEST(Timeline, DisturbanceStopsTheTransition) {
  Timeline timeline({.has_music = true, .granted = 30});
  timeline.NoteChange(60, 90);  // after it
  timeline.NoteChange(0, 29);   // danced
  timeline.GenerateUntil(35);
  timeline.NoteChange(59, 90);
  timeline.GenerateUntil(40);
  EXPECT_EQ(Drain(timeline), (std::vector<Span>{{0, 35, ""}}));
}

// Music that depends only on what is planned.
int64_t Turn(const Segment& segment) {
  return segment.from % 3 == 0 ? segment.from + 5 + segment.from * 31 % 60 : segment.to;
}

TEST(Timeline, MusicThatTurnsEndsTheTransition) {
  Timeline timeline({.has_music = true, .granted = 0});
  Set(timeline, "a", AtFrame{79});
  timeline.GenerateUntil(100);
  ASSERT_NE(timeline.Planned(), nullptr);
  timeline.StopAt(30);
  timeline.StopAt(40);  // it is over by then
  EXPECT_EQ(timeline.Planned()->stop, 30);
  EXPECT_EQ(timeline.Planned()->to, 80);
  EXPECT_EQ(Drain(timeline, 2), (std::vector<Span>{{0, 30, "a"}, {30, 80, "a"}}));
}

// The plan must not depend on when Planned and EndAt are called.
TEST(Timeline, PlanIsAFunctionOfTheMessagesAlone) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    const Timeline::Options options{.has_music = round % 2 == 0, .max_transition_frames = 150};
    Timeline eager(options), lazy(options), deaf(options);  // deaf: learns of turns at the end
    const auto turn = round % 5 < 2 ? &Turn : nullptr;
    std::vector<std::function<void(Timeline&)>> log;
    std::vector<Span> asked_often;
    int64_t granted = 0;
    for (int message = 0; message < 30; ++message) {
      const int kind = static_cast<int>(random() % 4);
      const int64_t frame = static_cast<int64_t>(random() % 900);
      const std::string id(1, static_cast<char>('a' + random() % 6));
      if (round % 3 == 0 && message == 0) granted = 1;
      const auto send = [=](Timeline& timeline) {
        try {
          if (message == 0 && round % 3 == 0) timeline.GenerateUntil(1);
          if (kind < 2) Set(timeline, id, AtFrame{frame});
          if (kind == 2) timeline.Remove(id, "");
          if (kind == 3 && round % 3 == 0) timeline.GenerateUntil(granted + frame / 8);
        } catch (const Error&) {
        }
      };
      log.push_back(send);
      send(eager);
      send(lazy);
      send(deaf);
      deaf.Planned();
      if (kind == 3 && round % 3 == 0) granted += frame / 8;
      const std::vector<Span> now = Drain(eager, 1000, turn);
      asked_often.insert(asked_often.end(), now.begin(), now.end());
    }
    for (Timeline* timeline : {&eager, &lazy, &deaf}) {
      timeline->Complete();
      timeline->SetAudioEnd(500);
    }
    const std::vector<Span> rest = Drain(eager, 1000, turn);
    asked_often.insert(asked_often.end(), rest.begin(), rest.end());
    EXPECT_EQ(Drain(lazy, 1000, turn), asked_often) << "round " << round;
    EXPECT_EQ(Drain(deaf, 1000, turn), asked_often) << "round " << round;
    // The plan is always seamless.
    int64_t at = 0;
    for (const Span& span : asked_often) {
      EXPECT_EQ(span.from, at);
      EXPECT_GT(span.to, span.from);
      EXPECT_LE(span.to - span.from, 150);
      at = span.to;
    }
    // A resume from the end of any transition plans the same later ones.
    for (size_t i = 1; i < asked_often.size(); ++i) {
      Timeline::Options later = options;
      later.first_frame = asked_often[i].from;
      Timeline resumed(later);
      for (const auto& send : log) send(resumed);
      resumed.Complete();
      resumed.SetAudioEnd(500);
      EXPECT_EQ(Drain(resumed, 1000, turn),
                std::vector<Span>(asked_often.begin() + static_cast<int64_t>(i), asked_often.end()))
          << "round " << round << ", from " << later.first_frame;
    }
  }
}

}  // namespace choreo::timeline_test
