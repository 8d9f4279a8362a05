#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "client/authoring/keys/dance_keys.h"
#include "client/authoring/keys/key_file.h"
#include "client/authoring/keys/photo_pose.h"
#include "client/authoring/keys/proposed_keys.h"
#include "client/authoring/project/project_file.h"
#include "client/convert.h"
#include "model/audio/music/made_song.h"
#include "model/motion/kinematics/kinematics.h"
#include "proto/wire/control_messages.h"
#include "studio/project_dance.h"
#include "tests/studio/opened_studio.h"
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
  ProjectFile* read = request.mutable_read();
  read->mutable_file()->set_name("p.json");
  read->mutable_file()->set_data(
      R"({"studio": 1, "keyframes": [],
          "dancers": [{"id": "ada", "place": [0, 0], "keyframes": "none", "seed": 7},
          {"id": "ben", "place": [1, 0], "keyframes": "keys/ben.json", "after": "2 counts"},
          {"id": "cy", "place": [2, 0], "keyframes": [{"id": "dab", "time": 1, "pose": "dab"}]},
          {"place": [3, 0], "mirrored": true, "facing": 90}]})");
  EXPECT_THAT(page.Ask(request).failure().message(),
              HasSubstr("ben.json: has keys of ben: open it together with the project"));
  File* keys = read->add_key_files();
  keys->set_name("ben.json");
  keys->set_data(R"({"keyframes": [{"id": "kick", "time": 2, "pose": "kick", "hands": "fist"}]})");
  const Response answer = page.Ask(request);
  ASSERT_TRUE(answer.has_project()) << answer.failure().message();
  const auto& dancers = answer.project().dancers();
  EXPECT_TRUE(dancers[0].has_keys() && dancers[0].keys().empty());
  EXPECT_EQ(dancers[0].seed(), 7U);
  ASSERT_EQ(dancers[1].keys_size(), 1);
  EXPECT_EQ(dancers[1].keys(0).key().id(), "kick");
  EXPECT_EQ(dancers[1].keys(0).key().hands(), v1::HAND_POSE_FIST);
  EXPECT_EQ(std::tuple(dancers[1].after(), dancers[1].in_counts()), std::tuple(2.0, true));
  ASSERT_EQ(dancers[2].keys_size(), 1);
  EXPECT_EQ(dancers[2].keys(0).key().frame(), 30);
  EXPECT_EQ(std::tuple(dancers[3].id(), dancers[3].x(), dancers[3].facing()),
            std::tuple("dancer4", 3.0, 90.0));
  EXPECT_TRUE(dancers[3].mirrored() && !dancers[3].has_seed() && !dancers[3].has_keys());
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
  Project* project = company->mutable_project();
  project->set_apart(0.5);
  project->add_dancers()->set_id("ada");
  StageDancer* second = project->add_dancers();
  second->set_id("ben");
  second->set_x(0.1);
  second->set_mirrored(true);
  second->set_facing(90);
  second->set_after(2);
  second->set_in_counts(true);

  page.Say(2, DanceRequest(90, 1));
  *company->add_dances()->mutable_frames() = ReadDance(page);
  company->mutable_dances(0)->set_frame_rate(30);
  company->mutable_dance_of()->Resize(2, 0);
  for (const double beat : {0.5, 1.0, 1.5, 2.0}) company->add_beats(beat);
  company->set_name("all.npz");
  Response answer = page.Ask(request);
  ASSERT_TRUE(answer.has_formation()) << answer.failure().message();
  EXPECT_GT(answer.formation().widened(), 1);
  EXPECT_NEAR(answer.formation().least(), 0.5, 0.002);
  ASSERT_EQ(answer.formation().files_size(), 2);
  EXPECT_EQ(answer.formation().files(0).name(), "all.ada.npz");
  EXPECT_EQ(answer.formation().files(1).name(), "all.ben.npz");
  company->set_name("all.glb");
  answer = page.Ask(request);
  ASSERT_EQ(answer.formation().files_size(), 1) << answer.failure().message();
  EXPECT_EQ(answer.formation().files(0).data().substr(0, 4), "glTF");

  company->clear_beats();
  EXPECT_THAT(page.Ask(request).failure().message(),
              HasSubstr("project:dancers[1].after: 2c: counts need music"));
  company->mutable_dance_of()->Set(1, 3);
  EXPECT_THAT(page.Ask(request).failure().message(), HasSubstr("3 is none of the dances"));
  second->set_x(2000);
  EXPECT_THAT(page.Ask(request).failure().message(), HasSubstr("project:dancers[1].place[0]"));
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
  Request dance = DanceRequest(40, 1);
  AddKey(page.welcome().poses(2), 30, dance.mutable_dance()->mutable_project());
  page.Say(2, dance);
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

