#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <mutex>

#include <functional>
#include <thread>

#include "tests/dance/dances.h"

// How a stream answers invalid input, or input at the wrong moment.
namespace choreo::dance_contract_test {

class DanceContract : public ::testing::Test {
 protected:
  std::string Refusal(const std::function<void(DanceStream&)>& message, ErrorCode code,
                      bool with_audio = false) {
    DanceConfig config;
    if (with_audio) config.audio = DanceConfig::Audio{22050, 2, 0};
    DanceStream stream(*queue_, Checked(*queue_, config), std::make_shared<Recorder>());
    try {
      message(stream);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
      return error.what();
    }
    return "accepted";
  }

  std::unique_ptr<SampleQueue> queue_ = FakeQueue();
  Pose rest_ = RestPose(Skeleton::Smpl24());
};

TEST_F(DanceContract, AudioGapsAndOverlapsNameTheSampleExpected) {
  const std::vector<float> samples(2000, 0.1F);  // 1000 of two channels
  for (int64_t next : {999, 1001, 0}) {
    const std::string refusal = Refusal(
        [&](DanceStream& stream) {
          stream.PushAudio(samples, 0);
          stream.PushAudio(samples, next);
        },
        ErrorCode::kOutOfRange, true);
    EXPECT_THAT(refusal, ::testing::StartsWith("first_sample: " + std::to_string(next)));
    EXPECT_THAT(refusal, ::testing::EndsWith("the sample expected is 1000"));
  }
}

TEST_F(DanceContract, AudioThatIsNoAudioIsRefused) {
  std::vector<float> samples(2000, 0.1F);
  samples[1001] = std::nanf("");
  EXPECT_THAT(Refusal([&](DanceStream& stream) { stream.PushAudio(samples, 0); },
                      ErrorCode::kInvalidArgument, true),
              ::testing::HasSubstr("sample 500 of channel 1"));
  samples[1001] = 0;
  samples.pop_back();
  EXPECT_THAT(Refusal([&](DanceStream& stream) { stream.PushAudio(samples, 0); },
                      ErrorCode::kInvalidArgument, true),
              ::testing::HasSubstr("samples: 1999 values"));
  EXPECT_EQ(
      Refusal([](DanceStream& stream) { stream.EndOfAudio(); }, ErrorCode::kInvalidArgument, true),
      "end_of_audio: no sample came before");
  EXPECT_EQ(
      Refusal([](DanceStream& stream) { stream.HalfClose(); }, ErrorCode::kInvalidArgument, true),
      "end_of_audio: no sample came before");
  EXPECT_EQ(Refusal([&](DanceStream& stream) { stream.PushAudio(samples, 0); },
                    ErrorCode::kInvalidArgument),
            "push_audio: comes in a dance without music");
  EXPECT_EQ(Refusal([](DanceStream& stream) { stream.EndOfAudio(); }, ErrorCode::kInvalidArgument),
            "end_of_audio: comes in a dance without music");
}

TEST_F(DanceContract, AudioBeyondTheLimitOrTheEndIsRefused) {
  const std::vector<float> ten_seconds(2 * 220500, 0.0F);
  EXPECT_THAT(Refusal(
                  [&](DanceStream& stream) {
                    // Paused, so that the test need not dance ten minutes; only the count matters
                    // here.
                    stream.SetPaused(true);
                    for (int64_t i = 0; i < 61; ++i) stream.PushAudio(ten_seconds, 220500 * i);
                  },
                  ErrorCode::kInvalidArgument, true),
              ::testing::HasSubstr("the limit is 600 s"));
  EXPECT_EQ(Refusal(
                [&](DanceStream& stream) {
                  stream.PushAudio(ten_seconds, 0);
                  stream.EndOfAudio();
                  stream.PushAudio(ten_seconds, 220500);
                },
                ErrorCode::kFailedPrecondition, true),
            "push_audio: comes after the end of the music");
  EXPECT_EQ(Refusal(
                [&](DanceStream& stream) {
                  stream.PushAudio(ten_seconds, 0);
                  stream.EndOfAudio();
                  stream.EndOfAudio();
                },
                ErrorCode::kFailedPrecondition, true),
            "end_of_audio: came before");
}

TEST_F(DanceContract, ErrorsNameTheFieldByItsPath) {
  EXPECT_EQ(Refusal(
                [&](DanceStream& stream) {
                  Pose bad = rest_;
                  bad.rotations(2, 16) = -7.9;
                  stream.SetKey({.id = "3", .pose = bad}, AtFrame{100});
                },
                ErrorCode::kInvalidArgument),
            "key.pose.rotations[16]: 7.9 rad exceeds 2π");
  EXPECT_EQ(Refusal([](DanceStream& stream) { stream.RemoveKey("none"); }, ErrorCode::kNotFound),
            "removed_key.id: there is no key \"none\"");
}

TEST_F(DanceContract, ADanceNeedsAnEnd) {
  for (auto close : {&DanceStream::KeysComplete, &DanceStream::HalfClose}) {
    EXPECT_EQ(
        Refusal([close](DanceStream& stream) { (stream.*close)(); }, ErrorCode::kInvalidArgument),
        "keys_complete: the dance has no end: no key, no music and no end frame");
  }
}

TEST_F(DanceContract, LateKeysAreRejectedAndTheDanceContinues) {
  auto sink = std::make_shared<Recorder>();
  DanceStream stream(*queue_, Checked(*queue_, DanceConfig()), sink);
  stream.GenerateUntil(0);
  stream.SetKey({.id = "a", .pose = rest_}, AtFrame{50});
  stream.GenerateUntil(60);
  stream.SetKey({.id = "late", .pose = rest_}, AtFrame{59});
  stream.SetKey({.id = "b", .pose = rest_}, AtFrame{60});
  stream.KeysComplete();
  const Recording recording = sink->WaitForEnd();
  ASSERT_TRUE(recording.summary);
  ASSERT_EQ(recording.rejected.size(), 1u);
  EXPECT_EQ(recording.rejected[0].id, "late");
  EXPECT_EQ(recording.rejected[0].earliest_frame, 60);
  EXPECT_EQ(recording.reached.size(), 2u);
}

TEST_F(DanceContract, MessagesAfterTheEndAreIgnored) {
  auto sink = std::make_shared<Recorder>();
  DanceStream stream(*queue_, Checked(*queue_, DanceConfig()), sink);
  stream.SetKey({.id = "a", .pose = rest_}, AtFrame{20});
  stream.Cancel();
  EXPECT_TRUE(sink->WaitForEnd().error);
  stream.SetKey({.id = "b", .pose = rest_}, AtFrame{40});
  stream.GenerateUntil(1000);
  stream.KeysComplete();
  stream.Cancel();
  EXPECT_TRUE(queue_->WaitUntilIdle(std::chrono::seconds(30)));
  EXPECT_EQ(sink->Snapshot().calls_after_end, 0);
}

TEST_F(DanceContract, StoppingTheQueueEndsDancesAfterTheRunningTransition) {
  const Dance dance = RandomDance(31);
  const auto queue = FakeQueue();
  auto sink = std::make_shared<Recorder>();
  DanceStream stream(*queue, Checked(*queue, dance.config), sink);
  // It pauses at its first frames, so it is under way when the stop comes.
  std::promise<void> began;
  std::once_flag once;
  sink->on_frames = [&](size_t) {
    std::call_once(once, [&] {
      stream.SetPaused(true);
      began.set_value();
    });
  };
  for (const Key& key : dance.keys) SendKey(stream, key);
  stream.KeysComplete();
  began.get_future().wait();
  queue->Stop();
  stream.SetPaused(false);
  const Recording recording = sink->WaitForEnd();
  ASSERT_TRUE(recording.error);
  EXPECT_EQ(recording.error->code(), ErrorCode::kUnavailable);
  EXPECT_TRUE(recording.in_order);
  EXPECT_EQ(recording.poses.size(), static_cast<size_t>(recording.continuations.back().frame));
}

// Dances that are cancelled, dropped, paused and refused at any moment, several at once.
TEST_F(DanceContract, ChaosEndsEveryDanceOnce) {
  const auto queue = QueueOf<FakeSampler>(2);
  std::vector<std::thread> clients;
  for (uint32_t client = 0; client < 6; ++client) {
    clients.emplace_back([&, client] {
      std::mt19937 random(client);
      for (int round = 0; round < 40; ++round) {
        const Dance dance = RandomDance(static_cast<uint32_t>(random()), round % 2 == 0 ? 1.5 : 0);
        auto sink = std::make_shared<Recorder>();
        std::weak_ptr<DanceStream> handle;
        const size_t stop_at = round % 4 == 3 ? 0 : 1 + random() % 200;  // 0: never
        sink->on_frames = [&handle, stop_at](size_t count) {
          const std::shared_ptr<DanceStream> alive = handle.lock();
          if (alive != nullptr && count == stop_at) alive->Cancel();
        };
        auto stream = std::make_shared<DanceStream>(*queue, Checked(*queue, dance.config), sink);
        handle = stream;
        for (const Key& key : dance.keys) SendKey(*stream, key);
        if (random() % 4 == 0) stream->SetPaused(true);
        if (dance.config.audio) SendSong(*stream, dance);
        const bool patient = round % 4 == 3;
        if (patient || random() % 3 > 0) stream->HalfClose();
        stream->SetPaused(false);
        if (random() % 2 == 0) {
          sink->Wait([](const Recording& r) { return r.poses.size() > 20 || r.ended(); });
        }
        if (patient) sink->WaitForEnd();
        if (random() % 3 == 0) stream->Cancel();
        stream.reset();  // cancels too
        const Recording recording = sink->WaitForEnd();
        EXPECT_TRUE(recording.in_order);
        EXPECT_EQ(recording.calls_after_end, 0);
        EXPECT_NE(recording.summary.has_value(), recording.error.has_value());
        if (patient) {
          EXPECT_TRUE(recording.summary);
        }
      }
    });
  }
  for (std::thread& client : clients) client.join();
  EXPECT_TRUE(queue->WaitUntilIdle(std::chrono::seconds(30)));
  EXPECT_EQ(queue->stats().active, 0);
  EXPECT_TRUE(Perform(*queue, RandomDance(32)).summary);
}

TEST_F(DanceContract, LatencyIncludesTheModelsLookAhead) {
  const ModelInfo model = FakeSampler().model();
  DanceConfig config;
  EXPECT_EQ(LatencyFrames(config, model), 0);
  config.output_fps = 60;
  EXPECT_EQ(LatencyFrames(config, model), 2);
  config.output_fps = 30;
  config.audio = DanceConfig::Audio{22050, 1, 0};
  EXPECT_EQ(LatencyFrames(config, model), 2);  // 1024 / 735 frames
  config.output_fps = 120;
  EXPECT_EQ(LatencyFrames(config, model), 10);  // (1024 / 735 + 1) * 4
  EXPECT_EQ(LatencyFrames(config, HearingSampler().model()), 10 + 4 * kTypicalFrames);
}

// A model that is not trained for longer transitions.
class CalmSampler : public FakeSampler {
 public:
  CalmSampler() { model_.max_temperature = 1.25; }
};

TEST(DanceWarnings, WarnsOfTemperatureBeyondTheModels) {
  for (const float asked : {1.25F, 1.5F}) {
    const auto queue = QueueOf<CalmSampler>();
    Dance dance = RandomDance(3);
    dance.config.temperature = asked;
    const Recording told = Perform(*queue, dance);
    const auto is_it = [](const Warning& warning) {
      return warning.code == Warning::Code::kTemperatureTooHigh;
    };
    EXPECT_EQ(std::ranges::count_if(told.warnings, is_it), asked > 1.25F ? 1 : 0);
    if (asked > 1.25F) {
      EXPECT_THAT(told.warnings[0].message,
                  ::testing::StartsWith("temperature 1.5 is beyond 1.25"));
    }
  }
}

}  // namespace choreo::dance_contract_test
