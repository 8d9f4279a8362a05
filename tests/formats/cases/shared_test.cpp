// Files that users' programs wrote or might have. Skipped where they are absent: CHOREO_CASES names
// their folder (default: ../shared/cases beside the repository).
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/formats/cases/cases.h"
#include "tests/support/expect_error.h"

namespace choreo::shared_test {

class SharedCases : public testing::Test {
 protected:
  void SetUp() override {
    const char* named = std::getenv("CHOREO_CASES");
    folder_ = named ? std::filesystem::path(named)
                    : std::filesystem::path(CHOREO_TEST_DATA) / "../../../shared/cases";
    folder_ /= "motion";
    if (!std::filesystem::exists(folder_))
      GTEST_SKIP() << folder_ << " is absent (CHOREO_CASES names it)";
  }

  cases_test::Read Read(const std::string& name, MotionReading reading = {}) const {
    cases_test::Read read;
    reading.notes = &read.notes;
    read.motion = ReadMotion(folder_ / name, Skeleton::Smpl24(), OtherSkeleton::kRetarget, reading);
    return read;
  }

  std::filesystem::path folder_;
};

TEST_F(SharedCases, RigsMoveAsTheFirstDoes) {
  const Motion base = Read("base.bvh").motion;
  struct Row {
    const char* file;
    const char* says = "";
  };
  for (const Row& row : std::vector<Row>{{"frames_less.bvh", "says 29 frames"},
                                         {"frames_nospace.bvh"},
                                         {"endsite1.bvh"},
                                         {"n_deepmotion.bvh"},
                                         {"n_ipi.bvh"},
                                         {"n_blendermeta.bvh"},
                                         {"n_mmd.bvh"},
                                         {"draco.glb"}}) {
    SCOPED_TRACE(row.file);
    const cases_test::Read read = Read(row.file);
    EXPECT_LT(cases_test::WorstJoint(base, read.motion), 0.02);
    EXPECT_TRUE(std::string(row.says).empty() || read.Says(row.says)) << Said(read);
  }
  EXPECT_EQ(Read("ft0_one.bvh").motion.frames.size(), 1U);
  EXPECT_EQ(Read("cubic.glb").motion.frames.size(), 31U);
  ExpectError(ErrorCode::kInvalidArgument, "compressed by EXT_meshopt_compression",
              [&] { Read("meshopt_fallback.glb"); });
}

TEST_F(SharedCases, PelvesAgreeWithTheArrays) {
  struct Row {
    const char* file;
    Eigen::Vector3d pelvis;  ///< of frame 10
  };
  const Eigen::Vector3d smpl(0.52, 1.18, 0.22), edge(0.53, 1.15, 0);
  for (const Row& row : std::vector<Row>{{"split.npz", smpl},
                                         {"smplxpy.npz", smpl},
                                         {"nofps.npz", smpl},
                                         {"fps_key.npz", smpl},
                                         {"edge.pkl", edge},
                                         {"edge_mat.npz", edge}}) {
    const Motion motion = Read(row.file).motion;
    ASSERT_GT(motion.frames.size(), 10U) << row.file;
    EXPECT_LT((motion.frames[10].root_position - row.pelvis).norm(), 0.011)
        << row.file << ": " << motion.frames[10].root_position.transpose();
  }
  EXPECT_EQ(Read("nofps.npz", {.fps = 50}).motion.fps, 50);
  EXPECT_GT(Read("gBR_sBM_cAll_d04_mBR0_ch01.pkl").motion.frames.size(), 10U);
}

}  // namespace choreo::shared_test