// Three numbers for each frame are two more than 2^32.
TEST_F(StudioTest, FindsTheFaultsOfAClip) {
  const Opened studio(server_.address());
  Page page(studio.port());
  Request check;
  Clip* clip = check.mutable_check();
  clip->set_frame_rate(30);
  std::vector<Pose> poses(120, StandingPose(Skeleton::Smpl24()));
  *clip->mutable_frames() = wire::ToProto(0, poses, {});
  Response answer = page.Ask(check);
  ASSERT_TRUE(answer.has_faults()) << answer.failure().message();
  EXPECT_EQ(answer.faults().faults_size(), 0);
  for (size_t frame = 30; frame < 90; ++frame) poses[frame].root_position.y() += 0.5;
  *clip->mutable_frames() = wire::ToProto(0, poses, {});
  answer = page.Ask(check);
  ASSERT_EQ(answer.faults().faults_size(), 1);
  const Fault& fault = answer.faults().faults(0);
  EXPECT_EQ(fault.first_frame(), 30);
  EXPECT_EQ(fault.last_frame(), 89);
  EXPECT_EQ(fault.kind(), "floating");
  EXPECT_EQ(fault.text(), "the body floats 50 cm above the floor");
  clip->mutable_frames()->set_count(121);
  EXPECT_THAT(page.Ask(check).failure().message(), HasSubstr("must be 363"));
}

TEST_F(StudioTest, RefusesAClipOfFarTooManyFrames) {
  const Opened studio(server_.address());
  Page page(studio.port());
  Request write;
  write.mutable_export_()->set_name("dance.npz");
  Clip* clip = write.mutable_export_()->mutable_clip();
  clip->set_frame_rate(30);
  clip->mutable_frames()->set_count(1431655766);
  clip->mutable_frames()->mutable_root_positions()->Resize(2, 0);
  EXPECT_THAT(page.Ask(write).failure().message(),
              HasSubstr("clip.frames.root_positions: 2 numbers, must be 4294967298"));
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
  EXPECT_THAT(clip.clip().notes(0), HasSubstr("read as z up, not y"));
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

  for (const char* bad : {"", "[]", "{", "[1]", "\xff"}) {
    request.mutable_landmarks()->set_data(bad);
    EXPECT_THAT(page.Ask(request).failure().message(), HasSubstr("beach.jpg")) << bad;
  }
}

TEST_F(StudioTest, DescribesJointAxes) {
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
}

TEST_F(StudioTest, ReadsKeyFiles) {
  const Opened studio(server_.address());
  Page page(studio.port());
  const Skeleton& skeleton = studio.context().model().skeleton;
  const std::string text =
      R"({"keyframes": [{"time": 2, "joints": {"left_elbow": 60}}, {"time": 1, "pose": "kick", "hold": 0.1}]})";
  Request request;
  ProjectFile* read = request.mutable_read();
  read->mutable_file()->set_name("mine.json");
  read->mutable_file()->set_data(text);
  const Response answer = page.Ask(request);
  ASSERT_TRUE(answer.has_project()) << answer.failure().message();
  const std::vector<client::KeyPose> keys = authoring::ParseKeyFile(text, "mine.json", skeleton);
  ASSERT_EQ(answer.project().keys_size(), 2);  // in order of time
  const ProjectKey& kick = answer.project().keys(0);
  EXPECT_EQ(std::tuple(kick.key().id(), kick.key().frame(), kick.hold()),
            std::tuple("key2", 30, 3));
  EXPECT_EQ(kick.key().pose().SerializeAsString(),
            client::ToProto(keys[1]).pose().SerializeAsString());
  EXPECT_EQ(answer.project().keys(1).key().mask().joints_size(), 1);

  // Times in counts are those of the page's beats.
  read->mutable_file()->set_data(R"({"keyframes": [{"time": "3c", "pose": "kick"}]})");
  EXPECT_THAT(page.Ask(request).failure().message(), HasSubstr("time: 3c: counts need music"));
  for (const double beat : {0.5, 1.0, 1.5, 2.0}) read->add_beats(beat);
  read->add_ones(1);
  EXPECT_EQ(page.Ask(request).project().keys(0).key().frame(), 60);
  const auto refusal = [&](const std::string& keyframes) {
    read->mutable_file()->set_data(keyframes);
    return page.Ask(request).failure().message();
  };
  for (const char* bad : {"", "[]", "{", R"({"keyframes": [{}]})", "\xff"})
    EXPECT_THAT(refusal(bad), HasSubstr("mine.json")) << bad;
  EXPECT_THAT(refusal(R"({"keyframes": [{"time": 4000, "pose": "kick"}]})"),
              HasSubstr("mine.json:keyframes[0].time: 4000 s is beyond 3600 s"));
  EXPECT_THAT(
      refusal(R"({"keyframes": [{"time": 1, "pose": "kick"}, {"time": 1, "pose": "dab"}]})"),
      HasSubstr("keyframes[1].time: key \"key2\" stands closer than 2 frames to \"key1\""));
  EXPECT_THAT(
      refusal(R"({"keyframes": [{"time": 1, "pose": "star_jump", "place": [0, 0], "hold": 2}]})"),
      HasSubstr("keyframes[0].hold: key \"key1\": the body is"));
}

