#include "model/dance/transition_group.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <thread>

#include "model/dance/delivery/hand_over.h"
#include "tests/dance/dances.h"
#include "tests/engine/sample_job.h"
#include "tests/support/expect_error.h"

namespace choreo::transition_group_test {

class GroupRecorder : public GroupSink {
 public:
  void OnFrames(int candidate, int64_t first_frame, std::span<const Pose> poses,
                std::span<const Contacts>) override {
    if (on_frames) on_frames();
    std::lock_guard lock(mutex_);
    frames.resize(std::max(frames.size(), static_cast<size_t>(candidate) + 1));
    auto& list = frames[static_cast<size_t>(candidate)];
    if (list.empty()) first = first_frame;
    list.insert(list.end(), poses.begin(), poses.end());
  }
  void OnWarning(const Warning& warning) override {
    std::lock_guard lock(mutex_);
    warnings.push_back(warning);
  }
  void OnDone(std::span<const CandidateReport> reports) override {
    std::lock_guard lock(mutex_);
    ranked.emplace(reports.begin(), reports.end());
    changed_.notify_all();
  }
  void OnError(const Error& failure) override {
    std::lock_guard lock(mutex_);
    error = failure;
    changed_.notify_all();
  }
  void Wait() {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, std::chrono::minutes(1), [&] { return ranked || error; })) {
      throw std::runtime_error("the group never ends");
    }
  }

  std::function<void()> on_frames;
  int64_t first = -1;
  std::vector<std::vector<Pose>> frames;
  std::vector<Warning> warnings;
  std::optional<std::vector<CandidateReport>> ranked;
  std::optional<Error> error;

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
};

std::shared_ptr<GroupRecorder> Generate(SampleQueue& queue, const GroupRequest& request) {
  auto sink = std::make_shared<GroupRecorder>();
  TransitionGroup group(queue, Checked(queue, request), sink);
  sink->Wait();
  return sink;
}

GroupRequest RandomRequest(uint32_t seed) {
  std::mt19937 random(seed);
  GroupRequest request;
  request.seed = seed;
  request.frames = 20 + static_cast<int>(random() % 30);
  request.history = MotionTo(RandomPose(random), 10, random);
  request.target = Target{RandomPose(random), {}};
  return request;
}

TEST(TransitionGroup, RunsRanksAndHitsAllCandidates) {
  const auto queue = FakeQueue(2);  // fewer workers than candidates
  GroupRequest request = RandomRequest(1);
  request.candidates = 9;
  request.temperature = 1.0F;
  const auto sink = Generate(*queue, request);
  ASSERT_TRUE(sink->ranked);
  ASSERT_EQ(sink->ranked->size(), 9u);
  ASSERT_EQ(sink->frames.size(), 9u);
  std::set<int> seen;
  for (const CandidateReport& report : *sink->ranked) {
    seen.insert(report.candidate);
    const std::vector<Pose>& poses = sink->frames[static_cast<size_t>(report.candidate)];
    ASSERT_EQ(poses.size(), static_cast<size_t>(request.frames));
    EXPECT_LT(ComparePoses(Skeleton::Smpl24(), poses.back(), request.target->pose).position_m,
              1e-4);
    EXPECT_EQ(report.continuation.frame, request.frames);
    EXPECT_TRUE(SameBits(report.continuation.poses.back(), poses.back()));
    ASSERT_EQ(report.quality.keys.size(), 1u);
  }
  EXPECT_EQ(seen.size(), 9u);
  EXPECT_FALSE(SameBits(sink->frames[0][5], sink->frames[1][5]));
  std::vector<CandidateReport> again = *sink->ranked;
  RankCandidates(again);
  for (size_t i = 0; i < again.size(); ++i) {
    EXPECT_EQ(again[i].candidate, (*sink->ranked)[i].candidate);
  }
}

TEST(TransitionGroup, RanksBySteeringThenSkateThenLikelihood) {
  const auto report = [](int candidate, double steered, double skate,
                         std::optional<double> likelihood) {
    CandidateReport made;
    made.candidate = candidate;
    made.quality.keys.resize(1);
    made.quality.keys[0].raw_error_m = 0.0103;  // as every plan that reaches its key has it
    made.quality.keys[0].correction_m = steered;
    made.quality.skate_ratio = skate;
    made.quality.log_likelihood = likelihood;
    return made;
  };
  std::vector<CandidateReport> list = {report(0, 0.051, 0.001, 9), report(1, 0.003, 0.2, 9),
                                       report(2, 0.004, 0.103, 5), report(3, 0.009, 0.101, 7),
                                       report(4, 0.001, 0.109, 7)};
  RankCandidates(list);
  std::vector<int> order;
  for (const CandidateReport& one : list) order.push_back(one.candidate);
  EXPECT_EQ(order, (std::vector<int>{3, 4, 2, 1, 0}));
  // Without likelihood and key, the other criteria decide.
  list = {report(0, 0.02, 0.02, {}), report(1, 0.02, 0, {}), report(2, 0.02, 0, {})};
  list[0].quality.keys.clear();
  RankCandidates(list);
  order.clear();
  for (const CandidateReport& one : list) order.push_back(one.candidate);
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2}));
}

