#include <gmock/gmock.h>

#include <cmath>

#include "model/core/running/threads.h"
#include "model/engine/sampling_cost.h"
#include "model/samplers/samplers.h"
#include "server/calls/serving_cost.h"
#include "tests/server/fixture.h"

/// How many dances a server with default settings admits, with real kernels and the shipped
/// checkpoint.
namespace choreo::admission_test {

class AdmissionTest : public ServerTest {
 protected:
  AdmissionTest() {
    SetTorchThreads(1);
    std::unique_ptr<Sampler> sampler = MakeSampler(SHIPPED_CHECKPOINT, Device{});
    WarmUp(*sampler);
    seconds_a_frame = sampler->seconds_a_frame();
    StartWith(std::move(sampler));
  }

  int MaxStreams() {
    grpc::ClientContext context;
    v1::GetServerInfoResponse info;
    EXPECT_TRUE(stub().GetServerInfo(&context, {}, &info).ok());
    return info.limits().max_streams();
  }

  double seconds_a_frame = 0;
};

// The number was once 64 on every machine.
TEST_F(AdmissionTest, TakesAsManyDancesAsTheMachineCarries) {
  const double of_one = kModelFps * seconds_a_frame + ServingCost().LoadOf(kModelFps);
  const auto carried = static_cast<int>(ServerConfig{}.max_load / of_one);
  const int limit = MaxStreams(), most = UsableCores() * kStreamsPerCore;
  EXPECT_GE(limit, std::min(carried, most));
  EXPECT_LE(limit, std::max(most, 64));
  std::vector<std::unique_ptr<DanceClient>> dances;
  grpc::Status refused;
  while (refused.ok() && std::ssize(dances) <= limit) {
    dances.push_back(std::make_unique<DanceClient>(stub()));
    dances.back()->Send(Config());
    if (!dances.back()->ReadHeader()) refused = dances.back()->Finish().status;
  }
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_NEAR(static_cast<double>(std::ssize(dances) - 1), std::clamp(carried, 1, limit), 1);
}

}  // namespace choreo::admission_test
