#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <future>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "client/choreo_client.h"
#include "server/connections/listener.h"
#include "server/serve.h"
#include "tests/server/fixture.h"
#include "tests/support/certificates.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

/// How choreod stops on request, in any state.
namespace choreo::serve_test {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class ServeTest : public testing::Test {
 protected:
  // If the process never ends, the test must end nevertheless.
  ~ServeTest() override {
    if (process_ > 0) kill(process_, SIGKILL);
    if (fifo_ >= 0) close(fifo_);
  }

  // Its log goes to `reader`, a program; empty: to who waits for its end.
  void Start(const std::string& settings, const std::string& reader = "",
             const std::string& listen = "127.0.0.1:0") {
    ended_ = std::async(std::launch::async, [=, this] {
      // The program has the number that its shell had, behind a pipe, too.
      return Shell("{ sh -c 'echo $$ > \"$0\"; exec \"$@\"' '" + (folder_ / "process").string() +
                   "' " + starter_ + FAKE_CHOREOD " --listen " + listen + " --log-format json " +
                   settings + " > '" + (folder_ / "said").string() + "'; }" +
                   (reader.empty() ? "" : " 2>&1 | " + reader));
    });
  }
  void AwaitListening() {
    ExpectEventually([this] { return Read("said").ends_with('\n'); }, "it listens");
  }
  std::string address() const {
    const std::string line = nlohmann::json::parse(Read("said")).at("message");
    return line.substr(line.rfind(' ') + 1);
  }
  // A checkpoint whose loading lasts as long as this test, once AwaitLoading has returned.
  void WriteSlow(const std::string& name) {
    ASSERT_EQ(mkfifo((folder_ / "fifo").c_str(), 0600), 0);
    std::ofstream(folder_ / "written") << (folder_ / "fifo").string();
    std::filesystem::rename(folder_ / "written", folder_ / name);
  }
  void AwaitLoading() {
    const auto opens = [this] {  // fails until somebody reads
      fifo_ = open((folder_ / "fifo").c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
      return fifo_ >= 0;
    };
    ExpectEventually(opens, "the checkpoint is loaded");
  }
  void Send(int signal) {
    process_ = std::stoi(Read("process"));
    kill(process_, signal);
  }
  Outcome End() {
    using namespace std::chrono_literals;
    const auto begin = std::chrono::steady_clock::now();
    if (ended_.wait_for(30s) != std::future_status::ready) {
      ADD_FAILURE() << "it does not leave";
      kill(std::stoi(Read("process")), SIGKILL);
    }
    process_ = -1;
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    std::cout << "left after " << took.count() << " s\n";
    return ended_.get();
  }

  std::string Read(const std::string& name) const {
    std::ostringstream content;
    content << std::ifstream(folder_ / name).rdbuf();
    return content.str();
  }

  TemporaryFolder folder_;
  std::string starter_;  // what runs the program

 private:
  pid_t process_ = -1;
  int fifo_ = -1;
  std::future<Outcome> ended_;
};

TEST_F(ServeTest, StopsWhileLoadingItsFirstModel) {
  for (const int signal : {SIGTERM, SIGINT}) {
    SCOPED_TRACE(strsignal(signal));
    std::filesystem::remove(folder_ / "fifo");
    WriteSlow("slow");
    Start("--checkpoint '" + (folder_ / "slow").string() + "'");
    AwaitLoading();
    Send(signal);
    const Outcome outcome = End();
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr("exits immediately"));
  }
}

TEST_F(ServeTest, StopsWhileLoadingAnotherModel) {
  std::filesystem::create_directory(folder_ / "models");
  std::ofstream(folder_ / "models/a.safetensors").flush();
  Start("--drain-seconds 1 --models '" + (folder_ / "models").string() + "'");
  AwaitListening();
  WriteSlow("models/b.safetensors");
  Send(SIGHUP);
  AwaitLoading();
  // Dances in progress may continue.
  const client::Client client({.addresses = {address()}});
  const auto dance = client.StartDance({.frames = 30, .generate_until = 0});
  dance->GenerateUntil(10);
  ASSERT_TRUE(dance->Next());
  Send(SIGTERM);
  const Outcome outcome = End();
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("served 1 call"));
}

