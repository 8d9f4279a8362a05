#include <gmock/gmock.h>

#include <barrier>
#include <iostream>
#include <thread>

#include "tests/server/fixture.h"
#include "tests/support/sanitizers.h"

/// Clients ask for four times as many dances as an engine has time for. How late dances are under
/// real load, the benchmark `load` tells.
namespace choreo::overload_test {

constexpr int kHolds = 16;  // dances that take all of the engine's time
constexpr int kComing = 4 * kHolds;

class OverloadTest : public ServerTest {
 protected:
  // A server with default settings, whose engine makes no frame: it costs what it is said to.
  OverloadTest() {
    probe->Close();
    auto sampler = std::make_unique<ProbedSampler>("fake", probe);
    sampler->set_seconds_a_frame(1.0 / (kModelFps * kHolds));
    StartWith(std::move(sampler));
  }

  // Opens a dance. Null if it is refused, as it should be.
  std::unique_ptr<DanceClient> Ask() {
    auto client = std::make_unique<DanceClient>(stub());
    v1::DanceConfig config = Config();
    config.set_frames(60);
    client->Send(config);
    client->SendKeyframesComplete();
    if (client->ReadHeader()) return client;
    const Answer& answer = client->Finish();
    EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED)
        << answer.status.error_message();
    EXPECT_TRUE(answer.frames.empty()) << "it was admitted";
    EXPECT_TRUE(DetailsOf(answer.status).retry_info);
    return nullptr;
  }

  // kComing clients ask at once. Those who are admitted.
  std::vector<std::unique_ptr<DanceClient>> AskTogether() {
    std::vector<std::unique_ptr<DanceClient>> clients(kComing);
    {
      std::barrier together(kComing);
      std::vector<std::jthread> asking;
      for (auto& client : clients) {
        asking.emplace_back([&] {
          together.arrive_and_wait();
          client = Ask();
        });
      }
    }
    std::erase(clients, nullptr);
    return clients;
  }
};

// Of the time 15 % may not be promised, and serving takes some. What is left must not stay idle.
TEST_F(OverloadTest, ABurstIsAdmittedAsFarAsTheEngineHolds) {
  const auto clients = AskTogether();
  const auto admitted = std::ssize(clients);
  EXPECT_LE(admitted, static_cast<int>(0.85 * kHolds));
  EXPECT_GE(admitted, kSanitized ? 1 : kHolds / 2);
  std::cout << kComing << " dances at once for an engine that holds " << kHolds << ": " << admitted
            << " admitted, the others refused with a time to come back\n";
  probe->Open();
}

// No call has ended that could tell.
TEST_F(OverloadTest, ARefusedTransitionLearnsHowLongTheOthersTake) {
  v1::GenerateTransitionRequest request;
  *request.mutable_config() = Config();
  request.set_frames(480);  // a second of the engine's time
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
  std::vector<std::unique_ptr<grpc::ClientReader<v1::GenerateTransitionResponse>>> running;
  for (const unsigned candidates : {30U, 4U}) {
    request.set_candidates(candidates);
    contexts.push_back(std::make_unique<grpc::ClientContext>());
    running.push_back(stub().GenerateTransition(contexts.back().get(), request));
    v1::GenerateTransitionResponse header;
    ASSERT_TRUE(running.back()->Read(&header));
  }
  request.set_candidates(2);
  const grpc::Status refused = Generate(request).status;
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  const Details details = DetailsOf(refused);
  ASSERT_TRUE(details.retry_info);
  EXPECT_GE(details.retry_info->retry_delay().seconds(), 15);
  for (size_t i = 0; i < running.size(); ++i) {
    contexts[i]->TryCancel();
    running[i]->Finish();
  }
  probe->Open();
}

TEST_F(OverloadTest, AdmitsSomeAndTheOthersOnceTheseAreOver) {
  const auto admitted = AskTogether();
  ASSERT_FALSE(admitted.empty());
  ASSERT_FALSE(Ask());
  probe->Open();
  for (const auto& dance : admitted) {
    const Answer& answer = dance->Finish();
    EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
    EXPECT_EQ(answer.Join().count, 60);
  }
  ExpectIdle();
  EXPECT_TRUE(Ask()) << "it has recovered";
}

}  // namespace choreo::overload_test