TEST(TransitionGroup, RanksWhatBodiesCanDoFirst) {
  std::vector<CandidateReport> list(3);
  for (int candidate = 0; candidate < 3; ++candidate) {
    list[static_cast<size_t>(candidate)].candidate = candidate;
    list[static_cast<size_t>(candidate)].quality.skate_ratio = 0.1 * candidate;
  }
  list[0].strain = 1.5;
  list[1].strain = 1.2;
  RankCandidates(list);
  EXPECT_EQ(list[0].candidate, 2);
  EXPECT_EQ(list[1].candidate, 1);
  EXPECT_EQ(list[2].candidate, 0);
}

TEST(TransitionGroup, RanksByLikelihoodAloneOnRequest) {
  const auto report = [](int candidate, double steered, std::optional<double> likelihood) {
    CandidateReport made;
    made.candidate = candidate;
    made.quality.keys.resize(1);
    made.quality.keys[0].correction_m = steered;
    made.quality.log_likelihood = likelihood;
    return made;
  };
  std::vector<CandidateReport> list = {report(0, 0, 3), report(1, 0.2, 9), report(2, 0.1, 9)};
  RankCandidates(list, RankBy::kLikelihood);
  std::vector<int> order;
  for (const CandidateReport& one : list) order.push_back(one.candidate);
  EXPECT_EQ(order, (std::vector<int>{1, 2, 0}));
  RankCandidates(list);
  EXPECT_EQ(list.front().candidate, 0);
}

TEST(TransitionGroup, RanksAsRequestedIfTheModelCan) {
  const auto queue = FakeQueue(2);
  GroupRequest request = RandomRequest(1);
  request.candidates = 6;
  request.temperature = 1.0F;
  request.rank_by = RankBy::kLikelihood;
  const auto sink = Generate(*queue, request);
  ASSERT_TRUE(sink->ranked);
  for (size_t i = 1; i < sink->ranked->size(); ++i) {
    EXPECT_GE(*(*sink->ranked)[i - 1].quality.log_likelihood,
              *(*sink->ranked)[i].quality.log_likelihood);
  }
  ModelInfo without = queue->model();
  without.likelihood = false;
  ExpectError(ErrorCode::kInvalidArgument,
              "rank_by: \"fake\" has no likelihood, only quality is possible",
              [&] { ValidGroup(request, without); });
}

TEST(TransitionGroup, RanksSupportBeforeSkating) {
  const auto report = [](int candidate, std::optional<double> support, double skate) {
    CandidateReport made;
    made.candidate = candidate;
    made.quality.support = support;
    made.quality.skate_ratio = skate;
    return made;
  };
  std::vector<CandidateReport> list = {report(0, 0.6, 0), report(1, 0.97, 0.2),
                                       report(2, 0.96, 0.1), report(3, 0.8, 0.05)};
  RankCandidates(list);
  std::vector<int> order;
  for (const CandidateReport& one : list) order.push_back(one.candidate);
  EXPECT_EQ(order, (std::vector<int>{2, 1, 3, 0}));
}

TEST(TransitionGroup, StreamIsCandidateZeroOfTheChain) {
  const auto queue = FakeQueue();
  for (double fps : {30.0, 50.0}) {
    Dance dance = RandomDance(2, 6);
    dance.config.output_fps = fps;
    const Recording stream = Perform(*queue, dance);
    ASSERT_TRUE(stream.summary);
    std::vector<Pose> chained;
    std::optional<Continuation> continuation;
    size_t key = 0;
    // The same cuts: one for each key, then free ones to the music's end.
    for (const Continuation& end : stream.continuations) {
      GroupRequest request;
      request.seed = dance.config.seed;
      request.candidates = 2;
      request.output_fps = fps;
      request.continuation = continuation;
      request.audio = DanceStart::Audio{.sample_rate = 22050, .channels = 1};
      request.samples = dance.samples;
      request.music_beats = dance.config.music_beats;
      const int64_t from = continuation ? continuation->frame : 0;
      const bool has_key = key < dance.keys.size() && dance.keys[key].frame + 1 == end.frame;
      request.frames = has_key ? static_cast<int>(end.frame - from) : kTypicalFrames;
      if (has_key) {
        request.target = Target{dance.keys[key].pose, dance.keys[key].mask};
        ++key;
      }
      const auto sink = Generate(*queue, request);
      ASSERT_TRUE(sink->ranked) << sink->error->what();
      EXPECT_EQ(sink->first, static_cast<int64_t>(chained.size()));
      chained.insert(chained.end(), sink->frames[0].begin(), sink->frames[0].end());
      for (const CandidateReport& report : *sink->ranked) {
        if (report.candidate == 0) continuation = report.continuation;
      }
      ASSERT_TRUE(continuation->stage && end.stage);
      EXPECT_EQ(continuation->stage->origin, end.stage->origin);
      EXPECT_EQ(continuation->stage->heading, end.stage->heading);
      continuation->frame = from + request.frames;
    }
    EXPECT_EQ(key, dance.keys.size());
    ASSERT_GE(chained.size(), stream.poses.size());  // the stream stops where the music does
    for (size_t i = 0; i < stream.poses.size(); ++i) {
      ASSERT_TRUE(SameBits(chained[i], stream.poses[i])) << i;
    }
  }
}

