#include "model/dance/delivery/mailbox.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <future>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace choreo::mailbox_test {

using testing::ElementsAre;
using testing::IsEmpty;

struct Listener {
  void OnError(const Error& error) { heard.push_back("error: " + std::string(error.what())); }

  std::vector<std::string> heard;
  std::vector<std::thread::id> callers;
};

class MailboxTest : public testing::Test {
 protected:
  static Mailbox<Listener>::Call Say(const std::string& word) {
    return [word](Listener& heard) {
      heard.heard.push_back(word);
      heard.callers.push_back(std::this_thread::get_id());
    };
  }
  /// A thread within a call, which continues when `gate` opens.
  std::thread Enter() {
    mailbox.Post([this](Listener&) {
      entered.set_value();
      gate.get_future().wait();
    });
    std::thread thread([this] { mailbox.Deliver(); });
    entered.get_future().wait();
    return thread;
  }

  const std::shared_ptr<Listener> listener = std::make_shared<Listener>();
  Mailbox<Listener> mailbox{listener};
  std::promise<void> entered, gate;
};

const std::string kGaveUp = "error: the dance cannot continue; the server may be out of memory";

TEST_F(MailboxTest, OneThreadMakesAllCallsInTheOrderOfPosts) {
  std::thread first = Enter();
  const std::thread::id id = first.get_id();
  for (const char* word : {"a", "b"}) {
    mailbox.Post(Say(word));
    mailbox.Deliver();
  }
  EXPECT_THAT(listener->heard, IsEmpty()) << "the other thread is in a call";
  mailbox.Post(Say("c"));  // and nobody delivers it but that thread
  gate.set_value();
  first.join();
  EXPECT_THAT(listener->heard, ElementsAre("a", "b", "c"));
  EXPECT_THAT(listener->callers, ElementsAre(id, id, id));
}

TEST_F(MailboxTest, AListenerMayCallBack) {
  mailbox.Post([this](Listener& heard) {
    mailbox.Post(Say("inner"));
    mailbox.Deliver();
    heard.heard.push_back("outer");
  });
  mailbox.Post(Say("next"));
  mailbox.Deliver();
  EXPECT_THAT(listener->heard, ElementsAre("outer", "next", "inner"));
}

TEST_F(MailboxTest, NothingFollowsTheLastCall) {
  mailbox.Post(Say("a"));
  EXPECT_FALSE(mailbox.over());
  mailbox.PostLast(Say("last"));
  EXPECT_TRUE(mailbox.over());
  mailbox.Post(Say("late"));
  mailbox.PostError(Error(ErrorCode::kCancelled, "", "late"));
  mailbox.Deliver();
  EXPECT_THAT(listener->heard, ElementsAre("a", "last"));
}

TEST_F(MailboxTest, WhatACallThrowsPassesAndTheOthersWait) {
  mailbox.Post([](Listener&) { throw std::runtime_error("a call"); });
  mailbox.Post(Say("b"));
  EXPECT_THROW(mailbox.Deliver(), std::runtime_error);
  EXPECT_THAT(listener->heard, IsEmpty());
  mailbox.Deliver();
  EXPECT_THAT(listener->heard, ElementsAre("b"));
}

TEST_F(MailboxTest, GivingUpDropsWhatWaits) {
  mailbox.Post(Say("a"));
  mailbox.GiveUp();
  EXPECT_TRUE(mailbox.over());
  mailbox.Post(Say("late"));
  mailbox.GiveUp();
  EXPECT_THAT(listener->heard, ElementsAre(kGaveUp)) << "once, and nothing else";
}

TEST_F(MailboxTest, GivingUpDoesNotWaitForACall) {
  std::thread first = Enter();
  mailbox.Post(Say("a"));
  mailbox.GiveUp();
  EXPECT_THAT(listener->heard, IsEmpty()) << "calls never overlap";
  gate.set_value();
  first.join();
  EXPECT_THAT(listener->heard, ElementsAre(kGaveUp));
}

}  // namespace choreo::mailbox_test
