#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "client/authoring/keys/pose_library.h"
#include "client/authoring/local_server.h"
#include "client/choreo_client.h"
#include "tests/client/test_music.h"
#include "tests/client/test_server.h"
#include "tests/support/eventually.h"
#include "tests/support/sanitizers.h"

/// What happens when processes are killed in the middle of a dance.
namespace choreo::client::kill_test {

using authoring::LocalServer;

/// Identical servers, each a process of its own.
class Servers {
 public:
  Servers(const std::filesystem::path& program, int count) {
    for (int i = 0; i < count; ++i) running_.push_back(std::make_unique<LocalServer>(program));
    for (const auto& server : running_) addresses_.push_back(server->address());
  }

  /// Options for a client of all servers, including killed ones.
  Options Patient() const {
    Options options;
    options.addresses = addresses_;
    options.first_backoff_s = 0.01;
    options.retry_s = 250;  // however slow the machine is
    options.silence_s = 0;
    return options;
  }

  /// Kills the one that dances, at once, without a word to its clients. It need not be the first:
  /// one that refused, because the machine was busy, was left for the next. False if none dances,
  /// because the client has not noticed yet that it lost the last one.
  bool KillDancing() {
    const auto dancing = std::ranges::find_if(running_, [&](const auto& server) {
      Options options = Patient();
      options.addresses = {server->address()};
      return Client(options).GetServerInfo().active_streams > 0;
    });
    if (dancing == running_.end()) return false;
    ::kill((*dancing)->process(), SIGKILL);
    running_.erase(dancing);  // returns when the process is gone, and its port is free
    return true;
  }

