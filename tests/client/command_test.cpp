#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "client/authoring/keys/key_file.h"
#include "client/authoring/keys/pose_library.h"
#include "model/core/files/atomic_file.h"
#include "model/core/files/npy.h"
#include "model/formats/motion_file.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/client/command_fixture.h"
#include "tests/client/test_music.h"

namespace choreo::command_test {

using testing::HasSubstr;

const Skeleton& Body() { return Skeleton::Smpl24(); }

TEST_F(CommandTest, MovesFromPoseToPose) {
  const Outcome outcome =
      Choreo("transition --from contrapposto --to kick --frames 40 --candidates 2 --out " +
             At("t.npz") + " --hands fist --report " + At("t.json") + Server());
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const auto report = nlohmann::json::parse(std::ifstream(folder_ / "t.json"));
  EXPECT_EQ(report["keyframes"][0]["hands"], "fist");
  for (const char* name : {"t.npz", "t.2.npz"}) {
    const Motion motion = ReadMotion(folder_ / name, Body());
    ASSERT_EQ(motion.frames.size(), 40U);
    EXPECT_LE(ComparePoses(Body(), motion.frames.back(), authoring::FindLibraryPose("kick").pose)
                  .position_m,
              0.001);
  }
}

TEST_F(CommandTest, RanksAlternativesByLikelihoodOnRequest) {
  const auto move = [&](const std::string& by, int seed) {
    return Choreo(
        "transition --from contrapposto --to kick --frames 40 --temperature 1 "
        "--candidates 8 --out " +
        At("t.npz") + " --report " + At("best.json") + " --rank-by " + by + " --seed " +
        std::to_string(seed) + Server());
  };
  const auto best = [&](const std::string& by, int seed) {
    const Outcome outcome = move(by, seed);
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    return nlohmann::json::parse(std::ifstream(folder_ / "best.json"))
        .at("log_likelihood")
        .get<double>();
  };
  // The candidate of the best quality is sometimes also the likeliest.
  int likelier = 0;
  for (int seed = 0; seed < 4; ++seed) {
    const double by_likelihood = best("likelihood", seed), by_quality = best("quality", seed);
    EXPECT_GE(by_likelihood, by_quality);
    likelier += by_likelihood > by_quality;
  }
  EXPECT_GT(likelier, 0);
  EXPECT_EQ(move("luck", 0).code, 2);
}

// Sends only the music of the frames, because a song may be longer than a message.
TEST_F(CommandTest, TransitionReceivesItsPartOfALongSong) {
  WriteClicks(folder_ / "song.wav", 200);  // 16.8 MiB of samples
  const auto move = [&](const std::string& name, const std::string& more) {
    const Outcome outcome = Choreo("transition --from groove --to kick --frames 30 --at 195 -o " +
                                   At(name) + more + Server());
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    return ReadMotion(folder_ / name, Body()).frames[15].rotations.eval();
  };
  std::string silence = ReadFile(folder_ / "song.wav");
  std::fill(silence.begin() + 44, silence.end(), '\0');  // after its header
  WriteFile(folder_ / "silence.wav", silence);
  EXPECT_NE(move("heard.npz", " --song " + At("song.wav")),
            move("silent.npz", " --song " + At("silence.wav")));
}

TEST_F(CommandTest, AnalyzesASong) {
  WriteClicks(folder_ / "song.wav", 8);
  const Outcome outcome = Choreo("analyze " + At("song.wav") + " --json --features " + At("f.npy"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const nlohmann::json heard = nlohmann::json::parse(outcome.said);
  EXPECT_NEAR(heard["duration_s"], 8, 1e-3);
  EXPECT_EQ(heard["sample_rate"], 22050);
  EXPECT_NEAR(heard["tempo_bpm"], 120, 5);
  ASSERT_GT(heard["beats"].size(), 8U);
  for (const double beat : heard["beats"]) EXPECT_NEAR(std::remainder(beat, 0.5), 0, 0.07);
  EXPECT_EQ(ReadNpy(folder_ / "f.npy").shape, (std::vector<int64_t>{241, 40}));
  // Only a part of the song, as for one that is too long.
  const nlohmann::json part = nlohmann::json::parse(
      Choreo("analyze " + At("song.wav") + " --json --song-start 3.25 --seconds 4").said);
  EXPECT_NEAR(part["duration_s"], 4, 1e-3);
  EXPECT_LT(part["beats"].back().get<double>(), 4);
  for (const double beat : part["beats"]) EXPECT_NEAR(std::remainder(beat - 0.25, 0.5), 0, 0.07);
  EXPECT_THAT(Choreo("analyze " + At("song.wav") + " --seconds 0").said,
              HasSubstr("--seconds: 0 is not a number above 0"));
  EXPECT_THAT(Choreo("analyze " + At("song.wav") + " --song-start 9").said,
              HasSubstr("--song-start: 9 s is after the end"));
  EXPECT_THAT(Choreo("analyze " + At("song.wav") + " --downbeat -1").said,
              HasSubstr("--downbeat: -1 is not a number of seconds from 0 on"));
  WriteFile(folder_ / "beat.txt", "1\n");
  const std::string one = Choreo("analyze " + At("song.wav") + " --beats " + At("beat.txt")).said;
  EXPECT_THAT(one, HasSubstr("1 channel; 1 beat, 1 bar of 4"));
  EXPECT_THAT(one, HasSubstr(" s no beat given here\n"));
  WriteFile(folder_ / "beat.txt", "");
  EXPECT_THAT(Choreo("analyze " + At("song.wav") + " --beats " + At("beat.txt")).said,
              HasSubstr("beat.txt is empty, but for comments"));
  WriteFile(folder_ / "nothing.wav", "");
  EXPECT_THAT(Choreo("analyze " + At("nothing.wav")).said, HasSubstr("nothing.wav: is empty"));
  WriteFile(folder_ / "d.npz", "a dance");
  EXPECT_THAT(Choreo("dance " + At("d.npz") + " --seconds 4").said,
              HasSubstr("d.npz is a motion, not a song; choreo edit changes it"));
}

TEST_F(CommandTest, SuggestsBeatsForKeyPoses) {
  WriteClicks(folder_ / "song.wav", 12);
  const std::string analyze = "analyze " + At("song.wav") + " --suggest-keys ";
  const Outcome outcome = Choreo(analyze + "4 --json");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const nlohmann::json heard = nlohmann::json::parse(outcome.said);
  const nlohmann::json& keys = heard["suggested_keys"];
  ASSERT_EQ(keys.size(), 4U);
  for (size_t i = 0; i < keys.size(); ++i) {
    EXPECT_EQ(keys[i]["time_s"], heard["beats"].at(keys[i]["beat"].get<size_t>()));
    EXPECT_GT(keys[i]["strength"], 0);
    EXPECT_LE(keys[i]["strength"], 1);
    if (i > 0) {
      EXPECT_GE(keys[i]["time_s"].get<double>() - keys[i - 1]["time_s"].get<double>(), 1.2);
    }
  }
  const std::string help = Choreo("analyze --help").said;
  for (const auto& item : heard.items()) EXPECT_THAT(help, HasSubstr(item.key()));
  const Outcome text = Choreo(analyze + "4");
  EXPECT_THAT(text.said, HasSubstr(" Hz, 1 channel; "));
  EXPECT_THAT(Choreo("analyze --seconds 0.6 " + At("song.wav")).said, HasSubstr(" 1 bar of 4, "));
  EXPECT_EQ(text.code, 0);
  EXPECT_EQ(std::count(text.said.begin(), text.said.end(), '\n'), 7) << text.said;
  char line[32];
  std::snprintf(line, sizeof line, "%.3f s  count %d", keys[2]["time_s"].get<double>(),
                keys[2]["count"].get<int>());
  EXPECT_THAT(text.said, HasSubstr(line));

  // The output is a key file with poses of the library.
  WriteFile(folder_ / "keys.json", outcome.said);
  const auto proposed = authoring::ReadKeys(folder_ / "keys.json", Body());
  ASSERT_EQ(proposed.size(), 4U);
  std::set<std::string> poses;
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(proposed[i].time_s, keys[i]["time_s"]);
    poses.insert(heard["keyframes"][i]["pose"]);
  }
  EXPECT_EQ(poses.size(), 4U);
  EXPECT_NE(nlohmann::json::parse(Choreo(analyze + "4 --json --seed 5").said)["keyframes"],
            heard["keyframes"]);

  const Outcome many = Choreo(analyze + "500");
  EXPECT_EQ(many.code, 1);
  EXPECT_THAT(many.said, HasSubstr("--suggest-keys: 500 keys, must be 1 to "));
  for (const std::string count : {"0", "-1", "2.5", "some"}) {
    const Outcome bad = Choreo(analyze + count);
    EXPECT_EQ(bad.code, 2) << bad.said;
    EXPECT_THAT(bad.said,
                HasSubstr("--suggest-keys: " + count + " is not a whole number from 1 to 1000000"));
  }
  EXPECT_THAT(Choreo(analyze + "2 --from 7 --until 3").said,
              HasSubstr("--from: 7 s is not before --until, 3 s"));
  EXPECT_THAT(Choreo(analyze + "2 --from 7.1234567 --until 3").said,
              HasSubstr("--from: 7.12 s is not before --until, 3 s"));
  EXPECT_THAT(Choreo(analyze + "2 --from 12.5").said,
              HasSubstr("--from: 12.5 s is after the song's end at 12 s"));
  // Counts the beats of the whole song between two moments.
  const nlohmann::json part =
      nlohmann::json::parse(Choreo(analyze + "2 --from 3 --until 7 --json").said)["suggested_keys"];
  ASSERT_EQ(part.size(), 2U);
  for (const nlohmann::json& key : part) {
    EXPECT_GE(key["time_s"].get<double>(), 3);
    EXPECT_LE(key["time_s"].get<double>(), 7);
    EXPECT_EQ(key["time_s"], heard["beats"][key["beat"].get<size_t>()]);
  }
}

TEST_F(CommandTest, SuggestsKeysWithinTheSecondsOfADance) {
  WriteClicks(folder_ / "song.wav", 20);
  const std::string suggest = "analyze " + At("song.wav") + " --seconds 6 --suggest-keys ";
  const nlohmann::json heard = nlohmann::json::parse(Choreo(suggest + "3 --json").said);
  EXPECT_LT(heard["beats"].back().get<double>(), 6);
  for (const nlohmann::json& key : heard["keyframes"]) EXPECT_LE(key["time"].get<double>(), 6);
  EXPECT_THAT(Choreo(suggest + "9").said, HasSubstr("--suggest-keys: 9 keys, must be 1 to "));
  EXPECT_THAT(Choreo(suggest + "1 --from 7").said,
              HasSubstr("--from: 7 s is not before --seconds, 6 s"));
}

TEST_F(CommandTest, ConvertsAndDraws) {
  const Motion motion{.fps = 30,
                      .frames = std::vector<Pose>(31, authoring::FindLibraryPose("groove").pose)};
  WriteMotion(folder_ / "a.bvh", Body(), motion);
  ASSERT_EQ(Choreo("convert " + At("a.bvh") + " " + At("b.npz") + " --fps 60").code, 0);
  const Motion converted = ReadMotion(folder_ / "b.npz", Body());
  EXPECT_EQ(converted.fps, 60);
  ASSERT_EQ(converted.frames.size(), 61U);
  EXPECT_LT(ComparePoses(Body(), converted.frames[30], motion.frames[0]).position_m, 1e-4);

  ASSERT_EQ(Choreo("render " + At("b.npz") + " --frames 4 --columns 2 --out " + At("s.png")).code,
            0);
  std::ifstream png(folder_ / "s.png", std::ios::binary);
  std::string magic(4, '\0');
  png.read(magic.data(), 4);
  EXPECT_EQ(magic, "\x89PNG");
}

TEST_F(CommandTest, RendersFromTheSideThatIsAskedFor) {
  WriteMotion(folder_ / "a.npz", Body(), {.fps = 30, .frames = {2, RestPose(Body())}});
  const auto render = [&](const std::string& rest) {
    return Choreo("render " + At("a.npz") + rest + " --frames 1 --out " + At("s.png"));
  };
  std::set<std::string> sheets;
  for (const char* camera : {"", " --camera front", " --camera side", " --camera back"}) {
    EXPECT_EQ(render(camera).code, 0) << camera;
    sheets.insert(ReadFile(folder_ / "s.png"));
  }
  EXPECT_EQ(sheets.size(), 4U);
  EXPECT_EQ(render(" --camera three-quarter").code, 0);
  EXPECT_TRUE(sheets.contains(ReadFile(folder_ / "s.png")));
  EXPECT_THAT(render(" --camera above").said,
              HasSubstr("--camera: above not in {front,three-quarter,side,back,follow}"));
  EXPECT_THAT(render(" --camera fron").said,
              HasSubstr("--camera: fron is not known; did you mean front?"));
  EXPECT_THAT(render(" --song songg.ogg").said,
              HasSubstr("--song: songg.ogg is not an existing file; none stands for no song"));
  EXPECT_THAT(render(" " + At("a.npz") + " --camera follow").said,
              HasSubstr("--camera: follow turns with one dancer, and there are 2"));
}

TEST_F(CommandTest, ConvertsBetweenAllFormats) {
  Motion motion{.fps = 25, .frames = {}};
  for (int frame = 0; frame < 20; ++frame) {
    Pose& pose = motion.frames.emplace_back(authoring::FindLibraryPose("kick").pose);
    pose.root_position.x() += 0.02 * frame;
    pose.rotations.col(16) *= 1 - 0.03 * frame;
  }
  for (const std::string from : {"npz", "bvh", "glb"}) {
    WriteMotion(folder_ / ("a." + from), Body(), motion);
    for (const std::string to : {"npz", "bvh", "glb"}) {
      SCOPED_TRACE(from + " to " + to);
      const Outcome outcome = Choreo("convert " + At("a." + from) + " " + At("b." + to));
      ASSERT_EQ(outcome.code, 0) << outcome.said;
      const Motion back = ReadMotion(folder_ / ("b." + to), Body());
      EXPECT_EQ(back.fps, 25);
      ASSERT_EQ(back.frames.size(), motion.frames.size());
      for (size_t i = 0; i < motion.frames.size(); ++i) {
        const PoseError error = ComparePoses(Body(), motion.frames[i], back.frames[i]);
        EXPECT_LT(error.position_m, 1e-5);
        EXPECT_LT(error.angle_deg, 1e-3);
      }
      // Another rate gives the same moments.
      ASSERT_EQ(Choreo("convert " + At("a." + from) + " " + At("c." + to) + " --fps 50").code, 0);
      const Motion dense = ReadMotion(folder_ / ("c." + to), Body());
      EXPECT_EQ(dense.fps, 50);
      ASSERT_EQ(dense.frames.size(), 39U);
      EXPECT_LT(ComparePoses(Body(), motion.frames[19], dense.frames[38]).position_m, 1e-5);
    }
  }
}

TEST_F(CommandTest, RendersAVideoWithItsSong) {
  if (std::system("ffprobe -version >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "no ffmpeg here (scripts/install_packages.sh video)";
  WriteClicks(folder_ / "song.wav", 4);
  WriteMotion(
      folder_ / "a.npz", Body(),
      {.fps = 60, .frames = std::vector<Pose>(61, authoring::FindLibraryPose("groove").pose)});
  const auto render = [&](const std::string& video) {
    return Choreo("render " + At("a.npz") + " --video " + At(video) + " --song " + At("song.wav") +
                  " --fps 15 --size 64x48");
  };
  for (const auto& [video, picture, sound] :
       {std::tuple("a.mp4", "h264", "aac"), {"a.webm", "vp9", "opus"}}) {
    const Outcome outcome = render(video);
    ASSERT_EQ(outcome.code, 0) << outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr("rendering 100 % 16/16"));
    const std::string said = Shell(
                                 "ffprobe -v error -count_frames -of csv -show_entries "
                                 "stream=codec_name,width,height,nb_read_frames " +
                                 At(video))
                                 .said;
    EXPECT_THAT(said, HasSubstr("stream," + std::string(picture) + ",64,48,16"));
    EXPECT_THAT(said, HasSubstr("stream," + std::string(sound)));
  }
  EXPECT_THAT(render("a.avi").said, HasSubstr("a.avi does not end in .mp4 or .webm"));
}

TEST_F(CommandTest, RendersAPartAsIfItWereTheWhole) {
  if (std::system("ffmpeg -version >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "no ffmpeg here (scripts/install_packages.sh video)";
  WriteClicks(folder_ / "song.wav", 4);
  Motion whole{.fps = 30, .frames = std::vector<Pose>(61, RestPose(Body()))};
  for (size_t frame = 0; frame < whole.frames.size(); ++frame)
    whole.frames[frame].rotations(2, 16) = -0.02 * static_cast<double>(frame);
  WriteMotion(folder_ / "whole.npz", Body(), whole);
  const Motion part{.fps = 30, .frames = {whole.frames.begin() + 15, whole.frames.begin() + 45}};
  WriteMotion(folder_ / "part.npz", Body(), part);
  const std::string reported = R"({"fps": 30, "song": "song.wav", "song_start": )";
  const std::string beats =
      R"(, "music_beats": [0.25, 0.5, 1], "music_downbeats": [0.25], "keyframes": [)";
  std::ofstream(folder_ / "whole.json")
      << reported << 1 << beats << R"({"id": "a", "frame": 10}, {"id": "b", "frame": 30}]})";
  std::ofstream(folder_ / "part.json")
      << reported << 1.5 << beats << R"({"id": "b", "frame": 15}]})";
  const auto drawn = [&](const std::string& name, const std::string& options) {
    const Outcome outcome = Choreo("render " + At(name + ".npz") + " --report " +
                                   At(name + ".json") + " --title x --fps 15 --size 64x48 --out " +
                                   At("a.png") + " --video " + At("a.mp4") + options);
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    return Shell("ffmpeg -v error -i " + At("a.mp4") + " -map 0 -f md5 -").said;
  };
  const std::string expected = drawn("part", "");
  const std::string sheet = ReadFile(folder_ / "a.png");
  EXPECT_EQ(drawn("whole", " --from 0.5 --until 1.5"), expected);
  EXPECT_NE(ReadFile(folder_ / "a.png"), sheet) << "it has the times of the whole";
  EXPECT_EQ(drawn("whole", " --from 2c --until 1.5"), expected) << "a count of the report's beats";
  EXPECT_NE(drawn("whole", ""), expected);
  const auto refused = [&](const std::string& options) {
    return Choreo("render " + At("whole.npz") + " --out " + At("a.png") + options).said;
  };
  EXPECT_THAT(refused(" --from 3"), HasSubstr("--from: nothing is left to draw: the motion ends"));
  EXPECT_THAT(refused(" --from 1.5 --until 0.5"),
              HasSubstr("--from: 1.5 s is not before --until, 0.5 s"));
  EXPECT_THAT(refused(" --until 0"), HasSubstr("--until: nothing is left to draw"));
  EXPECT_THAT(refused(" --from 9c"), HasSubstr("--from: 9c: counts need music that has beats"));
}

TEST_F(CommandTest, RendersAVideoWithTheSongOfItsReport) {
  if (std::system("ffmpeg -version >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "no ffmpeg here (scripts/install_packages.sh video)";
  WriteClicks(folder_ / "song.wav", 4);
  WriteMotion(folder_ / "a.npz", Body(),
              {.fps = 30, .frames = std::vector<Pose>(31, RestPose(Body()))});
  std::ofstream(folder_ / "r.json")
      << R"({"fps": 30, "keyframes": [], "song": "song.wav", "song_start": 1.3})";
  // What the film says and its sound.
  const auto film = [&](const std::string& options) {
    const Outcome outcome = Choreo("render " + At("a.npz") + " --fps 15 --size 64x48 --video " +
                                   At("a.mp4") + " " + options);
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    const Outcome sound = Shell("ffmpeg -v error -i " + At("a.mp4") + " -map 0:a -f md5 -");
    return std::pair(outcome.said, sound.code == 0 ? sound.said : "silence");
  };
  const std::string report = "--report " + At("r.json");
  const std::string song = " --song " + At("song.wav");
  const auto [said, later] = film(song + " --song-start 1.3");
  const auto [plain, whole] = film(song);
  EXPECT_NE(later, whole);
  EXPECT_THAT(plain, testing::Not(HasSubstr("note:")));

  const auto [noted, heard] = film(report);
  EXPECT_EQ(heard, later);
  EXPECT_THAT(noted, HasSubstr("note: as " + (folder_ / "r.json").string() + " says: song " +
                               (folder_ / "song.wav").string() + " from 1.3 s\n"));
  const auto [named, with_song] = film(report + song);
  EXPECT_EQ(with_song, later);
  EXPECT_THAT(named, HasSubstr(" from 1.3 s\n"));
  EXPECT_EQ(film(report + song + " --song-start 0").second, whole);
  EXPECT_EQ(film(report + " --song none").second, "silence");
  std::filesystem::rename(folder_ / "song.wav", folder_ / "other.wav");
  EXPECT_EQ(film(report + " --song " + At("other.wav")).second, whole) << "another song";
  const auto [absent, silent] = film(report);
  EXPECT_EQ(silent, "silence");
  EXPECT_THAT(absent, HasSubstr("does not exist; without --song the film is silent"));
}

TEST_F(CommandTest, DescribesTheServerAndItsPoses) {
  const nlohmann::json info = nlohmann::json::parse(Choreo("info --json" + Server()).said);
  EXPECT_EQ(info["models"][0]["name"], "fake");
  EXPECT_EQ(info["models"][0]["skeleton"]["joints"].size(), 24U);
  const std::string plain = Choreo("info" + Server()).said;
  EXPECT_THAT(plain, HasSubstr("fingerprint fake-1"));
  EXPECT_LE(std::ranges::count(plain, '\n'), 24) << "more than a screen";
  const std::string card = "\n  name: fake\n";
  EXPECT_THAT(plain, testing::Not(HasSubstr(card)));
  EXPECT_THAT(Choreo("info --cards" + Server()).said, HasSubstr(card));
  EXPECT_THAT(Choreo("info --poses").said, HasSubstr("arabesque"));
  const nlohmann::json poses = nlohmann::json::parse(Choreo("info --poses --json").said);
  EXPECT_TRUE(std::ranges::any_of(poses, [](const nlohmann::json& pose) {
    return pose.at("id") == "arabesque" && pose.at("description") != "";
  }));
}

TEST_F(CommandTest, FailsWithOneLineAndCodeOne) {
  WriteClicks(folder_ / "song.wav", 4);
  std::ofstream(folder_ / "bad.json") << R"({"keyframes": [{"time": 1}]})";
  std::ofstream(folder_ / "noise.wav") << "no music";
  const auto expect_failure = [](const std::string& arguments, const std::string& part) {
    const Outcome outcome = Choreo(arguments);
    EXPECT_EQ(outcome.code, 1) << arguments;
    EXPECT_THAT(outcome.said, testing::StartsWith("choreo: "));
    EXPECT_THAT(outcome.said, HasSubstr(part));
    EXPECT_EQ(std::count(outcome.said.begin(), outcome.said.end(), '\n'), 1) << outcome.said;
  };
  expect_failure("dance " + At("song.wav") + Server() + "-k " + At("bad.json"),
                 "keyframes[0].rotations: is missing");
  expect_failure("dance " + At("song.wav") + Server() + "--model swan", "\"swan\", but fake");
  expect_failure("dance " + At("song.wav") + Server() + "--out x.mp4", "must be .npz, .bvh, .glb");
  expect_failure("dance " + At("song.wav") + Server() + "--out /absent/x.npz", "no folder /absent");
  expect_failure("dance " + At("song.wav") + Server() + "--temperature 9",
                 "choreo: --temperature: 9 is not in [0, 2]");
  expect_failure("dance " + At("song.wav") + Server() + "--style odd",
                 "choreo: --style: \"odd\" is not a style of");
  expect_failure("dance " + At("noise.wav") + Server(), "noise.wav");
  expect_failure("transition --from swan --to kick --out " + At("t.npz") + Server(),
                 "swan: is not a pose of the library");
  expect_failure("convert " + At("song.wav") + " " + At("b.npz"),
                 "song.wav: has the extension '.wav', must be .npz, .bvh, .glb");
  WriteMotion(folder_ / "a.npz", Body(), {.fps = 30, .frames = {RestPose(Body())}});
  expect_failure("convert " + At("a.npz") + " " + At("b.fbx"),
                 "b.fbx: has the extension '.fbx', must be .npz, .bvh, .glb or .vrma; Blender "
                 "exports FBX from these");
  expect_failure("render " + At("a.npz"), "--out: is missing, and so is --video");
  expect_failure("render " + At("a.npz") + " --out x.png --song " + At("song.wav"),
                 "--song: pictures have no sound");
  expect_failure("render " + At("a.npz") + " --video x.mp4 --size 12", "--size: 12, must be WIDTH");
  expect_failure("info --deadline 0.3 --server 127.0.0.1:1", "127.0.0.1:1");
}

// A choreod that is ready at once.
TEST_F(CommandTest, KeepsAServerForOthers) {
  std::filesystem::copy(CHOREO_PROGRAM, folder_ / "choreo");
  std::filesystem::create_symlink(FAKE_CHOREOD, folder_ / "choreod");
  const std::string choreo = At("choreo");
  const Outcome alone = Shell(choreo + " info");
  EXPECT_EQ(alone.code, 0) << alone.said;
  EXPECT_THAT(alone.said, testing::ContainsRegex("note: starting a server .*: choreo serve, and "
                                                 "CHOREO_SERVER=127.0.0.1:50051 for commands\n"));
  const Outcome kept =
      Shell(choreo + " serve --listen 127.0.0.1:0 >" + At("said") + " & until grep -q listens " +
            At("said") + "; do sleep 0.05; done; export CHOREO_SERVER=$(sed 's/.* //' " +
            At("said") + "); " + choreo + " info; kill $!; wait $!; echo left with $?");
  EXPECT_THAT(kept.said, HasSubstr("choreod"));
  EXPECT_THAT(kept.said, HasSubstr("model fake"));
  EXPECT_THAT(kept.said, testing::Not(HasSubstr("note: a server")));
  EXPECT_THAT(kept.said, HasSubstr("left with 0"));
  const Outcome wrong = Shell(choreo + " serve --nonsense");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.said, HasSubstr("choreod: no setting is called \"--nonsense\""));
  std::filesystem::remove(folder_ / "choreod");
  const Outcome absent = Shell(choreo + " serve");
  EXPECT_EQ(absent.code, 1);
  EXPECT_THAT(absent.said, HasSubstr("/choreod: cannot be started: No such file"));
}

TEST_F(CommandTest, ExplainsItself) {
  EXPECT_EQ(Choreo("").code, 2);
  EXPECT_EQ(Choreo("swim").code, 2);
  EXPECT_EQ(Choreo("dance").code, 2);
  EXPECT_EQ(Choreo("dance /absent.ogg").code, 2);
  EXPECT_THAT(Choreo("swim").said, HasSubstr("swim is not a command; there are dance, "));
  EXPECT_THAT(Choreo("danse song.ogg").said,
              HasSubstr("danse is not a command; did you mean dance?"));
  // Options that would change nothing are not ignored silently.
  EXPECT_THAT(Choreo("render /dev/null --out a.png --size 64x64").said,
              HasSubstr("--size requires --video"));
  EXPECT_THAT(Choreo("dance --style ''").said, HasSubstr("--style: is empty"));
  const Outcome misspelt = Choreo("dance --sead 3");
  EXPECT_EQ(misspelt.code, 2);
  EXPECT_THAT(misspelt.said, HasSubstr("--sead is not an option of dance; did you mean --seed?"));
  EXPECT_THAT(Choreo("dance --temperatur 1").said, HasSubstr("did you mean --temperature?"));
  EXPECT_THAT(Choreo("health --temp 1").said, testing::Not(HasSubstr("did you mean")));
  EXPECT_THAT(Choreo("dance --xylophone").said, testing::Not(HasSubstr("did you mean")));
  const Outcome absurd = Choreo("convert /dev/null b.npz --fps 1e9");
  EXPECT_EQ(absurd.code, 2);
  EXPECT_THAT(absurd.said, HasSubstr("--fps: 1e9 is not a number from 1 to 1000"));
  for (const char* command : {"", "dance", "transition", "edit", "analyze", "info", "health",
                              "serve", "convert", "render", "live", "pose", "plot", "studio"}) {
    const Outcome outcome = Choreo(std::string(command) + " --help");
    EXPECT_EQ(outcome.code, 0) << command;
    EXPECT_THAT(outcome.said, HasSubstr("Usage:")) << command;
    std::istringstream lines(outcome.said);
    for (std::string line; std::getline(lines, line);) {
      const size_t excludes = line.find("Excludes: ");
      if (excludes == std::string::npos) continue;
      std::istringstream names(line.substr(excludes + std::string("Excludes: ").size()));
      for (std::string name; names >> name && name.starts_with("-");)
        EXPECT_THAT(outcome.said, testing::ContainsRegex("\n  (-.,)?" + name + "[ ,\n]"))
            << command;
    }
  }
  EXPECT_EQ(Choreo("--version").code, 0);
}

}  // namespace choreo::command_test
