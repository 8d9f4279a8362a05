#include "model/papers/tables/study_dances.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "model/core/files/atomic_file.h"
#include "tests/support/expect_error.h"
#include "tests/support/fake_sampler.h"
#include "tests/support/music_files.h"
#include "tests/support/synthetic_clips.h"
#include "tests/support/temporary_folder.h"

namespace choreo::study_dances_test {

using testing::ElementsAre;
using testing::Field;
using testing_support::SyntheticClip;

constexpr int kFrames = 30;

class StudyDances : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("ffmpeg -version >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no ffmpeg";
  }
  std::vector<StudyMethod> Film(const std::filesystem::path& songs = {}) {
    const std::vector<Method> methods = {{"real", Method::Kind::kReal},
                                         {"interpolation", Method::Kind::kInterpolation},
                                         {"model, fake", Method::Kind::kModel, &sampler_}};
    return FilmDances(set_, methods, kFrames, songs, folder_ / "films");
  }

  TemporaryFolder folder_;
  FakeSampler sampler_;
  ClipSet set_{"set", {SyntheticClip("one", 200, 0.1, true)}};
};

TEST_F(StudyDances, EachMethodHasAFilmOfEachClip) {
  set_.clips.push_back(SyntheticClip("two", 230, 0.9, true));
  const std::vector<StudyMethod> films = Film();
  EXPECT_THAT(films, ElementsAre(Field(&StudyMethod::name, "real"),
                                 Field(&StudyMethod::name, "model, fake")));
  for (const StudyMethod& method : films) {
    EXPECT_TRUE(std::filesystem::exists(method.folder / "one.mp4")) << method.name;
    EXPECT_TRUE(std::filesystem::exists(method.folder / "two.mp4")) << method.name;
  }
  EXPECT_NE(ReadFile(films[0].folder / "one.mp4"), ReadFile(films[1].folder / "one.mp4"));
}

TEST_F(StudyDances, SongStartsWithTheDance) {
  set_.clips.front().notes["preparation"] = R"({"music_start_s": 2})";
  WriteWav(folder_ / "one.wav", Music(12));
  const auto film = Film(folder_.path()).front().folder / "one.mp4";
  const std::string raw = (folder_ / "sound").string();
  ASSERT_EQ(std::system(("ffmpeg -loglevel error -y -i '" + film.string() +
                         "' -ar 22050 -ac 1 -f s16le '" + raw + "'")
                            .c_str()),
            0);
  const std::string bytes = ReadFile(raw);
  const auto sample = [&](size_t i) {
    return static_cast<int16_t>(static_cast<uint8_t>(bytes[2 * i]) |
                                static_cast<uint8_t>(bytes[2 * i + 1]) << 8);
  };
  // Half a second of a tone that rises by 120 Hz a second.
  int crossings = 0;
  for (size_t i = kMusicRate / 4; i < 3 * kMusicRate / 4; ++i)
    crossings += sample(i) < 0 && sample(i + 1) >= 0;
  const double starts_s = 2 + (10 + (200 - 10 - kFrames) / 2) / 30.0;
  EXPECT_NEAR(2 * crossings, 200 + 120 * (starts_s + 0.5), 20);
}

TEST_F(StudyDances, AClipWithoutItsSongIsNamed) {
  ExpectError(ErrorCode::kNotFound, "no one.ogg, .wav or .mp3 in", [&] { Film(folder_.path()); });
}

}  // namespace choreo::study_dances_test
