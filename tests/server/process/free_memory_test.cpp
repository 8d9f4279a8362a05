#include "server/process/free_memory.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>
#include <vector>

#include "server/process/process_usage.h"
#include "tests/support/sanitizers.h"

namespace choreo::free_memory_test {

// Every hundredth of many pieces stays, so the allocator returns none of the pages between.
TEST(FreeMemoryTest, GoesBackAlthoughSomeBetweenIsInUse) {
  if (kSanitized) GTEST_SKIP() << "sanitizers have an allocator of their own";
  constexpr size_t kPiece = 16 << 10, kStays = 100;
  FreeMemory memory;
  memory.Look();
  const int64_t before = ResidentBytes(getpid());
  std::vector<std::unique_ptr<char[]>> pieces;
  for (size_t i = 0; i < 2 * FreeMemory::kMuch / kPiece; ++i)
    pieces.push_back(std::make_unique<char[]>(kPiece));
  memory.Look();
  EXPECT_GT(ResidentBytes(getpid()) - before, FreeMemory::kMuch);
  for (size_t i = 0; i < pieces.size(); ++i) {
    if (i % kStays != 0) pieces[i].reset();
  }
  memory.Look();
  EXPECT_LT(ResidentBytes(getpid()) - before, FreeMemory::kMuch / 2);
}

}  // namespace choreo::free_memory_test
