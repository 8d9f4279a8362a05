#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "client/authoring/keys/pose_library.h"
#include "client/edit.h"
#include "tests/client/command_fixture.h"
#include "tests/client/test_music.h"
#include "tests/support/expect_error.h"

namespace choreo::edit_library_test {

using testing::HasSubstr;

const Skeleton& Body() { return Skeleton::Smpl24(); }

/// A motion that stands still.
client::FinishedDance Standing(size_t frames) {
  client::FinishedDance dance;
  dance.motion.frames.assign(frames, RestPose(Body()));
  return dance;
}

// Sends only the music of the new frames, because a song may be longer than a message.
TEST(EditLibraryTest, SendsOnlyMusicAroundTheKey) {
  TestServer server(std::make_unique<HearingSampler>());
  const client::Client client({.addresses = {server.address()}});
  client::EditOptions options;
  options.model = client.GetServerInfo().models.front();
  const client::FinishedDance dance = Standing(7000);
  client::KeyEdit edit;
  edit.key.id = "kick";
  edit.key.frame = 6000;
  edit.key.pose = authoring::FindLibraryPose("kick").pose;
  edit.from = 5950;
  edit.to = 6050;
  const client::FinishedDance silent = SetKey(client, dance, options, edit).dance;
  options.audio = ClicksAudio(220);  // 18.5 MiB
  const client::FinishedDance heard = SetKey(client, dance, options, edit).dance;
  EXPECT_NE(heard.motion.frames[5980].rotations, silent.motion.frames[5980].rotations);
  EXPECT_EQ(heard.motion.frames[6050].rotations, silent.motion.frames[6050].rotations);

  // After the song's end there is silence.
  edit.key.frame = 6900;
  edit.from = 6850;
  edit.to = 6950;
  EXPECT_EQ(SetKey(client, dance, options, edit).keys.size(), 1U);
}

TEST(EditLibraryTest, WarnsOfTheKneeThatBendsFurthestBackwards) {
  TestServer server;
  const client::Client client({.addresses = {server.address()}});
  client::EditOptions options;
  options.model = client.GetServerInfo().models.front();
  client::FinishedDance dance = Standing(100);
  EXPECT_TRUE(CloseLoop(client, dance, options, 40).warnings.empty());
  // A loop into a broken first frame, which is not a new one: the way there is.
  dance.motion.frames[0].rotations(0, Body().left_knee) = -0.6;
  const auto warnings = CloseLoop(client, dance, options, 40).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0].message, testing::MatchesRegex("left_knee bends [0-9.]+ degrees "
                                                         "backwards at frame [0-9]+; 15 look "
                                                         "broken"));
  EXPECT_GT(warnings[0].frame, 80);
  EXPECT_LT(warnings[0].frame, 100);
}

TEST(EditLibraryTest, RefusesInvalidIntervals) {
  TestServer server;
  const client::Client client({.addresses = {server.address()}});
  client::EditOptions options;
  options.model = client.GetServerInfo().models.front();
  const client::FinishedDance dance = Standing(100);
  const auto refused = [&](int64_t frame, int64_t from, int64_t to, const char* part) {
    client::KeyEdit edit;
    edit.key.frame = frame;
    edit.key.pose = RestPose(Body());
    edit.from = from;
    edit.to = to;
    ExpectError(ErrorCode::kInvalidArgument, part, [&] { SetKey(client, dance, options, edit); });
  };
  refused(100, 90, 110, "key.frame: 100 is not in the dance, [0, 99]");
  refused(50, 49, 60, "from: 49");
  refused(50, -1, 60, "from: -1");
  refused(0, 0, 60, "from: 0 with a key at frame 0: must be -1");
  refused(50, 40, 51, "to: 51");
  refused(50, 40, 100, "to: 100");
  ExpectError(ErrorCode::kInvalidArgument, "from: 99 is not in [0, 98]",
              [&] { CloseLoop(client, dance, options, 99); });
  options.audio.format.kind = client::AudioKind::kFile;
  refused(50, 40, 60, "audio: is a file");
}

}  // namespace choreo::edit_library_test