/// A key with floats of many digits.
ProjectKey OddKey(const LibraryPose& pose, int64_t frame) {
  ProjectKey key;
  key.mutable_key()->set_id(pose.id());
  key.mutable_key()->set_frame(frame);
  *key.mutable_key()->mutable_pose() = pose.pose();
  v1::Pose* odd = key.mutable_key()->mutable_pose();
  odd->mutable_root_position()->set_x(std::sqrt(2) / 3);
  for (int i = 0; i < odd->rotations_size(); ++i)
    odd->set_rotations(i, odd->rotations(i) + 0.1F * std::sin(static_cast<float>(1 + i)));
  return key;
}

Project OddProject(const Welcome& welcome) {
  Project project;
  project.set_seconds(std::sqrt(10));
  project.set_seed(7);
  project.set_music_dynamics(1 / 3.0);
  project.set_variation(0);
  project.mutable_beats()->set_bar(3);
  for (const double count : {6, 1, 2}) {
    project.mutable_beats()->add_times(std::sqrt(1 + count));
    project.mutable_beats()->add_counts(static_cast<uint32_t>(count));
  }
  std::ranges::sort(*project.mutable_beats()->mutable_times());
  v1::Controls& controls = *project.mutable_controls();
  for (const float factor : {1.0F, 0.1F, 1 / 3.0F, 2.0F, 10.0F})
    controls.mutable_velocity_factors()->add_factors(factor);
  for (int part = 0; part < kBodyParts; ++part) {
    controls.mutable_velocity_factors()->add_parts(
        static_cast<v1::BodyPart>(v1::BODY_PART_TRUNK + part));
  }
  for (const int64_t frame : {0, 47}) {
    controls.mutable_root_path()->add_frames(frame);
    controls.mutable_root_path()->add_points(static_cast<float>(frame) / 7);
    controls.mutable_root_path()->add_points(-0.0F);
  }
  Marker* marker = project.add_markers();
  marker->set_frame(11);
  marker->set_name("the \"drop\", 1");
  *project.add_keys() = OddKey(welcome.poses(1), 31);
  project.mutable_keys(0)->set_hold(13);
  project.mutable_keys(0)->mutable_key()->set_hit(2.5);
  project.mutable_keys(0)->mutable_key()->set_hands(v1::HAND_POSE_FIST);
  *project.add_keys() = OddKey(welcome.poses(2), 71);
  for (const uint32_t joint : {0, 5})
    project.mutable_keys(1)->mutable_key()->mutable_mask()->add_joints(joint);
  project.set_apart(0.3);
  for (const double x : {0.0, -1.4}) {
    StageDancer* dancer = project.add_dancers();
    dancer->set_id(x == 0 ? "ada" : "ben");
    dancer->set_x(x);
    if (x == 0) continue;
    dancer->set_after(-x);
    dancer->set_in_counts(true);
    dancer->set_has_keys(true);
    *dancer->add_keys() = OddKey(welcome.poses(2), 50);
  }
  return project;
}

// Whatever a project says comes back to the last bit.
TEST_F(StudioTest, AProjectIsReadAsItWasWritten) {
  const TestServer walker(std::make_unique<ControlledSampler>());
  const Opened studio(walker.address());
  Page page(studio.port());
  Request write;
  *write.mutable_write() = OddProject(page.welcome());
  const Response file = page.Ask(write);
  ASSERT_TRUE(file.has_file()) << file.failure().message();
  for (const char* line :
       {"\n  {\"time\": 0.36667, \"name\": \"the \\\"drop\\\", 1\"}\n",
        "\"bar\": 3,\n \"beats\": [\n", "\"factors\": [1, 0.1, 0.33333334, 2, 10]",
        "\"hands\": \"fist\"", "\"after\": \"1.4 counts\"", "\"place\": [-1.4, 0]", "\"seed\": 7"})
    EXPECT_THAT(file.file().data(), HasSubstr(line));
  Request read;
  *read.mutable_read()->mutable_file() = file.file();
  const Response again = page.Ask(read);
  ASSERT_TRUE(again.has_project()) << again.failure().message();
  EXPECT_EQ(again.project().DebugString(), write.write().DebugString());

  // The page's numbers are doubles.
  read.mutable_read()->mutable_file()->set_data(
      R"({"studio": 1, "seed": 9007199254740993, "keyframes": []})");
  EXPECT_THAT(page.Ask(read).failure().message(), HasSubstr("project:seed: 9007199254740993"));

  // What the page has not checked is refused before it becomes a file.
  Project* project = write.mutable_write();
  project->mutable_beats()->set_counts(1, 17);
  EXPECT_THAT(page.Ask(write).failure().message(), HasSubstr("project:beats[1]: "));
  project->clear_beats();
  project->set_music_dynamics(1.5);
  EXPECT_THAT(page.Ask(write).failure().message(), HasSubstr("project:music_dynamics: 1.5"));
}

