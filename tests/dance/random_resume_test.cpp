#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <random>
#include <vector>

#include "tests/dance/dances.h"

/// Live dances with messages in random order, resumed wherever that is possible.
namespace choreo::random_resume_test {

using Message = std::function<void(DanceStream&)>;

/// Messages of clients that make mistakes.
Message Tried(Message message) {
  return [message = std::move(message)](DanceStream& stream) {
    try {
      message(stream);
    } catch (const Error&) {  // a key too near to another one, or one that nobody knows
    }
  };
}

Message RandomMessage(int64_t granted, int64_t frames, std::mt19937& random) {
  const auto ahead = [&](int64_t least, int64_t most) {
    const auto range = static_cast<uint32_t>(most - least + 1);
    return std::max<int64_t>(0, granted + least + static_cast<int64_t>(random() % range));
  };
  const std::string id(1, static_cast<char>('a' + random() % 8));
  switch (random() % 9) {
    case 0:
    case 1: {
      Key key{id, std::min(ahead(-10, 120), frames - 1), RandomPose(random), {}};
      if (random() % 2 == 0) key.hit = 0.5 * static_cast<double>(random() % 7);
      return [key](DanceStream& stream) { SendKey(stream, key); };
    }
    case 2:
      return [id](DanceStream& stream) { stream.RemoveKey(id); };
    case 3: {
      ControlRequest request;
      request.velocity_factors.emplace().factors = {0.5F +
                                                    0.01F * static_cast<float>(random() % 100)};
      return [request](DanceStream& stream) { stream.SetControls(request); };
    }
    case 4: {
      const double from = static_cast<double>(ahead(-10, 200)) / 30 + 2.1;
      const std::vector<Passage> passages{
          {from, from + 0.1 * static_cast<double>(random() % 60),
           (from - 2) * 0.01 * static_cast<double>(random() % 100)}};
      return [passages](DanceStream& stream) { stream.GivePassages(passages); };
    }
    default: {
      std::vector<double> beats{static_cast<double>(ahead(-10, 200)) / 30};
      for (auto more = random() % 8; more > 0; --more) beats.push_back(beats.back() + 0.45);
      return [beats](DanceStream& stream) { stream.GiveBeats(beats); };
    }
  }
}

std::vector<Message> RandomMessages(int64_t frames, std::mt19937& random) {
  constexpr std::array<int64_t, 6> kStrides{1, 2, 5, 9, 20, 60};
  std::vector<Message> messages;
  for (int64_t granted = 0; granted < frames;) {
    for (auto more = random() % 3; more > 0; --more)
      messages.push_back(Tried(RandomMessage(granted, frames, random)));
    granted = std::min(frames, granted + kStrides[random() % kStrides.size()]);
    messages.push_back([granted](DanceStream& stream) { stream.GenerateUntil(granted); });
  }
  return messages;
}

Recording Play(SampleQueue& queue, const Dance& dance, const DanceConfig& config,
               const std::vector<Message>& messages) {
  auto sink = std::make_shared<Recorder>();
  DanceStream stream(queue, Checked(queue, config), sink);
  for (const Message& message : messages) message(stream);
  SendSong(stream, dance, config.audio->first_sample);
  stream.HalfClose();
  return sink->WaitForEnd();
}

void ExpectTheRestOf(const Recording& whole, size_t place, const Recording& rest) {
  ASSERT_TRUE(rest.summary) << rest.error->what();
  EXPECT_TRUE(SameDance(whole, rest));
  const size_t told = whole.beats_before[place];
  ASSERT_EQ(rest.beats.size(), whole.beats.size() - told);
  for (size_t i = 0; i < rest.beats.size(); ++i) {
    EXPECT_EQ(rest.beats[i].time_s, whole.beats[told + i].time_s);
    EXPECT_EQ(rest.beats[i].source, whole.beats[told + i].source);
    EXPECT_EQ(rest.beats[i].confidence, whole.beats[told + i].confidence);
  }
  ASSERT_EQ(rest.continuations.size(), whole.continuations.size() - place - 1);
  for (size_t i = 0; i < rest.continuations.size(); ++i) {
    const Continuation& expected = whole.continuations[place + 1 + i];
    EXPECT_EQ(rest.continuations[i].frame, expected.frame);
    EXPECT_EQ(rest.continuations[i].last_beat, expected.last_beat);
    EXPECT_EQ(rest.continuations[i].audio_from_sample, expected.audio_from_sample);
  }
}

struct Counts {
  size_t resumes = 0, heard = 0, given = 0,
         later = 0;  // later: that need not hear all of the music
};

// At each transition from `first` on.
void ResumeOften(SampleQueue& queue, uint32_t seed, Dance dance, int64_t frames, int64_t first,
                 Counts* counts) {
  std::mt19937 random(seed);
  dance.config.generate_until = 0;
  dance.config.end_frame = frames;
  const std::vector<Message> messages = RandomMessages(frames, random);
  const Recording whole = Play(queue, dance, dance.config, messages);
  ASSERT_TRUE(whole.summary) << whole.error->what();
  EXPECT_EQ(std::ranges::adjacent_find(whole.beats, std::greater_equal(), &Beat::time_s),
            whole.beats.end())
      << "told twice, seed " << seed;
  for (const Beat& beat : whole.beats)
    ++(beat.source == Beat::Source::kGiven ? counts->given : counts->heard);
  for (size_t place = 0; place + 1 < whole.continuations.size(); ++place) {
    const Continuation& continuation = whole.continuations[place];
    if (continuation.frame < first) continue;
    SCOPED_TRACE("seed " + std::to_string(seed) + " from " + std::to_string(continuation.frame));
    DanceConfig config = dance.config;
    config.continuation = continuation;
    config.audio->first_sample = *continuation.audio_from_sample;
    ExpectTheRestOf(whole, place, Play(queue, dance, config, messages));
    ++counts->resumes;
    counts->later += *continuation.audio_from_sample > 0;
  }
}

TEST(RandomResume, ContinuesBitForBitAfterRandomMessages) {
  const auto queue = QueueOf<ControlledSampler>();
  Counts counts;
  for (uint32_t seed = 1; seed <= 30; ++seed)
    ResumeOften(*queue, seed, LiveDance(seed, 15), 420, 0, &counts);
  std::cout << counts.resumes << " resumes of 30 dances with " << counts.heard
            << " beats heard and " << counts.given << " given\n";
  EXPECT_GT(counts.resumes, 300U);
  EXPECT_GT(counts.heard, 200U);
  EXPECT_GT(counts.given, 300U);
}

// Music that swells and falls silent, longer than the windows of energy and beats reach back.
TEST(RandomResume, ReceivesTheSameFeaturesOfLongMusic) {
  const auto queue = QueueOf<ControlledSampler>();
  Counts counts;
  for (uint32_t seed = 101; seed <= 104; ++seed) {
    Dance dance = LiveDance(seed, 152);
    for (size_t i = 0; i < dance.samples.size(); ++i) {
      const double swell = std::sin(0.5 * static_cast<double>(i) / 22050 + seed);
      dance.samples[i] *= static_cast<float>(std::max(0.0, 0.6 + swell));
    }
    ResumeOften(*queue, seed, std::move(dance), 4500, 4000, &counts);
  }
  std::cout << counts.resumes << " resumes, " << counts.later << " from later music\n";
  EXPECT_GT(counts.later, 30U);
  EXPECT_GT(counts.heard, 40U);
}

}  // namespace choreo::random_resume_test
