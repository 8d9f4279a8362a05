#include "client/journal.h"

#include <gtest/gtest.h>

namespace choreo::client::journal_test {

v1::StreamDanceRequest KeyAt(const std::string& id, int64_t frame) {
  v1::StreamDanceRequest request;
  request.mutable_keyframe()->set_id(id);
  request.mutable_keyframe()->set_frame(frame);
  return request;
}

v1::StreamDanceRequest Music(size_t bytes) {
  v1::StreamDanceRequest request;
  request.mutable_audio()->set_data(std::string(bytes, 'x'));
  return request;
}

int Drain(Journal* journal) {
  int taken = 0;
  while (journal->TakeNext()) ++taken;
  return taken;
}

TEST(JournalTest, SendsEverythingInOrderAndAgainAfterARewind) {
  Journal journal(4, 0);
  journal.Append(KeyAt("a", 10));
  journal.Append(Music(8));
  for (int attempt = 0; attempt < 2; ++attempt) {
    EXPECT_EQ(journal.TakeNext()->keyframe().id(), "a");
    EXPECT_EQ(journal.TakeNext()->audio().data().size(), 8U);
    EXPECT_EQ(journal.TakeNext(), nullptr);
    journal.Rewind();
  }
}

TEST(JournalTest, NumbersTheMusic) {
  Journal journal(4, 100);
  EXPECT_EQ(journal.first_sample(), 100);
  journal.Append(Music(40));
  journal.Append(Music(20));
  EXPECT_EQ(journal.TakeNext()->audio().first_sample(), 100);
  EXPECT_EQ(journal.TakeNext()->audio().first_sample(), 110);
}

TEST(JournalTest, SplitsLongMusicBetweenSamples) {
  Journal journal(12, 0);
  journal.Append(Music(300'000));
  int64_t samples = 0;
  int pieces = 0;
  for (; const Journal::Request piece = journal.TakeNext(); ++pieces) {
    EXPECT_EQ(piece->audio().first_sample(), samples);
    EXPECT_EQ(piece->audio().data().size() % 12, 0U);
    samples += static_cast<int64_t>(piece->audio().data().size()) / 12;
  }
  EXPECT_EQ(pieces, 3);
  EXPECT_EQ(samples, 25'000);
}

TEST(JournalTest, ForgetsMusicThatIsNoLongerNeededAndNothingElse) {
  Journal journal(4, 0);
  journal.Append(Music(40));  // samples 0 to 9
  journal.Append(KeyAt("a", 10));
  journal.Append(Music(40));  // 10 to 19
  journal.Append(Music(40));  // 20 to 29
  EXPECT_EQ(Drain(&journal), 4);
  journal.ForgetMusicBefore(19);
  EXPECT_EQ(journal.first_sample(), 10);
  EXPECT_EQ(journal.TakeNext(), nullptr);
  journal.Append(Music(40));
  EXPECT_EQ(journal.TakeNext()->audio().first_sample(), 30);
  journal.Rewind();
  EXPECT_EQ(Drain(&journal), 4);
}

TEST(JournalTest, KeepsUnsentMessagesAndWholeFiles) {
  Journal samples(4, 0);
  samples.Append(Music(40));
  samples.ForgetMusicBefore(1000);
  EXPECT_EQ(Drain(&samples), 1);

  Journal file(0, 0);
  file.Append(Music(4));
  file.Append(Music(4));
  EXPECT_EQ(Drain(&file), 2);
  file.ForgetMusicBefore(1000);
  file.Rewind();
  EXPECT_EQ(file.TakeNext()->audio().first_sample(), 0);
  EXPECT_EQ(file.TakeNext()->audio().first_sample(), 4);
}

}  // namespace choreo::client::journal_test