// As the command line reads it, whose keys go to the server as these messages.
TEST_F(StudioTest, TheCommandLineReadsTheFloatsThatThePageDances) {
  const TestServer walker(std::make_unique<ControlledSampler>());
  const Opened studio(walker.address());
  Page page(studio.port());
  Request write;
  *write.mutable_write() = OddProject(page.welcome());
  const Response file = page.Ask(write);
  ASSERT_TRUE(file.has_file()) << file.failure().message();
  WriteFile(folder_ / "p.json", file.file().data());
  const client::ModelDescription& model = studio.context().model();
  const authoring::Project read = authoring::ReadProject(folder_ / "p.json");
  const auto controls = read.controls.Read(model, studio.context().server());
  EXPECT_EQ(wire::ToProto(controls).DebugString(), write.write().controls().DebugString());
  const auto keys = authoring::ReadDanceKeys({folder_ / "p.json"}, {95, model.fps}, model.skeleton);
  ASSERT_EQ(keys.poses.size(), 4U);  // two of them hold the first one
  for (const auto& [nth, said] : {std::pair(0, 0), {3, 1}}) {
    v1::Keyframe key = client::ToProto(keys.poses[static_cast<size_t>(nth)]);
    key.set_frame(authoring::FrameOf(keys.poses[static_cast<size_t>(nth)], model.fps));
    EXPECT_EQ(key.DebugString(), write.write().keys(said).key().DebugString());
  }
  const ProjectDance danced = DanceOf(studio.context(), write.write(), nullptr);
  EXPECT_EQ(wire::ToProto(danced.config.controls).DebugString(),
            wire::ToProto(controls).DebugString());
  ASSERT_EQ(danced.keys.poses.size(), keys.poses.size());
  for (size_t i = 0; i < keys.poses.size(); ++i)
    EXPECT_EQ(client::ToProto(danced.keys.poses[i]).DebugString(),
              client::ToProto(keys.poses[i]).DebugString());
}

// Also if it is never written.
TEST_F(StudioTest, AProjectOfThePageIsCheckedWhenItIsDanced) {
  const Opened studio(server_.address());
  Page page(studio.port());
  const auto refused = [&](const auto& change, const std::string& message) {
    Request request = DanceRequest(90, 1);
    Project* project = request.mutable_dance()->mutable_project();
    *project->add_keys() = OddKey(page.welcome().poses(1), 31);
    *project->add_keys() = OddKey(page.welcome().poses(2), 71);
    change(project);
    EXPECT_THAT(page.Ask(request).failure().message(), HasSubstr(message));
  };
  refused([](Project* project) { project->set_variation(1.5); },
          "project:variation: 1.5 is not in [0, 1]");
  refused([](Project* project) { project->set_seconds(0); },
          "project:seconds: 0 is not above 0 and up to 3600");
  refused([](Project* project) { project->mutable_beats()->set_bar(17); },
          "project:bar: 17 is not a whole number from 1 to 16");
  refused(
      [](Project* project) {
        project->mutable_beats()->set_bar(4);
        project->mutable_beats()->add_times(1);
      },
      "project:beats: and their counts are not equally many");
  refused([](Project* project) { project->add_markers(); }, "project:markers[0].name: is empty");
  refused([](Project* project) { project->mutable_keys(0)->set_hold(2000); },
          "project:keyframes[0].hold: 66.6667 s, must be 0.1 to 60");
  refused(
      [](Project* project) {
        project->mutable_keys(1)->mutable_key()->set_id(project->keys(0).key().id());
      },
      "project:keyframes[1].id: ");
  refused([](Project* project) { project->mutable_keys(1)->mutable_key()->set_frame(99); },
          "project:keyframes[1].time: ");
  refused(
      [](Project* project) {
        project->mutable_keys(1)->mutable_key()->mutable_pose()->set_rotations(3, 7);
      },
      "project:keyframes[1].rotations[");
}

}  // namespace choreo::studio::files_test