// Scripts send the signal to several servers.
TEST_F(ServeTest, OutlivesSighupWithoutAFolder) {
  Start("");
  AwaitListening();
  Send(SIGHUP);
  const client::Client client({.addresses = {address()}});
  EXPECT_EQ(client.Dance({.frames = 20}, {}, {}).motion.frames.size(), 20U);
  Send(SIGTERM);
  const Outcome outcome = End();
  EXPECT_THAT(outcome.said,
              HasSubstr("settings: none has changed; without --config there is no file"));
  EXPECT_THAT(outcome.said, HasSubstr("served 1 call"));
}

TEST_F(ServeTest, RereadsItsSettingsOnSighup) {
  const std::string file = (folder_ / "choreod.toml").string();
  std::ofstream(file) << "max-streams = 5\n";
  Start("--first-message-seconds 9 --config '" + file + "'",
        "tee '" + (folder_ / "log").string() + "'");
  AwaitListening();
  const client::Client client({.addresses = {address()}});
  const auto limit = [&] { return client.GetServerInfo().limits.max_streams; };
  EXPECT_EQ(limit(), 5);
  std::ofstream(file) << "max-streams = 7\nio-threads = 3\nlog-level = \"debug\"\n"
                      << "first-message-seconds = 8\n";
  Send(SIGHUP);
  ExpectEventually([&] { return limit() == 7; }, "the new limit is in use");
  // Nobody writes to it.
  std::filesystem::rename(file, file + ".former");
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  Send(SIGHUP);
  ExpectEventually([&] { return Read("log").find("is a FIFO") != std::string::npos; },
                   "it is not waited for");
  std::filesystem::rename(file + ".former", file);
  std::ofstream(file) << "max-streams = -1\n";
  Send(SIGHUP);
  ExpectEventually([&] { return Read("log").find("stay as they were") != std::string::npos; },
                   "the bad setting is refused");
  EXPECT_EQ(limit(), 7);
  Send(SIGTERM);
  const Outcome outcome = End();
  EXPECT_THAT(outcome.said, HasSubstr("settings: max-streams is 7, was 5"));
  EXPECT_THAT(outcome.said,
              HasSubstr("settings: io-threads is 3, was the default; that needs a restart"));
  EXPECT_THAT(outcome.said,
              HasSubstr("settings: the flag --first-message-seconds overrides the file's line"));
  EXPECT_THAT(outcome.said, HasSubstr(file + ":1: --max-streams: -1 is not in"));
}

TEST_F(ServeTest, FindsATakenAddressBeforeLoadingModels) {
  const Listener other("127.0.0.1:0");
  const std::string taken = "127.0.0.1:" + std::to_string(other.port());
  WriteSlow("slow");
  const std::string slow = "--checkpoint '" + (folder_ / "slow").string() + "'";
  Start(slow, "", taken);
  Outcome outcome = End();
  EXPECT_EQ(outcome.code, 1) << "it may become free";
  EXPECT_THAT(outcome.said, HasSubstr("--listen: "));
  EXPECT_THAT(outcome.said, HasSubstr(taken));
  Start(slow + " --metrics " + taken);
  outcome = End();
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("--metrics: "));
}

// No restart mends it.
TEST_F(ServeTest, AnAddressOfNobodyOrOfAnotherMachineIsMisuse) {
  for (const std::string wrong : {"no+host:0", "203.0.113.7:0"}) {
    for (const std::string& settings :
         {" --insecure --listen " + wrong, " --listen 127.0.0.1:0 --metrics " + wrong}) {
      for (const std::string way : {"", " --check"}) {
        const Outcome outcome = Shell("timeout 20 " FAKE_CHOREOD + way + settings);
        EXPECT_EQ(outcome.code, 2) << outcome.said;
        EXPECT_THAT(outcome.said, HasSubstr('"' + wrong + "\" cannot be listened on"));
      }
    }
  }
}

