#include "server/calls/frame_budget.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/core/grid.h"
#include "model/core/running/threads.h"
#include "model/plan/takes.h"
#include "tests/support/advanced_clock.h"
#include "tests/support/expect_error.h"
#include "tests/support/fake_sampler.h"

namespace choreo::frame_budget_test {

constexpr FrameShares kShares{.of_all = 0.71, .of_caller = 0.71, .of_lone_caller = 0.71};

/// Two models with one worker each, and time for 20 dances: 10 of each model.
class FrameBudgetTest : public ::testing::Test {
 protected:
  FrameBudgetTest() {
    for (int i = 0; i < 2; ++i) {
      std::vector<std::unique_ptr<Sampler>> samplers;
      samplers.push_back(std::make_unique<FakeSampler>());
      samplers.back()->set_seconds_a_frame(1.0 / 600);
      models.push_back(std::make_unique<SampleQueue>(std::move(samplers), SampleQueue::Options{}));
    }
  }

  // The number of dances of one address that are admitted one after another.
  static int ReserveDances(FrameBudget& budget, const SampleQueue& model,
                           const std::string& address, const char* calls) {
    for (int taken = 0;; ++taken) {
      try {
        budget.ReserveDance(calls + taken, model, address);
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kResourceExhausted);
        return taken;
      }
    }
  }

  std::vector<std::unique_ptr<SampleQueue>> models;
  const char calls[200] = {};  // whose addresses name calls
};

TEST_F(FrameBudgetTest, AdmitsWhatTheEnginesCanServe) {
  FrameBudget budget(kShares);
  EXPECT_EQ(ReserveDances(budget, *models[0], "a", calls), 14);
  EXPECT_NEAR(budget.loads()["fake"], 0.7, 1e-9);
  budget.GiveBack(&calls[3]);
  budget.GiveBack(&calls[3]);
  budget.ReserveDance(&calls[100], *models[0], "a");
  EXPECT_THROW(budget.ReserveDance(&calls[101], *models[0], "a"), Error);
}

TEST_F(FrameBudgetTest, SharesMayChangeMeanwhile) {
  FrameBudget budget(kShares);
  EXPECT_EQ(ReserveDances(budget, *models[0], "a", calls), 14);
  budget.SetShares({.of_all = 0.76, .of_caller = 0.76, .of_lone_caller = 0.76});
  EXPECT_EQ(ReserveDances(budget, *models[0], "a", calls + 100), 1);
}

// 17 dances at the mean cost leave no time to sample the frames of one of them five times.
TEST_F(FrameBudgetTest, LeavesTimeForOneDanceAtItsMost) {
  FrameBudget budget({.of_all = 0.99, .of_caller = 0.99, .of_lone_caller = 0.99});
  const double of_one = models[0]->LoadOf(kModelFps);
  const int taken = ReserveDances(budget, *models[0], "a", calls);
  EXPECT_LE((taken - 1 + kMaxTakes) * of_one, 1 + 1e-9);
  EXPECT_GT((taken + kMaxTakes) * of_one, 1);
  EXPECT_EQ(budget.utilisation(), 1);
}

TEST_F(FrameBudgetTest, ModelsShareTheTime) {
  FrameBudget budget(kShares);
  for (int i = 0; i < 7; ++i) budget.ReserveDance(&calls[i], *models[0], "a");
  EXPECT_EQ(ReserveDances(budget, *models[1], "a", calls + 100), 7);
}

TEST_F(FrameBudgetTest, OneAddressCannotTakeItAll) {
  FrameBudget budget({.of_all = 0.72, .of_caller = 0.36}, [](const std::string&) { return true; });
  EXPECT_EQ(ReserveDances(budget, *models[0], "a", calls), 7);
  ExpectError(ErrorCode::kResourceExhausted,
              "a has 35 % of its time, with this one it would be 40 %, of at most 36 %",
              [&] { budget.ReserveDance(&calls[99], *models[0], "a"); });
  EXPECT_EQ(ReserveDances(budget, *models[0], "b", calls + 100), 7);
}

// A slow engine serves about two dances, and one holder must not get both.
TEST_F(FrameBudgetTest, ARivalFindsTimeOnASmallServer) {
  bool rival = false;
  FrameBudget budget({.of_all = 0.16, .of_caller = 0.155, .of_lone_caller = 0.16},
                     [&rival](const std::string&) { return rival; });
  EXPECT_EQ(ReserveDances(budget, *models[0], "a", calls), 3);
  rival = true;
  EXPECT_THROW(budget.ReserveDance(&calls[50], *models[0], "b"), Error);
  budget.GiveBack(&calls[0]);
  EXPECT_THROW(budget.ReserveDance(&calls[51], *models[0], "a"), Error);
  budget.ReserveDance(&calls[52], *models[0], "b");
}