 private:
  std::vector<std::unique_ptr<LocalServer>> running_;
  std::vector<std::string> addresses_;
};

struct Danced {
  Motion motion;
  std::vector<std::string> reached;
  int resumes = 0;
  Report report;
};

/// Eight seconds to music that comes half a second at a time, each when all frames of the one
/// before have come: the server never has enough music to be further ahead. `before_frame` gets the
/// number of frames so far.
Danced DanceLive(const Client& client, bool with_keys,
                 const std::function<void(int64_t)>& before_frame) {
  constexpr int64_t kPiece = 22050 / 2;
  const Audio audio = ClicksAudio(8);
  const auto dance = client.StartDance({.seed = 9, .audio = audio.format});
  if (with_keys) {
    for (const auto& [id, frame] : {std::pair("kick", 50), {"groove", 110}, {"arabesque", 200}}) {
      KeyPose key;
      key.id = id;
      key.frame = frame;
      key.pose = authoring::FindLibraryPose(id).pose;
      dance->SendKey(key);
    }
  }
  dance->CompleteKeys();
  Danced danced;
  int latency = 0;
  const auto read = [&](int64_t frames) {
    while (static_cast<int64_t>(danced.motion.frames.size()) < frames) {
      before_frame(static_cast<int64_t>(danced.motion.frames.size()));
      const std::optional<Message> message = dance->Next();
      if (!message) return;
      if (const auto* header = std::get_if<Header>(&*message)) {
        latency = header->latency_frames;
      } else if (const auto* block = std::get_if<FrameBlock>(&*message)) {
        danced.motion.frames.insert(danced.motion.frames.end(), block->poses.begin(),
                                    block->poses.end());
      } else if (const auto* key = std::get_if<KeyReached>(&*message)) {
        danced.reached.push_back(key->id);
      } else if (std::holds_alternative<Resumed>(*message)) {
        ++danced.resumes;
      } else if (const auto* report = std::get_if<Report>(&*message)) {
        danced.report = *report;
      }
    }
  };
  const auto total = static_cast<int64_t>(audio.samples.size());
  for (int64_t at = 0; at < total; at += kPiece) {
    const int64_t end = std::min(at + kPiece, total);
    dance->SendSamples(
        std::span(audio.samples).subspan(static_cast<size_t>(at), static_cast<size_t>(end - at)));
    read(end / 735 - std::max(2, latency));
  }
  dance->EndAudio();
  read(std::numeric_limits<int64_t>::max());
  return danced;
}

void ExpectSame(const Danced& a, const Danced& b) {
  ASSERT_EQ(a.motion.frames.size(), b.motion.frames.size());
  for (size_t i = 0; i < a.motion.frames.size(); ++i) {
    ASSERT_EQ(a.motion.frames[i].root_position, b.motion.frames[i].root_position) << i;
    ASSERT_EQ(a.motion.frames[i].rotations, b.motion.frames[i].rotations) << i;
  }
  EXPECT_EQ(a.reached, b.reached);
  EXPECT_EQ(a.report.keys.size(), b.report.keys.size());
}

struct Killings {
  bool with_keys;
  uint32_t seed;
};
void PrintTo(const Killings& killings, std::ostream* out) {
  *out << (killings.with_keys ? "keys" : "music_only") << killings.seed;
}

class KillTest : public testing::TestWithParam<Killings> {};

// Kills two of three replicas, each while it is dancing, at random frames.
TEST_P(KillTest, TheDanceIsTheSameToTheBit) {
  const std::filesystem::path program = FAKE_CHOREOD;
  const bool with_keys = GetParam().with_keys;
  const Danced wanted = DanceLive(Client(Servers(program, 1).Patient()), with_keys, [](int64_t) {});
  ASSERT_EQ(wanted.motion.frames.size(), 240U);
  ASSERT_EQ(wanted.reached.size(), with_keys ? 3U : 0U);

  std::mt19937 random(GetParam().seed);
  const auto first = static_cast<int64_t>(random() % 120);
  const auto second = first + 1 + static_cast<int64_t>(random() % 110);
  SCOPED_TRACE("killed at frames " + std::to_string(first) + " and " + std::to_string(second));
  Servers servers(program, 3);
  int killed = 0;
  const Danced danced = DanceLive(Client(servers.Patient()), with_keys, [&](int64_t frames) {
    if (killed < 2 && frames >= (killed == 0 ? first : second)) killed += servers.KillDancing();
  });
  ExpectSame(danced, wanted);
  EXPECT_EQ(killed, 2);
  EXPECT_GE(danced.resumes, 1);
}

INSTANTIATE_TEST_SUITE_P(AtRandom, KillTest,
                         testing::Values(Killings{true, 1}, Killings{true, 2}, Killings{true, 3},
                                         Killings{false, 1}, Killings{false, 2},
                                         Killings{false, 3}),
                         [](const auto& suite) { return testing::PrintToString(suite.param); });

/// Eight seconds of music, granted a third of a second ahead of what plays. Each pose comes three
/// seconds before its time, and is another one a second before: then most of the way to it is still
/// to be danced. `before_piece` is called each tenth of a second.
Danced DanceEdited(const Client& client, const std::function<void(int)>& before_piece) {
  const Audio audio = ClicksAudio(8);
  const auto dance =
      client.StartDance({.seed = 9, .audio = audio.format, .frames = 240, .generate_until = 0});
  Danced danced;
  const auto take = [&](const Message& message) {
    if (const auto* block = std::get_if<FrameBlock>(&message)) {
      danced.motion.frames.insert(danced.motion.frames.end(), block->poses.begin(),
                                  block->poses.end());
    } else if (const auto* key = std::get_if<KeyReached>(&message)) {
      danced.reached.push_back(key->id);
    } else if (std::holds_alternative<Resumed>(message)) {
      ++danced.resumes;
    } else if (const auto* report = std::get_if<Report>(&message)) {
      danced.report = *report;
    }
  };
  const auto send = [&](int second, const char* pose) {
    KeyPose key;
    key.id = std::to_string(second);
    key.frame = 30 * second;
    key.pose = authoring::FindLibraryPose(pose).pose;
    dance->SendKey(key);
  };
  constexpr int64_t kPiece = 2205;
  for (int piece = 0; piece < 80; ++piece) {
    before_piece(piece);
    if (piece % 20 == 0 && piece < 60) send(piece / 10 + 3, "kick");
    if (piece % 20 == 0 && piece > 0) send(piece / 10 + 1, "arabesque");
    dance->GenerateUntil(std::min(240, 3 * piece + 10));
    dance->SendSamples(
        std::span(audio.samples).subspan(static_cast<size_t>(piece * kPiece), kPiece));
    // Wait for all possible frames before sending more.
    while (static_cast<int64_t>(danced.motion.frames.size()) < 3 * piece - 3) {
      const std::optional<Message> message = dance->Next();
      if (!message) break;
      take(*message);
    }
  }
  dance->EndAudio();
  dance->CompleteKeys();
  while (const std::optional<Message> message = dance->Next()) take(*message);
  return danced;
}

// The same in a transition to a key that has just been changed.
TEST(KillTest, EditsWithShortLookAheadSurvive) {
  const std::filesystem::path program = FAKE_CHOREOD;
  const Danced wanted = DanceEdited(Client(Servers(program, 1).Patient()), [](int) {});
  ASSERT_EQ(wanted.motion.frames.size(), 240U);
  EXPECT_EQ(wanted.reached, (std::vector<std::string>{"3", "5", "7"}));
  Servers servers(program, 3);
  const Danced danced = DanceEdited(Client(servers.Patient()), [&](int piece) {
    if (piece != 23 && piece != 58) return;
    EXPECT_TRUE(servers.KillDancing());
  });
  ExpectSame(danced, wanted);
  EXPECT_EQ(danced.resumes, 2);
}

// With one address, a restarted server knows nothing of the dance.
TEST(KillTest, RestartedServerResumes) {
  const std::filesystem::path program = FAKE_CHOREOD;
  Servers servers(program, 1);
  const Options options = servers.Patient();
  const Client client(options);
  const Danced wanted = DanceLive(client, true, [](int64_t) {});
  std::optional<LocalServer> restarted;
  const Danced danced = DanceLive(client, true, [&](int64_t frames) {
    if (restarted || frames < 100 || !servers.KillDancing()) return;
    restarted.emplace(program, options.addresses[0]);
  });
  ExpectSame(danced, wanted);
  EXPECT_EQ(danced.resumes, 1);
}

// choreod itself, with the shipped model.
TEST(KillTest, ShippedModelResumesBitForBit) {
  if (kSanitized) GTEST_SKIP() << "choreod runs LibTorch";
  const std::filesystem::path program = CHOREOD_PROGRAM;
  Servers servers(program, 2);
  const Client client(servers.Patient());
  const Danced wanted = DanceLive(client, true, [](int64_t) {});
  bool killed = false;
  const Danced danced = DanceLive(client, true, [&](int64_t frames) {
    if (!killed && frames >= 77) killed = servers.KillDancing();
  });
  ExpectSame(danced, wanted);
  EXPECT_EQ(danced.resumes, 1);
}

// Here the client's process is killed while it is served.
TEST(KillTest, KilledClientFreesItsPlaces) {
  TestServer server;
  std::vector<std::string> arguments = {
      CHOREO_PROGRAM, "transition",    "--from",       "groove",
      "--to",         "kick",          "--out",        testing::TempDir() + "choreo.killed.npz",
      "--frames",     "1800",          "--candidates", "32",
      "--server",     server.address()};
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  pid_t process = 0;
  ASSERT_EQ(posix_spawn(&process, CHOREO_PROGRAM, nullptr, nullptr, pointers.data(), environ), 0);
  const bool served = Eventually([&] { return server.transitions() > 0; });
  ::kill(process, SIGKILL);
  ::waitpid(process, nullptr, 0);
  EXPECT_TRUE(served);
  EXPECT_TRUE(Eventually([&] { return server.calls() == 0 && server.transitions() == 0; }));
  EXPECT_EQ(Client({.addresses = {server.address()}}).Dance({.frames = 30}, {}, {}).report.frames,
            30);
}

}  // namespace choreo::client::kill_test