TEST_F(ServeTest, FindsBadSecretsBeforeLoadingModels) {
  WriteSlow("slow");
  const std::string file = (folder_ / "file").string();
  std::ofstream(file) << "no hash";
  for (const std::string& settings :
       {" --tokens '" + file + "'", " --tls-cert '" + file + "' --tls-key '" + file + "'"}) {
    Start("--checkpoint '" + (folder_ / "slow").string() + "'" + settings);
    const Outcome outcome = End();
    EXPECT_EQ(outcome.code, 2) << "no restart mends it";
    EXPECT_THAT(outcome.said, HasSubstr(file));
  }
}

// The address is in use by the running server.
TEST_F(ServeTest, AFileIsCheckedBeforeARestart) {
  const Listener running("127.0.0.1:0");
  const std::string file = (folder_ / "choreod.toml").string(),
                    tokens = (folder_ / "tokens").string(), models = (folder_ / "models").string();
  std::filesystem::create_directory(models);
  std::ofstream(models + "/a.safetensors").flush();
  std::ofstream(tokens) << std::string(64, 'a') << " alice\n";
  std::ofstream(file) << "listen = \"127.0.0.1:" << running.port() << "\"\nmodels = \"" << models
                      << "\"\ntokens = \"" << tokens << "\"\n";
  const auto check = [&](const std::string& more = "") {
    return Shell(FAKE_CHOREOD " --check --config '" + file + "'" + more);
  };
  const Outcome good = check();
  EXPECT_EQ(good.code, 0) << good.said;
  EXPECT_TRUE(good.said.ends_with("ok\n")) << good.said;
  std::ofstream(tokens) << "no hash";
  std::filesystem::remove(models + "/a.safetensors");
  const Outcome both = check();
  EXPECT_EQ(both.code, 2) << both.said;
  EXPECT_THAT(both.said, AllOf(HasSubstr(tokens + " line 1"), HasSubstr("--models: " + models)));
  for (const auto& [more, fault] : {std::pair<std::string, std::string>{"", tokens + " line 1"},
                                    {" --tokens ''", "--tokens: is empty"},
                                    {" --workers -1", "--workers: -1 is not in"}}) {
    const Outcome bad = check(more);
    EXPECT_EQ(bad.code, 2) << bad.said;
    EXPECT_THAT(bad.said, HasSubstr(fault));
  }
  std::ofstream(tokens) << std::string(64, 'a') << " alice\n";
  const Outcome empty = check();
  EXPECT_EQ(empty.code, 2) << empty.said;
  EXPECT_THAT(empty.said, HasSubstr("--models: " + models));
}

// A server starts with it, too, and a reload of other settings does not wait for its renewal.
TEST_F(ServeTest, AnExpiredFileIsToldByTheCheck) {
  const Authority authority(folder_.path(), "authority");
  const Certificate own = authority.Issue("own"), late = authority.IssueExpired("late");
  const auto check = [](const Certificate& shown, const std::filesystem::path& client_ca) {
    return Shell(FAKE_CHOREOD " --check --tls-cert '" + shown.certificate.string() +
                 "' --tls-key '" + shown.key.string() + "' --tls-client-ca '" + client_ca.string() +
                 "'");
  };
  const Outcome good = check(own, authority.certificate());
  EXPECT_EQ(good.code, 0) << good.said;
  EXPECT_THAT(good.said, Not(HasSubstr("expired")));
  const Outcome bad = check(late, late.certificate);
  EXPECT_EQ(bad.code, 0) << bad.said;
  EXPECT_THAT(bad.said, AllOf(HasSubstr("--tls-cert: expired on 20"),
                              HasSubstr("--tls-client-ca: expired on 20")));
  EXPECT_TRUE(bad.said.ends_with("ok\n")) << bad.said;
}

