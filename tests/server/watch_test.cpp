#include "server/watch.h"

#include <gtest/gtest.h>

#include <atomic>
#include <iostream>
#include <new>

#include "tests/server/fixture.h"

namespace choreo::watch_test {

TEST(WatchTest, ContinuesAfterMemoryRanOut) {
  std::atomic<int> looks = 0;
  const Watch watch(std::chrono::milliseconds(1), [&] {
    if (++looks < 3) throw std::bad_alloc();
  });
  ExpectEventually([&] { return looks > 5; }, "it looks again");
  std::cout << looks << " looks, the first two without memory\n";
}

}  // namespace choreo::watch_test
