#include "server/calls/outbox.h"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "choreo/v1/choreography.pb.h"

namespace choreo::outbox_test {

using Response = v1::StreamDanceResponse;

struct RecordingWire : Outbox<Response>::Wire {
  void Write(const Response* message) override {
    EXPECT_FALSE(status) << "a write after the end";
    written.push_back(*message);
  }
  void Finish(const grpc::Status& end) override {
    EXPECT_FALSE(status) << "finished twice";
    status = end;
  }
  void Read() override {
    EXPECT_FALSE(status) << "a read after the end";
    ++reads;
  }
  std::vector<Response> written;
  int reads = 0;
  std::optional<grpc::Status> status;
};

Response Frames(int64_t first, int count, uint32_t candidate = 0) {
  Response response;
  auto* frames = response.mutable_frames();
  frames->set_first_frame(first);
  frames->set_count(count);
  frames->set_candidate(candidate);
  for (int i = 0; i < 3 * count; ++i) frames->add_root_positions(static_cast<float>(first + i / 3));
  return response;
}

class OutboxTest : public testing::Test {
 protected:
  static constexpr size_t kMaxBytes = 1000;
  RecordingWire wire;
  std::vector<bool> pauses;
  Outbox<Response> outbox{&wire, kMaxBytes, [this](bool paused) { pauses.push_back(paused); }};
};

TEST_F(OutboxTest, OneWriteAtATimeThenTheEnd) {
  Response header;
  header.mutable_header()->set_model("m");
  outbox.Send(header);
  outbox.Send(Frames(0, 1));
  EXPECT_EQ(wire.written.size(), 1U);
  outbox.End(grpc::Status::OK, Ending::kAfterQueued);
  outbox.Send(Frames(1, 1));  // too late
  EXPECT_FALSE(outbox.open());
  outbox.OnWriteDone(true);
  EXPECT_EQ(wire.written.size(), 2U);
  EXPECT_FALSE(wire.status);
  outbox.OnWriteDone(true);
  ASSERT_TRUE(wire.status);
  EXPECT_TRUE(wire.status->ok());
  EXPECT_EQ(wire.written.size(), 2U);
}

TEST_F(OutboxTest, QueuedFramesAreJoined) {
  outbox.Send(Frames(0, 1));  // on its way
  for (int i = 1; i <= 70; ++i) outbox.Send(Frames(i, 1));
  outbox.Send(Frames(0, 1, 1));  // of another candidate
  outbox.Send(Frames(5, 1, 1));  // not the next one
  std::vector<std::pair<int64_t, int>> parts;
  for (size_t i = 0; i < wire.written.size(); ++i) {
    const auto& frames = wire.written[i].frames();
    parts.emplace_back(frames.first_frame(), frames.count());
    EXPECT_EQ(frames.root_positions_size(), 3 * frames.count());
    outbox.OnWriteDone(true);
  }
  EXPECT_EQ(parts,
            (std::vector<std::pair<int64_t, int>>{{0, 1}, {1, 60}, {61, 10}, {0, 1}, {5, 1}}));
}

// Joined frames count as waiting since the first of them was queued.
TEST_F(OutboxTest, TellsWhatHasGoneOutAndSinceWhenItWaited) {
  using Clock = std::chrono::steady_clock;
  std::vector<std::pair<int64_t, Clock::time_point>> sent;
  Outbox<Response> telling(
      &wire, kMaxBytes, [](bool) {},
      [&](const Response& answer, Clock::time_point queued) {
        sent.emplace_back(answer.frames().first_frame(), queued);
      });
  const auto begin = Clock::now();
  telling.Send(Frames(0, 1));
  telling.Send(Frames(1, 1));
  const auto between = Clock::now();
  telling.Send(Frames(2, 1));
  EXPECT_TRUE(sent.empty());
  telling.OnWriteDone(true);
  telling.OnWriteDone(true);
  telling.Send(Frames(3, 1));
  telling.OnWriteDone(false);
  ASSERT_EQ(sent.size(), 2U) << "what was lost has not gone out";
  for (const int64_t i : {0, 1}) {
    EXPECT_EQ(sent[static_cast<size_t>(i)].first, i);
    EXPECT_GE(sent[static_cast<size_t>(i)].second, begin);
    EXPECT_LE(sent[static_cast<size_t>(i)].second, between);
  }
}

TEST_F(OutboxTest, ASlowClientPausesTheDance) {
  int64_t frame = 0;
  while (pauses.empty()) {
    outbox.Send(Frames(frame, 10));
    frame += 10;
    ASSERT_LT(frame, 1000);
  }
  EXPECT_EQ(pauses, (std::vector<bool>{true}));
  while (pauses.size() < 2 && wire.written.size() < 100) outbox.OnWriteDone(true);
  EXPECT_EQ(pauses, (std::vector<bool>{true, false}));
}

// A client sends message after message, each answered by an event, and reads no answer.
TEST_F(OutboxTest, StopsReadingFromASlowReader) {
  Response refusal;
  refusal.mutable_event()->mutable_keyframe_rejected()->set_reason(std::string(100, 'x'));
  outbox.RequestRead();
  int asked = 0;
  for (; wire.reads == asked + 1; outbox.RequestRead()) {
    outbox.Send(refusal);
    ASSERT_LT(++asked, 1000);
  }
  const size_t waiting = static_cast<size_t>(asked) * refusal.ByteSizeLong();
  EXPECT_GT(waiting, outbox.kMaxWaiting * kMaxBytes);
  EXPECT_LE(waiting, outbox.kMaxWaiting * kMaxBytes + refusal.ByteSizeLong());
  outbox.OnWriteDone(true);  // room for one
  EXPECT_EQ(wire.reads, asked + 1);
  outbox.OnWriteDone(true);
  EXPECT_EQ(wire.reads, asked + 1) << "read twice for one request";
}

TEST_F(OutboxTest, NothingIsReadAfterTheEnd) {
  outbox.Send(Frames(0, 1));
  outbox.End(grpc::Status::OK, Ending::kAfterQueued);
  outbox.RequestRead();
  outbox.OnWriteDone(true);
  EXPECT_TRUE(wire.status);
  EXPECT_EQ(wire.reads, 0);
}

TEST_F(OutboxTest, AbortDropsQueuedMessages) {
  outbox.Send(Frames(0, 1));
  outbox.Send(Frames(1, 1));
  outbox.End({grpc::StatusCode::UNAVAILABLE, "draining"}, Ending::kAfterCurrent);
  EXPECT_FALSE(wire.status) << "finished with a write on its way";
  outbox.OnWriteDone(true);
  ASSERT_TRUE(wire.status);
  EXPECT_EQ(wire.status->error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(wire.written.size(), 1U);
}

TEST_F(OutboxTest, AFailedWriteEndsTheCall) {
  outbox.Send(Frames(0, 1));
  outbox.Send(Frames(1, 1));
  outbox.OnWriteDone(false);
  ASSERT_TRUE(wire.status);
  EXPECT_EQ(wire.status->error_code(), grpc::StatusCode::CANCELLED);
}

TEST_F(OutboxTest, TheFirstEndCounts) {
  outbox.Send(Frames(0, 1));
  outbox.End({grpc::StatusCode::INVALID_ARGUMENT, "first"}, Ending::kAfterQueued);
  outbox.End(grpc::Status::OK, Ending::kAfterQueued);
  outbox.End({grpc::StatusCode::CANCELLED, "third"}, Ending::kAfterCurrent);
  outbox.OnWriteDone(true);
  ASSERT_TRUE(wire.status);
  EXPECT_EQ(wire.status->error_message(), "first");
  EXPECT_EQ(outbox.status().error_message(), "first");
}

TEST_F(OutboxTest, AHoldDefersTheEnd) {
  {
    const Outbox<Response>::Hold hold(outbox);
    outbox.End(grpc::Status::OK, Ending::kAfterQueued);
    EXPECT_FALSE(wire.status);
  }
  EXPECT_TRUE(wire.status);
}

}  // namespace choreo::outbox_test
