#include "model/core/running/threads.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <thread>

#include "model/core/error.h"

namespace choreo::threads_test {

TEST(ThreadsTest, RefusesTheReferenceBlasAndSuggestsAnother) {
  const BlasInfo reference{BlasInfo::Kind::kReference, "Netlib reference BLAS",
                           "/lib/libblas.so.3"};
  try {
    RequireFastBlas(reference);
    FAIL() << "accepted the reference BLAS";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kFailedPrecondition);
    EXPECT_NE(std::string(error.what()).find("libopenblas0-pthread"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("/lib/libblas.so.3"), std::string::npos);
  }
}

TEST(ThreadsTest, WarnsOfABlasThatMayBeSlow) {
  EXPECT_EQ(RequireFastBlas({BlasInfo::Kind::kFast, "OpenBLAS", "path"}), "");
  const std::string unknown = RequireFastBlas({BlasInfo::Kind::kUnknown, "libodd.so", "/lib/odd"});
  EXPECT_NE(unknown.find("libodd.so"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("/lib/odd"), std::string::npos) << unknown;
  EXPECT_NE(RequireFastBlas({BlasInfo::Kind::kNone, "", ""}), "");
}

// This program links no BLAS; engine_torch_test looks at the one behind LibTorch.
TEST(ThreadsTest, FindsNoBlasWhereNoneIsLinked) {
  const BlasInfo blas = DetectBlas();
  EXPECT_EQ(blas.kind, BlasInfo::Kind::kNone) << blas.name << " " << blas.path;
}

TEST(ThreadsTest, CountsAtLeastOneCoreAndNoMoreThanTheMachineHas) {
  EXPECT_GE(UsableCores(), 1);
  EXPECT_LE(UsableCores(), static_cast<int>(std::thread::hardware_concurrency()));
}

TEST(ThreadsTest, RefusesThreadCountsOutOfRange) {
  EXPECT_THROW(SetMathThreads(0), Error);
  EXPECT_THROW(SetMathThreads(1025), Error);
  EXPECT_NO_THROW(SetMathThreads(1));
}

TEST(ThreadsTest, FlushesDenormalsHereAndInThreadsStartedAfterwards) {
  volatile float smallest = std::numeric_limits<float>::min();
  volatile float here = -1;
  volatile float child = -1;
  // In its own thread, so that other tests keep their arithmetic.
  std::thread([&] {
    const volatile float before = smallest / 4;
    ASSERT_GT(before, 0);
    FlushDenormals();
    here = smallest / 4;
    std::thread([&] { child = smallest / 4; }).join();
  }).join();
  EXPECT_EQ(here, 0);
  EXPECT_EQ(child, 0);
}

}  // namespace choreo::threads_test
