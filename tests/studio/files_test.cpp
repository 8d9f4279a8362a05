#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "client/authoring/key_file.h"
#include "client/authoring/photo_pose.h"
#include "client/authoring/proposed_keys.h"
#include "client/convert.h"
#include "model/audio/made_song.h"
#include "tests/studio/fixture.h"
#include "tests/support/expect_error.h"
#include "tests/support/music_files.h"
#include "tests/support/rig_files.h"

namespace choreo::studio::files_test {

using ::testing::HasSubstr;

TEST_F(StudioTest, AnalysesASongAndComposesOnItsBeats) {
  const Opened studio(server_.address());
  Page page(studio.port());
  const Response heard = page.Ask(SongRequest("clicks.wav", Clicks(12)));
  ASSERT_TRUE(heard.has_song()) << heard.failure().message();
  EXPECT_NEAR(heard.song().tempo(), 120, 3);
  // As `choreo analyze` proposes keys.
  const auto proposed =
      authoring::ProposeKeys(authoring::ReadMusic(folder_ / "clicks.wav"), {.count = 5});
  ASSERT_EQ(heard.song().suggested_size(), 5);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(heard.song().suggested(i).time(), proposed[static_cast<size_t>(i)].on.time_s);
    EXPECT_EQ(heard.song().suggested(i).pose(), proposed[static_cast<size_t>(i)].pose);
  }
  EXPECT_EQ(heard.song().peaks_size(), 480);
  EXPECT_EQ(heard.song().counts_size(), heard.song().beats_size());
  EXPECT_GE(heard.song().beats_in_bar(), 2);
  EXPECT_THAT(heard.song().counts(), testing::Contains(1));
  Request compose;
  compose.mutable_compose()->set_seconds(12);
  const Response keys = page.Ask(compose);
  EXPECT_GE(keys.keyframes().keyframes_size(), 5);
  compose.mutable_compose()->add_beats(1.1);
  compose.mutable_compose()->add_beats(5.1);
  const Response few = page.Ask(compose);
  ASSERT_GE(few.keyframes().keyframes_size(), 2) << few.failure().message();
  // After the last of them they go on as before.
  for (int i = 1; i < few.keyframes().keyframes_size(); ++i)
    EXPECT_NEAR(std::fmod(few.keyframes().keyframes(i).time(), 4), 1.1, 0.02);
}

TEST_F(StudioTest, DancersHaveKeysOfTheirOwn) {
  const Opened studio(server_.address());
  Page page(studio.port());
  Request request;
  Company* company = request.mutable_company();
  company->mutable_dancers()->set_name("p.json");
  company->mutable_dancers()->set_data(
      R"({"dancers": [{"id": "ada", "place": [0, 0], "keyframes": "none"},
          {"id": "ben", "place": [1, 0], "keyframes": "keys/ben.json"},
          {"id": "cy", "place": [2, 0], "keyframes": [{"id": "dab", "time": 1, "pose": "dab"}]},
          {"id": "dee", "place": [3, 0]}]})");
  EXPECT_THAT(page.Ask(request).failure().message(),
              HasSubstr("ben.json: has keys of ben: open it together with the project"));
  File* keys = company->add_key_files();
  keys->set_name("ben.json");
  keys->set_data(R"({"keyframes": [{"id": "kick", "time": 2, "pose": "kick", "hands": "fist"}]})");
  const Response answer = page.Ask(request);
  ASSERT_TRUE(answer.has_formation()) << answer.failure().message();
  const auto& dancers = answer.formation().dancers();
  EXPECT_TRUE(dancers[0].has_keys() && dancers[0].keys().empty());
  ASSERT_EQ(dancers[1].keys_size(), 1);
  EXPECT_EQ(dancers[1].keys(0).id(), "kick");
  EXPECT_EQ(dancers[1].keys(0).hands(), v1::HAND_POSE_FIST);
  ASSERT_EQ(dancers[2].keys_size(), 1);
  EXPECT_EQ(dancers[2].keys(0).time(), 1);
  EXPECT_FALSE(dancers[3].has_keys());
  keys->set_data(R"({"keyframes": [{"time": 2, "pose": "kik"}]})");
  EXPECT_THAT(page.Ask(request).failure().message(),
              testing::StartsWith("ben.json:keyframes[0].pose: "));
}