// This holds on average, because footwork moves the pelvis, too.
TEST(TransitionGroup, MeetsTheMotionThatFollows) {
  const auto queue = FakeQueue();
  double aware = 0, unaware = 0;
  for (int seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    GroupRequest request = RandomRequest(seed);
    const std::vector<Pose> next = MotionTo(RandomPose(random), 2, random, 0.02);
    request.target = Target{next[0], {}};
    const Eigen::Vector3d wanted = next[1].root_position - next[0].root_position;
    const auto miss = [&] {
      const auto sink = Generate(*queue, request);
      const std::vector<Pose>& poses = sink->frames[0];
      const Eigen::Vector3d last =
          poses.back().root_position - poses[poses.size() - 2].root_position;
      return (last - wanted).norm();
    };
    unaware += miss();
    request.after = next[1];
    aware += miss();
  }
  EXPECT_LT(aware, 0.7 * unaware);
}

// The thread that resumes it may be one of gRPC's.
TEST(TransitionGroup, WorkersHandOutWhatAPauseHeldBack) {
  const auto queue = FakeQueue();
  GroupRequest request = RandomRequest(6);
  request.candidates = 3;
  const auto sink = std::make_shared<GroupRecorder>();
  std::atomic<int> handed_out_here = 0;
  sink->on_frames = [&, here = std::this_thread::get_id()] {
    if (std::this_thread::get_id() == here) ++handed_out_here;
  };
  std::promise<void> paused;
  const auto gate = std::make_shared<LoggedJob>("gate", 1, 0, nullptr);
  gate->in_slice = [&] { paused.get_future().wait(); };
  queue->Submit(gate);
  TransitionGroup group(*queue, Checked(*queue, request), sink);
  group.SetPaused(true);
  paused.set_value();
  EXPECT_TRUE(queue->WaitUntilIdle(std::chrono::seconds(30)));
  group.SetPaused(false);
  sink->Wait();
  ASSERT_TRUE(sink->ranked);
  for (const std::vector<Pose>& frames : sink->frames)
    EXPECT_EQ(std::ssize(frames), request.frames);
  EXPECT_LE(handed_out_here, kFramesASlice);
  EXPECT_TRUE(queue->WaitUntilIdle(std::chrono::seconds(30)));
  EXPECT_EQ(queue->stats().transitions, 4U) << "the gate's too, but none for handing out";
}

TEST(TransitionGroup, CancellationAndRefusalFreeAllRoom) {
  const auto queue = FakeQueue(1, 5);
  GroupRequest request = RandomRequest(5);
  request.frames = 1800;
  request.candidates = 5;
  {
    auto sink = std::make_shared<GroupRecorder>();
    TransitionGroup group(*queue, Checked(*queue, request), sink);
    group.Cancel();
    sink->Wait();
    if (sink->error) {
      EXPECT_EQ(sink->error->code(), ErrorCode::kCancelled);
    }
  }
  EXPECT_TRUE(queue->WaitUntilIdle(std::chrono::seconds(30)));
  request.candidates = 6;  // one more than there is room for
  auto silent = std::make_shared<GroupRecorder>();
  try {
    TransitionGroup group(*queue, Checked(*queue, request), silent);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kResourceExhausted);
  }
  EXPECT_TRUE(queue->WaitUntilIdle(std::chrono::seconds(30)));
  EXPECT_TRUE(silent->frames.empty());
  EXPECT_FALSE(silent->error);
  request.frames = 20;
  request.candidates = 5;
  EXPECT_TRUE(Generate(*queue, request)->ranked);
}

}  // namespace choreo::transition_group_test
