#include "model/training/clips/prepared_clip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/core/error.h"
#include "model/training/clips/clip_split.h"
#include "tests/support/expect_error.h"
#include "tests/support/native_tang2018.h"
#include "tests/support/synthetic_clips.h"
#include "tests/support/temporary_folder.h"

namespace choreo::prepared_clip_test {

using testing::ElementsAre;
using testing_support::Native;
using testing_support::SyntheticClip;
using testing_support::WriteSyntheticData;

std::vector<std::string> Names(const std::vector<PreparedClip>& clips) {
  std::vector<std::string> names;
  for (const PreparedClip& clip : clips) names.push_back(clip.name);
  return names;
}

TEST(PreparedClip, RoundTripsAsFloats) {
  const TemporaryFolder folder;
  PreparedClip clip = SyntheticClip("one", 70, 0.3, true);
  clip.notes["terms"] = "ours";
  WritePreparedClip(folder.path(), clip);
  const PreparedClip back = ReadPreparedClip(folder.path() / "one.clip");
  EXPECT_EQ(back.name, "one");
  EXPECT_EQ(back.source, "synthetic");
  EXPECT_EQ(back.notes.at("terms"), "ours");
  ASSERT_EQ(back.motion.frames.size(), 70U);
  for (size_t f = 0; f < 70; ++f) {
    EXPECT_LT(
        (back.motion.frames[f].rotations - clip.motion.frames[f].rotations).cwiseAbs().maxCoeff(),
        1e-7);
    EXPECT_LT((back.motion.frames[f].root_position - clip.motion.frames[f].root_position).norm(),
              1e-6);
  }
  EXPECT_EQ(back.contacts, clip.contacts);
  EXPECT_EQ(back.audio, clip.audio);
}

TEST(PreparedClip, ContainsItsSkeletonUnlessStandard) {
  const TemporaryFolder folder;
  for (const Skeleton* skeleton : {&Skeleton::Smpl24(), &Native().skeleton}) {
    WritePreparedClip(folder.path(), SyntheticClip("one", 5, 0.3, false, *skeleton));
    EXPECT_EQ(ReadPreparedClip(folder.path() / "one.clip").skeleton, *skeleton);
  }
  PreparedClip torn = SyntheticClip("torn", 5, 0.3, false, Native().skeleton);
  torn.skeleton = Skeleton::Smpl24();
  ExpectError(ErrorCode::kInvalidArgument,
              "torn: 23 joints, but its skeleton is 'smpl24' of 24 joints",
              [&] { WritePreparedClip(folder.path(), torn); });
}

TEST(LoadClips, RefusesClipsOfTwoSkeletonsNamingBoth) {
  const TemporaryFolder folder;
  WriteSyntheticData(folder / "smpl");
  WriteSyntheticData(folder / "native", Native().skeleton);
  ExpectError(ErrorCode::kInvalidArgument, "its skeleton is 'tang2018' of 23 joints, that of", [&] {
    LoadClips({folder / "smpl", folder / "native"}, folder / "smpl" / "splits.json", kTrainGroup);
  });
}

TEST(PreparedClip, AForeignFileIsNamed) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "bad.clip") << "not a clip";
  try {
    ReadPreparedClip(folder.path() / "bad.clip");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("bad.clip"));
  }
  EXPECT_THROW(ListPreparedClips(folder.path() / "nowhere"), Error);
}

TEST(LoadClips, FollowsSplitsAndTrainsOnUnnamedClips) {
  const TemporaryFolder folder;
  WriteSyntheticData(folder.path());
  const auto load = [&](const std::string& group) {
    return Names(LoadClips({folder.path()}, folder.path() / "splits.json", group));
  };
  EXPECT_THAT(load(kTrainGroup),
              ElementsAre("train_0", "train_1", "train_2", "train_3", "train_4"));
  EXPECT_THAT(load(kValidationGroup), ElementsAre("held_out"));
  EXPECT_THAT(load("test"), ElementsAre("last"));
}

TEST(LoadClips, LoadsAnyGroupAndTrainsOnNoneOfThem) {
  const TemporaryFolder folder;
  WriteSyntheticData(folder.path());
  const auto splits = folder.path() / "splits.json";
  std::ofstream(splits) << R"({"synthetic": {"train": ["train_0"], "validation": ["held_out"],
      "test": ["last"], "test_unseen_genre": ["train_1", "train_2"], "unused": ["train_3"]}})";
  const auto load = [&](const std::string& group) {
    return LoadClips({folder.path()}, splits, group);
  };
  EXPECT_THAT(Names(load("test_unseen_genre")), ElementsAre("train_1", "train_2"));
  EXPECT_THAT(Names(load("unused")), ElementsAre("train_3"));
  EXPECT_THAT(Names(load("test")), ElementsAre("last"));
  EXPECT_THAT(Names(load(kTrainGroup)), ElementsAre("train_0", "train_4"));
  for (const char* unknown : {"tset", "", "Test"}) {
    ExpectError(ErrorCode::kInvalidArgument,
                "is in '" + std::string(unknown) +
                    "'; they are in 'test', 'test_unseen_genre', 'train', 'unused', 'validation'",
                [&] { load(unknown); });
  }
}

TEST(LoadClips, RefusesAClipInTrainAndTest) {
  const TemporaryFolder folder;
  WriteSyntheticData(folder.path());
  const auto splits = folder.path() / "splits.json";
  for (const char* group : {kTrainGroup, kValidationGroup}) {
    std::ofstream(splits) << R"({"one": {"train": ["last", "last"]}, "two": {"test": ["last"]}})";
    ExpectError(ErrorCode::kInvalidArgument, "'last' is both in 'train' and in 'test'",
                [&] { LoadClips({folder.path()}, splits, group); });
  }
}

TEST(LoadClips, FolderNamedAsASetIsThatSet) {
  const TemporaryFolder folder;
  WriteSyntheticData(folder / "one");
  const auto splits = folder / "one" / "splits.json";
  std::ofstream(splits) << R"({"one": {"validation": ["last"]}, "two": {"test": ["last"]}})";
  EXPECT_THAT(Names(LoadClips({folder / "one"}, splits, kValidationGroup)), ElementsAre("last"));
}

TEST(LoadClips, NamesTheFaultOfAFolder) {
  const TemporaryFolder folder;
  WriteSyntheticData(folder / "clips");
  std::filesystem::create_directories(folder / "empty");
  const auto splits = folder / "clips" / "splits.json";
  const auto load = [&](const std::filesystem::path& data) {
    LoadClips({data}, splits, kTrainGroup);
  };
  ExpectError(ErrorCode::kNotFound, "nowhere: no such folder", [&] { load(folder / "nowhere"); });
  ExpectError(ErrorCode::kInvalidArgument, "splits.json: not a folder", [&] { load(splits); });
  ExpectError(ErrorCode::kNotFound, "empty: no prepared clips", [&] { load(folder / "empty"); });
}

}  // namespace choreo::prepared_clip_test