// As `choreo dance --dancers` places them.
TEST_F(StudioTest, ArrangesSeveralDancers) {
  const Opened studio(server_.address());
  Page page(studio.port());
  Request request;
  Company* company = request.mutable_company();
  company->mutable_dancers()->set_name("p.json");
  company->mutable_dancers()->set_data(
      R"({"apart": 0.5, "dancers": [{"id": "ada", "place": [0, 0], "seed": 7},
          {"place": [0.1, 0], "mirrored": true, "facing": 90, "after": "2 counts"}]})");
  // Without dances they are read.
  Response answer = page.Ask(request);
  ASSERT_TRUE(answer.has_formation()) << answer.failure().message();
  ASSERT_EQ(answer.formation().dancers_size(), 2);
  EXPECT_EQ(answer.formation().dancers(0).seed(), 7U);
  const StageDancer& second = answer.formation().dancers(1);
  EXPECT_EQ(second.id(), "dancer2");
  EXPECT_EQ(std::tuple(second.x(), second.facing(), second.mirrored(), second.after()),
            std::tuple(0.1, 90.0, true, 2.0));
  EXPECT_TRUE(second.in_counts() && !second.has_seed() && !second.has_keys());

  page.Say(2, DanceRequest(90, 1));
  page.Say(2, Complete());
  *company->add_dances()->mutable_frames() = ReadDance(page);
  company->mutable_dances(0)->set_frame_rate(30);
  company->mutable_dance_of()->Resize(2, 0);
  for (const double beat : {0.5, 1.0, 1.5, 2.0}) company->add_beats(beat);
  company->set_name("all.npz");
  answer = page.Ask(request);
  ASSERT_TRUE(answer.has_formation()) << answer.failure().message();
  EXPECT_GT(answer.formation().widened(), 1);
  EXPECT_NEAR(answer.formation().least(), 0.5, 0.002);
  ASSERT_EQ(answer.formation().files_size(), 2);
  EXPECT_EQ(answer.formation().files(0).name(), "all.ada.npz");
  EXPECT_EQ(answer.formation().files(1).name(), "all.dancer2.npz");
  company->set_name("all.glb");
  answer = page.Ask(request);
  ASSERT_EQ(answer.formation().files_size(), 1) << answer.failure().message();
  EXPECT_EQ(answer.formation().files(0).data().substr(0, 4), "glTF");

  company->clear_beats();
  EXPECT_THAT(page.Ask(request).failure().message(),
              HasSubstr("p.json:dancers[1].after: 2c: counts need music"));
  company->mutable_dance_of()->Set(1, 3);
  EXPECT_THAT(page.Ask(request).failure().message(), HasSubstr("3 is none of the dances"));
  company->mutable_dancers()->set_data(R"({"dancers": [{"place": [0, 0], "turn": 1}]})");
  EXPECT_THAT(page.Ask(request).failure().message(), HasSubstr("p.json:dancers[0].turn"));
}

// A song whose first part follows its second.
TEST_F(StudioTest, FindsReturningPassages) {
  std::vector<float> samples;
  for (const uint64_t seed : {11, 12, 11}) {
    const std::vector<float> part =
        MakeSong({.seed = seed, .seconds = 24, .tempo = {{0, 120}}}).mono;
    samples.insert(samples.end(), part.begin(), part.end());
  }
  WriteWav(folder_ / "song.wav", samples);
  const Song song = HearSong(folder_ / "song.wav", "song.wav", 600);
  EXPECT_EQ(song.heard.confidence_size(), song.heard.beats_size());
  double again = 0;  // seconds
  for (const v1::MusicPassage& passage : song.heard.passages()) {
    if (std::abs(passage.from() - passage.like() - 48) < 1) again += passage.to() - passage.from();
  }
  EXPECT_GT(again, 16);
}

TEST_F(StudioTest, RefusesASongThatIsLongerThanADance) {
  Clicks(5);
  ExpectError(ErrorCode::kInvalidArgument, "long.wav: is longer than 4 s",
              [&] { HearSong(folder_ / "clicks.wav", "long.wav", 4); });
  EXPECT_NEAR(HearSong(folder_ / "clicks.wav", "long.wav", 5).heard.seconds(), 5, 1e-3);
}

TEST_F(StudioTest, WritesAndOpensFiles) {
  const Opened studio(server_.address());
  Page page(studio.port());
  page.Say(2, DanceRequest(40, 1));
  page.Say(2, KeyRequest(page.welcome().poses(2), 30));
  page.Say(2, Complete());
  const v1::Frames frames = ReadDance(page);
  for (const std::string name : {"dance.npz", "dance.glb", "dance.bvh"}) {
    Request write;
    write.mutable_export_()->set_name(name);
    *write.mutable_export_()->mutable_clip()->mutable_frames() = frames;
    write.mutable_export_()->mutable_clip()->set_frame_rate(30);
    const Response file = page.Ask(write);
    ASSERT_TRUE(file.has_file()) << file.failure().message();
    Request open;
    *open.mutable_open() = file.file();
    const Response clip = page.Ask(open);
    ASSERT_TRUE(clip.has_clip()) << clip.failure().message();
    EXPECT_EQ(clip.clip().frame_rate(), 30);
    ASSERT_EQ(clip.clip().frames().count(), 40) << name;
    for (int i = 0; i < frames.root_positions_size(); ++i)
      EXPECT_NEAR(clip.clip().frames().root_positions(i), frames.root_positions(i), 1e-4) << name;
  }
}