TEST_F(ServeTest, ABadFolderOfModelsIsMisuse) {
  std::filesystem::create_directory(folder_ / "empty");
  for (const char* folder : {"absent", "empty"}) {
    Start("--models '" + (folder_ / folder).string() + "'");
    const Outcome outcome = End();
    EXPECT_EQ(outcome.code, 2) << outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr("--models: " + (folder_ / folder).string()));
  }
}

TEST_F(ServeTest, CountsAllRefusals) {
  const std::string tokens = (folder_ / "tokens").string(), token = (folder_ / "token").string();
  std::ofstream(tokens) << "ca978112ca1bbdcafac231b39a23dc4da786eff8147c4e72b9807785afee48bb alice";
  std::ofstream(token) << "a";
  Start("--tokens '" + tokens + "'");
  AwaitListening();
  const client::Client client({.addresses = {address()}, .token_file = token, .retry_s = 0});
  client.GetServerInfo();
  client.GenerateTransition({.frames = 5});
  const client::Client stranger({.addresses = {address()}, .retry_s = 0});
  EXPECT_THROW(stranger.GenerateTransition({.frames = 5}), Error);
  EXPECT_THROW(stranger.GetServerInfo(), Error);
  Send(SIGTERM);
  EXPECT_THAT(End().said, HasSubstr("served 1 call (2 refused) with 5 frames"));
}