TEST_F(FrameBudgetTest, UtilisationIsOneWhereTheNextIsRefused) {
  bool rival = false;
  FrameBudget budget({.of_all = 0.72, .of_caller = 0.36, .of_lone_caller = 0.72},
                     [&rival](const std::string&) { return rival; });
  EXPECT_EQ(budget.utilisation(), 0);
  budget.ReserveDance(&calls[150], *models[0], "a");
  EXPECT_NEAR(budget.utilisation(), 0.05 / 0.72, 1e-9);
  EXPECT_EQ(ReserveDances(budget, *models[0], "a", calls), 13);
  EXPECT_EQ(budget.utilisation(), 1);
  for (int i = 0; i < 7; ++i) budget.GiveBack(&calls[i]);
  EXPECT_NEAR(budget.utilisation(), 0.35 / 0.72, 1e-9);
  rival = true;
  EXPECT_EQ(budget.utilisation(), 1);
}

TEST_F(FrameBudgetTest, TransitionsPayForTheirFramesUpToHalfTheBudget) {
  FrameBudget budget(kShares);
  budget.ReserveTransition(&calls[0], *models[0], "a", 600);  // as two dances for ten seconds
  EXPECT_NEAR(budget.loads()["fake"], 0.1, 1e-9);
  budget.ReserveTransition(&calls[1], *models[0], "a", 1'000'000);
  EXPECT_NEAR(budget.loads()["fake"], 0.455, 1e-9);
  EXPECT_EQ(ReserveDances(budget, *models[0], "a", calls + 100), 5);
  EXPECT_THROW(budget.ReserveTransition(&calls[2], *models[0], "a", 1'000'000), Error);
}

TEST_F(FrameBudgetTest, KnowsWhenTransitionsShouldBeMade) {
  AdvancedClock clock;
  FrameBudget budget({.of_all = 0.99, .of_caller = 0.99, .of_lone_caller = 0.99}, {}, nullptr,
                     clock);
  EXPECT_EQ(budget.SecondsToRoom(), 0);
  for (int i = 0; i < 2; ++i)
    budget.ReserveDance(&calls[i], *models[0], "a");  // a tenth of the time
  EXPECT_EQ(budget.SecondsToRoom(), 0) << "nobody knows how long dances last";
  budget.ReserveTransition(&calls[10], *models[0], "a", 5400);
  EXPECT_NEAR(budget.SecondsToRoom(), 10, 0.5);
  clock.Advance(std::chrono::seconds(4));
  budget.ReserveTransition(&calls[11], *models[0], "a", 540);
  EXPECT_NEAR(budget.SecondsToRoom(), 6, 0.5);
  budget.GiveBack(&calls[10]);
  EXPECT_NEAR(budget.SecondsToRoom(), 7, 0.5) << "it waited for the first";
  clock.Advance(std::chrono::seconds(9));
  EXPECT_EQ(budget.SecondsToRoom(), 0) << "it may end at any time";
}

// On one core, serving a dance costs half as much again as sampling it.
TEST_F(FrameBudgetTest, DancesPayForWhatServingThemTakes) {
  const ServingCost serving(UsableCores() * 0.5 / 600);
  FrameBudget budget(kShares, {}, &serving);
  budget.ReserveTransition(&calls[50], *models[0], "a", 600);
  EXPECT_NEAR(budget.loads()["fake"], 0.1, 1e-9);
  budget.GiveBack(&calls[50]);
  EXPECT_EQ(ReserveDances(budget, *models[0], "a", calls), 9);
  EXPECT_NEAR(budget.loads()["fake"], 0.675, 1e-9);
}

TEST_F(FrameBudgetTest, KnowsWhetherOthersThanDancesWereThere) {
  FrameBudget budget({});
  budget.ReserveDance(&calls[0], *models[0], "a");
  EXPECT_TRUE(budget.OnlyDanced());
  budget.ReserveTransition(&calls[1], *models[0], "a", 1);
  budget.GiveBack(&calls[1]);
  EXPECT_FALSE(budget.OnlyDanced());
  EXPECT_TRUE(budget.OnlyDanced());
  budget.ReserveTransition(&calls[2], *models[0], "a", 1);
  EXPECT_FALSE(budget.OnlyDanced());
  EXPECT_FALSE(budget.OnlyDanced());
  budget.GiveBack(&calls[2]);
  EXPECT_FALSE(budget.OnlyDanced());
  EXPECT_TRUE(budget.OnlyDanced());
}

TEST_F(FrameBudgetTest, AdmitsASingleDanceOnAnyEngine) {
  std::vector<std::unique_ptr<Sampler>> samplers;
  samplers.push_back(std::make_unique<FakeSampler>());
  samplers.back()->set_seconds_a_frame(1);
  models.push_back(std::make_unique<SampleQueue>(std::move(samplers), SampleQueue::Options{}));
  FrameBudget budget({.of_all = 0.9, .of_caller = 0.8});
  EXPECT_EQ(ReserveDances(budget, *models[2], "a", calls), 1);
  EXPECT_THROW(budget.ReserveDance(&calls[99], *models[0], "b"), Error);
  budget.GiveBack(&calls[0]);
  EXPECT_EQ(ReserveDances(budget, *models[2], "b", calls), 1);
}

TEST_F(FrameBudgetTest, FactorAboveOneRefusesNobody) {
  FrameBudget budget({.of_all = 1.1, .of_caller = 1.1});
  for (const char& call : calls) budget.ReserveDance(&call, *models[0], "a");
  EXPECT_NEAR(budget.loads()["fake"], 10, 1e-9);
}

}  // namespace choreo::frame_budget_test