TEST_F(StudioTest, NotesOdditiesOfAFile) {
  const Opened studio(server_.address());
  Page page(studio.port());
  Request open;
  open.mutable_open()->set_name("stage.bvh");
  const Eigen::Matrix3d z_up{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  open.mutable_open()->set_data(BvhText(testing_support::MakeBvh({.world = z_up})));
  const Response clip = page.Ask(open);
  ASSERT_EQ(clip.clip().notes_size(), 1) << clip.failure().message();
  EXPECT_THAT(clip.clip().notes(0), HasSubstr("taken as z up, not y"));
  std::string bytes = Clicks(5);
  for (size_t i = 40; i < 44; ++i) bytes[i] = '\0';  // the length of its samples
  const Response heard = page.Ask(SongRequest("piped.wav", bytes));
  ASSERT_EQ(heard.song().notes_size(), 1) << heard.failure().message();
  EXPECT_THAT(heard.song().notes(0), HasSubstr("its header says 0 bytes of samples"));
  EXPECT_EQ(page.Ask(SongRequest("clicks.wav", Clicks(5))).song().notes_size(), 0);
}

TEST_F(StudioTest, FitsTheBodyToAPhotosLandmarks) {
  const Opened studio(server_.address());
  Page page(studio.port());
  std::string landmarks = "[";
  for (int i = 0; i < 33; ++i) {
    const std::string number = std::to_string(i);
    landmarks += (i ? ",{\"x\":" : "{\"x\":") + std::to_string(0.3 * std::sin(i)) +
                 ",\"y\":" + std::to_string(0.05 * i - 0.8) + ",\"z\":0." + number + "}";
  }
  landmarks += "]";
  Request request;
  request.mutable_landmarks()->set_name("beach.jpg");
  request.mutable_landmarks()->set_data(landmarks);
  const Response seen = page.Ask(request);
  ASSERT_TRUE(seen.has_pose()) << seen.failure().message();
  EXPECT_EQ(seen.pose().id(), "beach");
  const Pose pose =
      authoring::ParseLandmarkPose(landmarks, "beach.jpg", studio.context().model().skeleton);
  EXPECT_EQ(seen.pose().pose().SerializeAsString(), client::ToProto(pose).SerializeAsString());

  // Times in counts are those of the page's beats.
  Request counted;
  counted.mutable_keys()->mutable_file()->set_name("mine.json");
  counted.mutable_keys()->mutable_file()->set_data(
      R"({"keyframes": [{"time": "3c", "pose": "kick"}]})");
  EXPECT_THAT(page.Ask(counted).failure().message(), HasSubstr("time: 3c: counts need music"));
  for (const double beat : {0.5, 1.0, 1.5, 2.0}) counted.mutable_keys()->add_beats(beat);
  counted.mutable_keys()->add_ones(1);
  EXPECT_EQ(page.Ask(counted).keyframes().keyframes(0).time(), 2);
  for (const char* bad : {"", "[]", "{", "[1]", "\xff"}) {
    request.mutable_landmarks()->set_data(bad);
    EXPECT_THAT(page.Ask(request).failure().message(), HasSubstr("beach.jpg")) << bad;
  }
}

TEST_F(StudioTest, DescribesJointAxesAndReadsKeyFiles) {
  const Opened studio(server_.address());
  Page page(studio.port());
  const Skeleton& skeleton = studio.context().model().skeleton;
  ASSERT_EQ(page.welcome().turns_size(), skeleton.joints());
  const JointTurn& elbow = page.welcome().turns(skeleton.Find("left_elbow"));
  EXPECT_EQ(elbow.part(), v1::BODY_PART_LEFT_ARM);
  EXPECT_EQ(elbow.hinge_size(), 3);
  EXPECT_EQ(elbow.low(), 0);
  EXPECT_EQ(elbow.high(), 165);
  EXPECT_EQ(page.welcome().turns(skeleton.Find("head")).part(), v1::BODY_PART_TRUNK);
  EXPECT_EQ(page.welcome().turns(skeleton.Find("head")).hinge_size(), 0);

  const std::string text =
      R"({"keyframes": [{"time": 2, "joints": {"left_elbow": 60}}, {"time": 1, "pose": "kick", "hold": 0.1}]})";
  Request request;
  request.mutable_keys()->mutable_file()->set_name("mine.json");
  request.mutable_keys()->mutable_file()->set_data(text);
  const Response answer = page.Ask(request);
  ASSERT_TRUE(answer.has_keyframes()) << answer.failure().message();
  const std::vector<client::KeyPose> keys = authoring::ParseKeyFile(text, "mine.json", skeleton);
  ASSERT_EQ(answer.keyframes().keyframes_size(), 3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(answer.keyframes().keyframes(i).SerializeAsString(),
              client::ToProto(keys[static_cast<size_t>(i)]).SerializeAsString());
  }
  EXPECT_EQ(answer.keyframes().keyframes(0).mask().joints_size(), 1);
  for (const char* bad : {"", "[]", "{", R"({"keyframes": [{}]})", "\xff"}) {
    request.mutable_keys()->mutable_file()->set_data(bad);
    EXPECT_THAT(page.Ask(request).failure().message(), HasSubstr("mine.json")) << bad;
  }
}

}  // namespace choreo::studio::files_test