// Else a client's connection gets the number of a closed stream, and the log with it.
TEST(StandardStreamsTest, AreOpenedIfTheyAreClosed) {
  const pid_t child = fork();
  if (child == 0) {
    using Stat = struct stat;
    Stat null{}, stream{};
    for (int fd = 0; fd <= STDERR_FILENO; ++fd) close(fd);
    OpenStandardStreams();
    bool good = stat("/dev/null", &null) == 0;
    for (int fd = 0; fd <= STDERR_FILENO; ++fd)
      good &= fstat(fd, &stream) == 0 && stream.st_rdev == null.st_rdev;
    _exit(good ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST_F(ServeTest, StopsAtOnceWhenSignalledTwice) {
  Start("--drain-seconds 3600");
  AwaitListening();
  const client::Client client({.addresses = {address()}});
  const auto dance = client.StartDance({.frames = 30, .generate_until = 0});
  dance->GenerateUntil(10);
  ASSERT_TRUE(dance->Next());
  Send(SIGTERM);
  ExpectEventually([&] { return !client.IsServing(); }, "it drains");
  Send(SIGHUP);
  Send(SIGTERM);
  const Outcome outcome = End();
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("exits immediately"));
  EXPECT_THAT(outcome.said, HasSubstr("nothing is read again while the server drains"));
  // The interrupted call is logged nevertheless.
  EXPECT_THAT(outcome.said,
              ContainsRegex("\"method\":\"StreamDance\".*\"status\":\"UNAVAILABLE\""));
  EXPECT_THAT(outcome.said, HasSubstr("the server was told to exit immediately"));
}

// A stranger's calls, or other programs, may take the last thread that the system allows.
TEST_F(ServeTest, DrainsWithoutAnotherThread) {
  // Root has no limit. Where the program lies, others may not read.
  if (geteuid() == 0)
    starter_ =
        "setpriv --reuid=64123 --clear-groups --inh-caps=+dac_override "
        "--ambient-caps=+dac_override ";
  Start("--drain-seconds 60");
  AwaitListening();
  const client::Client client({.addresses = {address()}, .retry_s = 0});
  const auto dance = client.StartDance({.frames = 30, .generate_until = 0});
  dance->GenerateUntil(10);
  ASSERT_TRUE(dance->Next());
  const Outcome limited = Shell(starter_ + "prlimit --nproc=1:1 --pid " + Read("process"));
  ASSERT_EQ(limited.code, 0) << limited.said;
  Send(SIGTERM);
  ExpectEventually([&] { return !client.IsServing(); }, "it drains");
  dance->CompleteKeys();
  while (dance->Next()) continue;
  const Outcome outcome = End();
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("served 1 call"));
}

/// The part of systemd that receives a service's notifications.
class Manager {
 public:
  explicit Manager(const std::filesystem::path& path) {
    sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
    std::ranges::copy(path.string(), address.sun_path);
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    const timeval patience{.tv_sec = 10, .tv_usec = 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    setenv("NOTIFY_SOCKET", path.c_str(), 1);
  }
  Manager(const Manager&) = delete;
  Manager& operator=(const Manager&) = delete;
  ~Manager() {
    unsetenv("NOTIFY_SOCKET");
    close(socket_);
  }

  /// Returns the next message, or "" after ten seconds without one.
  std::string Hear() const {
    char text[1024];
    const ssize_t size = recv(socket_, text, sizeof text, 0);
    return std::string(text, static_cast<size_t>(std::max<ssize_t>(size, 0)));
  }

 private:
  const int socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
};

// systemd's Type=notify: units that depend on choreod start once it serves.
TEST_F(ServeTest, TellsItsManagerHowFarItIs) {
  const Manager manager(folder_ / "notify");
  std::filesystem::create_directory(folder_ / "models");
  std::ofstream(folder_ / "models/a.safetensors").flush();
  const std::string file = (folder_ / "choreod.toml").string();
  std::ofstream(file) << "drain-seconds = 1\n";
  Start("--config '" + file + "' --models '" + (folder_ / "models").string() + "'");
  EXPECT_THAT(manager.Hear(), testing::StartsWith("READY=1\nSTATUS=choreod listens on 127.0.0.1:"));
  AwaitListening();
  Send(SIGHUP);
  EXPECT_THAT(manager.Hear(), ContainsRegex("^RELOADING=1\nMONOTONIC_USEC=[0-9]+$"));
  EXPECT_THAT(manager.Hear(), testing::StartsWith("READY=1\nSTATUS=choreod listens on 127.0.0.1:"));
  std::ofstream(file) << "drain-seconds = -1\n";
  Send(SIGHUP);
  EXPECT_THAT(manager.Hear(), testing::StartsWith("RELOADING=1\n"));
  EXPECT_THAT(manager.Hear(),
              testing::StartsWith("READY=1\nSTATUS=" + file + ":1: --drain-seconds"));
  Send(SIGTERM);
  EXPECT_EQ(manager.Hear(),
            "STOPPING=1\nSTATUS=drains for up to 1 s\nEXTEND_TIMEOUT_USEC=31000000");
  EXPECT_EQ(End().code, 0);
}

// systemd's WatchdogSec=: a service that is silent for that long is restarted.
TEST_F(ServeTest, TellsItsManagerThatItLives) {
  const Manager manager(folder_ / "notify");
  setenv("WATCHDOG_USEC", "400000", 1);
  Start("--drain-seconds 1");
  int alive = 0;
  for (int i = 0; i < 4; ++i) alive += manager.Hear() == "WATCHDOG=1" ? 1 : 0;  // and READY=1
  unsetenv("WATCHDOG_USEC");
  EXPECT_EQ(alive, 3);
  AwaitListening();
  Send(SIGTERM);
  EXPECT_EQ(End().code, 0);
}

TEST_F(ServeTest, ContinuesWithoutALogReader) {
  Start("", "head -1");
  AwaitListening();
  const client::Client client({.addresses = {address()}});
  for (int i = 0; i < 3; ++i) {  // each leaves a line
    EXPECT_EQ(client.Dance({.frames = 20}, {}, {}).motion.frames.size(), 20U);
  }
  Send(SIGTERM);
  EXPECT_THAT(End().said, testing::Not(HasSubstr("StreamDance")));
}

}  // namespace choreo::serve_test
