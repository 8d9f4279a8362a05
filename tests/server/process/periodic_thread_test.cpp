#include "server/process/periodic_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <iostream>
#include <new>

#include "tests/server/fixture.h"

namespace choreo::periodic_thread_test {

TEST(PeriodicThreadTest, ContinuesAfterMemoryRanOut) {
  std::atomic<int> looks = 0;
  const PeriodicThread watch(std::chrono::milliseconds(1), [&] {
    if (++looks < 3) throw std::bad_alloc();
  });
  ExpectEventually([&] { return looks > 5; }, "it looks again");
  std::cout << looks << " looks, the first two without memory\n";
}

}  // namespace choreo::periodic_thread_test
