#include "model/draw/video.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

#include "model/motion/kinematics/kinematics.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace choreo::video_test {

const Skeleton& kSmpl = Skeleton::Smpl24();
constexpr int kRate = 44100;

bool HaveFfmpeg() { return std::system("ffmpeg -version >/dev/null 2>&1") == 0; }

// ffmpeg's output for a file: arguments after the input, raw bytes out.
std::string Decode(const std::filesystem::path& file, const std::string& arguments) {
  const std::string out = file.string() + ".raw";
  std::string quoted = file.string();
  EXPECT_EQ(quoted.find('\''), std::string::npos);
  const std::string command =
      "ffmpeg -loglevel error -y -i 'file:" + quoted + "' " + arguments + " 'file:" + out + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::ifstream raw(out, std::ios::binary);
  return {std::istreambuf_iterator<char>(raw), {}};
}

// A mono song of silence with one click, whose loudest sample is at `click_s`.
void WriteClick(const std::filesystem::path& path, double seconds, double click_s) {
  std::vector<int16_t> samples(static_cast<size_t>(seconds * kRate));
  const auto click = static_cast<int64_t>(std::llround(click_s * kRate));
  for (int64_t i = -200; i <= 200; ++i) {
    const double t = static_cast<double>(i);
    samples[static_cast<size_t>(click + i)] =
        static_cast<int16_t>(30000 * std::exp(-t * t / 2000) * std::cos(0.3 * t));
  }
  std::ofstream file(path, std::ios::binary);
  const auto number = [&](uint32_t value, int bytes) {
    file.write(reinterpret_cast<const char*>(&value), bytes);
  };
  const auto size = static_cast<uint32_t>(2 * samples.size());
  file << "RIFF";
  number(36 + size, 4);
  file << "WAVEfmt ";
  number(16, 4), number(1, 2), number(1, 2), number(kRate, 4), number(2 * kRate, 4), number(2, 2),
      number(16, 2);
  file << "data";
  number(size, 4);
  file.write(reinterpret_cast<const char*>(samples.data()), size);
}

// Stands still, and raises both arms from one frame on.
Motion Cheer(int frames, int from) {
  Motion motion{.fps = 30,
                .frames = std::vector<Pose>(static_cast<size_t>(frames), RestPose(kSmpl))};
  for (int frame = from; frame < frames; ++frame) {
    Pose& pose = motion.frames[static_cast<size_t>(frame)];
    pose.rotations.col(kSmpl.left_shoulder) << 0, 0, 1.3;
    pose.rotations.col(kSmpl.right_shoulder) << 0, 0, -1.3;
  }
  return motion;
}

VideoOptions Small(const std::filesystem::path& song = {}) {
  VideoOptions options;
  options.format.width = 96;
  options.format.height = 64;
  options.format.song = song;
  return options;
}

TEST(VideoViews, FollowSmoothlyFromOneSide) {
  Motion motion{.fps = 30, .frames = std::vector<Pose>(120, RestPose(kSmpl))};
  for (size_t frame = 60; frame < 120; ++frame) motion.frames[frame].root_position.x() += 1;
  const std::vector<View> views = VideoViews({{kSmpl, motion}}, 16.0 / 9);
  ASSERT_EQ(views.size(), 120u);
  EXPECT_NEAR(views.front().target.x(), 0, 0.01);
  EXPECT_NEAR(views.back().target.x(), 1, 0.01);
  for (size_t frame = 1; frame < views.size(); ++frame) {
    const double step = views[frame].target.x() - views[frame - 1].target.x();
    EXPECT_GE(step, 0);
    EXPECT_LT(step, 0.03);  // a metre in about two seconds
    EXPECT_EQ(views[frame].azimuth, views[0].azimuth);
    EXPECT_EQ(views[frame].extent, views[0].extent);
  }
}

class VideoKinds : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(All, VideoKinds, testing::ValuesIn(kVideoExtensions),
                         [](const auto& kind) { return std::string(kind.param + 1); });

TEST_P(VideoKinds, PictureAndSongBeginTogetherAndEndTogether) {
  if (!HaveFfmpeg()) GTEST_SKIP() << "no ffmpeg here (scripts/install_packages.sh video)";
  const TemporaryFolder folder;
  // A name that would confuse a shell, or ffmpeg's own syntax.
  const std::filesystem::path song = folder / "-y concat:a|b; $(false) \"#%d.wav";
  constexpr int kFrames = 40, kMove = 20;
  WriteClick(song, 5, kMove / 30.0);
  const std::filesystem::path video = folder / (std::string("out") + GetParam());
  int64_t drawn = 0;
  VideoOptions options = Small(song);
  options.on_frame = [&](int64_t frames) {
    EXPECT_EQ(frames, kFrames);
    ++drawn;
  };
  DrawVideo({{kSmpl, Cheer(kFrames, kMove)}}, options, video);
  EXPECT_EQ(drawn, kFrames);
  EXPECT_FALSE(std::filesystem::exists(video.string() + ".partial"));

  const std::string frames = Decode(video, "-map 0:v -f rawvideo -pix_fmt gray");
  constexpr size_t kPixels = 96 * 64;
  ASSERT_EQ(frames.size(), kFrames * kPixels);
  const auto changed = [&](int frame) {
    int64_t sum = 0;
    for (size_t i = 0; i < kPixels; ++i) {
      const auto now = static_cast<uint8_t>(frames[frame * kPixels + i]);
      const auto before = static_cast<uint8_t>(frames[(frame - 1) * kPixels + i]);
      sum += std::abs(int{now} - int{before});
    }
    return sum;
  };
  int most = 1;
  for (int frame = 1; frame < kFrames; ++frame)
    if (changed(frame) > changed(most)) most = frame;
  EXPECT_EQ(most, kMove);

  const std::string audio = Decode(video, "-map 0:a -ac 1 -ar 44100 -f s16le");
  std::vector<int16_t> samples(audio.size() / 2);
  std::memcpy(samples.data(), audio.data(), 2 * samples.size());
  const auto loudest = std::max_element(samples.begin(), samples.end(), [](int16_t a, int16_t b) {
    return std::abs(int{a}) < std::abs(int{b});
  });
  EXPECT_NEAR(static_cast<double>(loudest - samples.begin()) / kRate, kMove / 30.0, 0.002);
  // AAC comes in blocks of 1024 samples, Opus of 960.
  EXPECT_NEAR(static_cast<double>(samples.size()) / kRate, kFrames / 30.0, 0.05);
}

