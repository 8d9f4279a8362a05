#include <gmock/gmock.h>

#include <iostream>
#include <map>
#include <thread>

#include "tests/server/operation/reload_fixture.h"

// How dances are affected when their models are replaced.
namespace choreo::reload_test {

TEST_F(ReloadTest, DanceKeepsItsModel) {
  Write("a.safetensors", "a 1");
  StartFolder();
  const Answer first = Whole("a");
  ASSERT_TRUE(first.status.ok()) << first.status.error_message();
  const auto during = Begin("a");
  Write("a.safetensors", "a 2");
  Reload();
  EXPECT_EQ(Served(), std::vector<std::string>{"a-2"});
  const Answer second = Whole("a");
  EXPECT_EQ(second.header->fingerprint(), "a-2");
  EXPECT_NE(second.Join().rotations, first.Join().rotations);
  EXPECT_EQ(*alive, 2);

  EXPECT_EQ(during->Finish().Join(), first.Join());
  EXPECT_EQ(during->answer().continuations.back().fingerprint(), "a-1");
  ExpectAlive(1);  // nobody dances the former one any more
}

TEST_F(ReloadTest, TransitionKeepsItsModel) {
  Write("a.safetensors", "a 1");
  StartFolder();
  v1::GenerateTransitionRequest request;
  *request.mutable_config() = Config();
  request.set_frames(600);
  const Answer wanted = Generate(request);
  ExpectEventually([this] { return server->transitions() == 0; }, "the first one is over");
  Answer during;
  std::thread call([&] { during = Generate(request); });
  ExpectEventually([this] { return server->transitions() == 1; }, "it is under way");
  Write("a.safetensors", "a 2");
  Reload();
  call.join();
  EXPECT_EQ(during.Join(), wanted.Join());
  EXPECT_NE(Generate(request).Join(), wanted.Join());
  ExpectAlive(1);
}

TEST_F(ReloadTest, ContinuationAcrossAReloadIsOfAnotherCheckpoint) {
  Write("a.safetensors", "a 1");
  StartFolder();
  const auto during = Begin("a");
  const Answer before = Whole("a");
  Write("a.safetensors", "a 2");
  Reload();
  v1::DanceConfig config = ConfigOf("a", 120);
  *config.mutable_continuation() = before.continuations.back();
  v1::StreamDanceRequest request;
  *request.mutable_config() = config;
  const Answer refused = Dance({request});
  EXPECT_EQ(refused.status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_THAT(refused.status.error_message(), testing::HasSubstr("a-1"));
  EXPECT_THAT(refused.status.error_message(), testing::HasSubstr("a-2"));
  EXPECT_TRUE(during->Finish().status.ok());
}

// Running dances are unaffected, new ones get one version or the other, and unused models are
// freed.
TEST_F(ReloadTest, HundredReloadsDuringDances) {
  constexpr int kVersions = 3, kDancers = 4;
  Write("a.safetensors", "a 0");
  StartFolder();
  std::map<std::string, Answer::Joined> wanted;
  for (int version = kVersions - 1; version >= 0; --version) {
    Write("a.safetensors", "a " + std::to_string(version));
    Reload();
    const Answer answer = Whole("a");
    wanted[answer.header->fingerprint()] = answer.Join();
  }
  ASSERT_EQ(wanted.size(), kVersions);
  std::atomic<bool> over = false;
  std::atomic<int> danced = 0;
  std::vector<std::thread> dancers;
  for (int i = 0; i < kDancers; ++i) {
    dancers.emplace_back([&] {
      do {
        const Answer answer = Whole("a");
        ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
        EXPECT_EQ(answer.Join(), wanted.at(answer.header->fingerprint()));
        ++danced;
      } while (!over);
    });
  }
  for (int i = 0; i < 100; ++i) {
    Write("a.safetensors", "a " + std::to_string(i % kVersions));
    Reload();
  }
  over = true;
  for (std::thread& dancer : dancers) dancer.join();
  EXPECT_GE(danced, kDancers);
  std::cout << "100 reloads beside " << danced << " dances, all bit for bit\n";
  ExpectIdle();
  ExpectAlive(1);
}

TEST_F(ReloadTest, ReloadDoesNotDisturbADrain) {
  Write("a.safetensors", "a 1");
  StartFolder();
  const Answer wanted = Whole("a");
  const auto during = Begin("a");
  std::thread drain([this] { server->Drain(10); });
  ExpectEventually([&] { return !Whole("a").status.ok(); }, "new calls are refused");
  Write("a.safetensors", "a 2");
  Reload();
  EXPECT_EQ(during->Finish().Join(), wanted.Join());
  EXPECT_EQ(Whole("a").status.error_code(), grpc::StatusCode::UNAVAILABLE);
  drain.join();
}

TEST_F(ReloadTest, ServerMayStopWhileAFormerModelDances) {
  Write("a.safetensors", "a 1");
  StartFolder();
  const auto during = Begin("a");
  Write("a.safetensors", "a 2");
  Reload();
  server.reset();
  EXPECT_FALSE(during->Finish().status.ok());
  ExpectAlive(0);
}

}  // namespace choreo::reload_test