TEST_P(VideoKinds, TheSameDanceGivesTheSameBytes) {
  if (!HaveFfmpeg()) GTEST_SKIP() << "no ffmpeg here (scripts/install_packages.sh video)";
  const TemporaryFolder folder;
  const auto bytes = [&](const std::string& name) {
    VideoOptions options = Small();
    options.keys = {0.1};
    DrawVideo({{kSmpl, Cheer(8, 4)}}, options, folder / name);
    std::ifstream file(folder / name, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(file), {}};
  };
  const std::string first = bytes(std::string("a") + GetParam());
  EXPECT_GT(first.size(), 1000u);
  EXPECT_EQ(first, bytes(std::string("b") + GetParam()));
}

TEST(Video, AKeyShowsOnlyAtTheEdge) {
  if (!HaveFfmpeg()) GTEST_SKIP() << "no ffmpeg here (scripts/install_packages.sh video)";
  const TemporaryFolder folder;
  // The mean brightness of one frame's inner half, and of its upper edge.
  const auto brightness = [&](const std::vector<double>& keys) {
    VideoOptions options = Small();
    options.keys = keys;
    DrawVideo({{kSmpl, Cheer(8, 8)}}, options, folder / "a.mp4");
    const std::string frames = Decode(folder / "a.mp4", "-map 0:v -f rawvideo -pix_fmt gray");
    const auto mean = [&](int top, int bottom, int left, int right) {
      double sum = 0;
      for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x)
          sum += static_cast<uint8_t>(frames[static_cast<size_t>((4 * 64 + y) * 96 + x)]);
      return sum / ((bottom - top) * (right - left));
    };
    return std::pair(mean(16, 48, 24, 72), mean(0, 1, 0, 96));
  };
  const auto plain = brightness({}), key = brightness({4 / 30.0});
  EXPECT_NEAR(key.first, plain.first, 1);
  EXPECT_LT(key.second, plain.second - 30);
}

TEST(Video, FailsWithFfmpegsMessageAndLeavesNoFile) {
  if (!HaveFfmpeg()) GTEST_SKIP() << "no ffmpeg here (scripts/install_packages.sh video)";
  const TemporaryFolder folder;
  std::ofstream(folder / "noise.wav") << "no music";
  ExpectError(ErrorCode::kInternal, "out.mp4: ffmpeg: ", [&] {
    DrawVideo({{kSmpl, Cheer(60, 4)}}, Small(folder / "noise.wav"), folder / "out.mp4");
  });
  ExpectError(ErrorCode::kInternal, "No such file or directory", [&] {
    DrawVideo({{kSmpl, Cheer(3, 1)}}, Small(), "/absent/out.mp4");
  });
  VideoOptions broken = Small();
  broken.on_frame = [](int64_t) { throw Error(ErrorCode::kCancelled, "", "enough"); };
  ExpectError(ErrorCode::kCancelled, "enough", [&] {
    DrawVideo({{kSmpl, Cheer(60, 4)}}, broken, folder / "out.mp4");
  });
  EXPECT_FALSE(std::filesystem::exists(folder / "out.mp4"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out.mp4.partial"));
}

TEST(Video, NamesAMissingFfmpeg) {
  const TemporaryFolder folder;
  const std::string path = std::getenv("PATH");
  setenv("PATH", (folder / "nothing").c_str(), 1);
  ExpectError(ErrorCode::kNotFound, "ffmpeg: is not installed", [&] {
    DrawVideo({{kSmpl, Cheer(3, 1)}}, Small(), folder / "out.mp4");
  });
  setenv("PATH", path.c_str(), 1);
}

TEST(Video, RefusesWhatItCannotMake) {
  const auto refuse = [&](const std::string& part, const VideoOptions& options,
                          const Motion& motion) {
    ExpectError(ErrorCode::kInvalidArgument, part, [&] {
      DrawVideo({{kSmpl, motion}}, options, "out.mp4");
    });
  };
  VideoOptions options = Small();
  refuse("motion.frames: 0 frames", options, Motion{});
  options.format.width = 97;
  refuse("video.width: 97, must be an even number", options, Cheer(2, 1));
  options.format.width = 9000;
  refuse("video.width: 9000, must be 16 to 8192", options, Cheer(2, 1));
  options = Small();
  options.format.fps = 500;
  refuse("video.fps: 500, must be 1 to 120", options, Cheer(2, 1));
}

}  // namespace choreo::video_test
