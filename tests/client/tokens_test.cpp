#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>
#include <optional>
#include <utility>
#include <variant>

#include "server/settings/tokens.h"
#include "tests/client/security_fixture.h"
#include "tests/support/expect_error.h"
#include "tests/support/shell.h"

/// Whose calls are served.
namespace choreo::client::tokens_test {

using testing::HasSubstr;
using testing::Not;

class TokensTest : public SecurityTest {
 protected:
  void Write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  // The token's line in the server's file.
  std::string LineOf(const std::string& token, const std::string& holder) {
    Write("plain", token);
    const std::string hash = Shell("sha256sum " + (folder_ / "plain").string()).said.substr(0, 64);
    return hash + "  " + holder + '\n';
  }
  Options With(const TestServer& server, const std::string& token) {
    Options options{.addresses = {server.address()}, .retry_s = 0};
    if (token.empty()) return options;
    Write("token", token + '\n');
    options.token_file = folder_ / "token";
    return options;
  }
};

TEST_F(TokensTest, HoldersAreServedUntilRemoval) {
  const std::filesystem::path file = folder_ / "tokens";
  Write("tokens", "# who may call\n\n" + LineOf("correct-horse", "alice") + LineOf("b", "bob"));
  const auto server = Start([&](ServerConfig& config) { config.tokens = file; });
  EXPECT_EQ(Client(With(*server, "correct-horse")).Dance({.frames = 20}, {}, {}).report.frames, 20);
  EXPECT_TRUE(Serves(With(*server, "b")));

  for (const std::string wrong : {"", "correct-hors", "correct-horsf", "alice"}) {
    const Client client(With(*server, wrong));
    for (const std::function<void()>& call : std::vector<std::function<void()>>{
             [&] { client.GetServerInfo(); },
             [&] { client.Dance({.frames = 20}, {}, {}); },
             [&] { client.GenerateTransition({.frames = 5}); },
         }) {
      ExpectError(ErrorCode::kFailedPrecondition, "authorization: Bearer TOKEN", call);
    }
  }
  EXPECT_TRUE(Client(With(*server, "")).IsServing());  // probes have none

  Write("tokens", LineOf("b", "bob"));
  ExpectEventually([&] { return !Serves(With(*server, "correct-horse")); }, "alice is struck out");
  EXPECT_TRUE(Serves(With(*server, "b")));
}

TEST_F(TokensTest, ADanceGoesOnWithARenewedToken) {
  Write("tokens", LineOf("old", "alice") + LineOf("new", "alice"));
  const auto server = Start([&](ServerConfig& config) { config.tokens = folder_ / "tokens"; });
  Options options = With(*server, "old");
  options.retry_s = 20;
  const Client client(options);
  const auto dance = client.StartDance({.seed = 4, .frames = 250});
  dance->GenerateUntil(120);
  size_t frames = 0;
  int resumed = 0;
  bool renewed = false;
  while (const std::optional<Message> message = dance->Next()) {
    if (const auto* block = std::get_if<FrameBlock>(&*message)) frames += block->poses.size();
    if (std::holds_alternative<Continuation>(*message) && !std::exchange(renewed, true)) {
      Write("token", "new\n");
      Write("tokens", LineOf("new", "alice"));
    }
    if (!std::holds_alternative<Resumed>(*message)) continue;
    ++resumed;
    dance->CompleteKeys();
  }
  EXPECT_EQ(frames, 250U);
  EXPECT_EQ(resumed, 1);
}

// Removed holders stay refused, whatever happens to the file.
TEST_F(TokensTest, BrokenFileAdmitsNobody) {
  const std::filesystem::path file = folder_ / "tokens";
  const std::string alice = LineOf("a", "alice"), bob = LineOf("b", "bob");
  Write("tokens", alice + bob);
  const auto server = Start([&](ServerConfig& config) { config.tokens = file; });
  const auto becomes = [&](const std::string& token, bool serves, const std::string& what) {
    ExpectEventually([&] { return Serves(With(*server, token)) == serves; }, what);
  };
  becomes("a", true, "both are known");
  Write("tokens", "0123 carol\n" + bob);  // good lines count beside a bad one
  becomes("a", false, "alice is struck out");
  EXPECT_TRUE(Serves(With(*server, "b")));
  std::filesystem::remove(file);
  becomes("b", false, "without a file nobody is known");
  Write("tokens", alice);
  becomes("a", true, "it is there again");
  std::filesystem::remove(file);
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  becomes("a", false, "a FIFO holds nobody up, and lets nobody in");
  std::filesystem::remove(file);
  Write("tokens", bob);
  becomes("b", true, "after which it goes on");
  Write("tokens", std::string(2 << 20, '#'));
  becomes("b", false, "what is too long is not read");
}

// A writer may have failed, or the disk was full.
TEST_F(TokensTest, AnEmptiedFileKeepsTheFormerTokens) {
  const LogCapture log;
  const std::string alice = LineOf("a", "alice");
  Write("tokens", alice);
  Tokens tokens(folder_ / "tokens");
  std::string holder;
  for (const char* empty : {"", "\n", "# nobody\n"}) {
    Write("tokens", empty);
    EXPECT_EQ(tokens.Refresh(), std::nullopt) << "it may just be written";
    EXPECT_EQ(tokens.Refresh(), false) << empty;
    EXPECT_EQ(tokens.Refresh(), std::nullopt) << "this was told";
    EXPECT_TRUE(tokens.FindHolder("Bearer a", &holder).ok()) << empty;
    Write("tokens", alice);
    EXPECT_EQ(tokens.Refresh(), true);
  }
  EXPECT_THAT(
      log.text(),
      HasSubstr(
          "[error] --tokens: " + (folder_ / "tokens").string() +
          " holds no token, no line \"SHA256 NAME\"; what was known before stays valid: 1 token"));
}

// A file that cannot be read may come back in a moment, so it revokes no dance.
TEST_F(TokensTest, AnUnreadableFileEndsNoDance) {
  Write("tokens", LineOf("a", "alice"));
  Tokens tokens(folder_ / "tokens");
  std::string holder;
  Tokens::Hash hash;
  ASSERT_TRUE(tokens.FindHolder("Bearer a", &holder, &hash).ok());
  EXPECT_FALSE(tokens.IsRevoked(hash));
  std::filesystem::remove(folder_ / "tokens");
  EXPECT_EQ(tokens.Refresh(), false);
  EXPECT_THAT(tokens.FindHolder("Bearer a", &holder).error_message(),
              HasSubstr("the server cannot read its tokens"));
  EXPECT_FALSE(tokens.IsRevoked(hash));
  Write("tokens", LineOf("b", "bob"));
  EXPECT_EQ(tokens.Refresh(), true);
  EXPECT_TRUE(tokens.IsRevoked(hash));
}

// Otherwise the log would name either, and removing one line would revoke nothing.
TEST_F(TokensTest, ATokenHasOneName) {
  const std::string both = LineOf("a", "alice") + LineOf("b", "bob");
  Write("tokens", both + LineOf("a", "mallory"));
  try {
    Tokens{folder_ / "tokens"};
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("tokens lines 1 and 3: the same token under two names"));
  }
  Write("tokens", both + LineOf("a", "alice"));
  Tokens tokens(folder_ / "tokens");
  EXPECT_EQ(tokens.count(), 2U) << "a repeated line is harmless";
  Write("tokens", both + LineOf("a", "mallory"));
  EXPECT_EQ(tokens.Refresh(), false);
  std::string holder;
  EXPECT_TRUE(tokens.FindHolder("Bearer a", &holder).ok());
  EXPECT_EQ(holder, "alice");
}

// This may be another file, or one whose writer failed halfway.
TEST_F(TokensTest, AFileOfBadLinesKeepsTheFormerTokens) {
  const LogCapture log;
  Write("tokens", LineOf("a", "alice"));
  Tokens tokens(folder_ / "tokens");
  std::string holder;
  const auto knows_alice = [&] { return tokens.FindHolder("Bearer a", &holder).ok(); };
  Write("tokens", "# who may call\njunk line here\n");
  EXPECT_EQ(tokens.Refresh(), false);
  EXPECT_EQ(tokens.Refresh(), std::nullopt) << "this was told";
  EXPECT_TRUE(knows_alice());
  EXPECT_THAT(log.text(), HasSubstr("[error] --tokens: " + (folder_ / "tokens").string() +
                                    " line 2: not \"SHA256 NAME\""));
  EXPECT_THAT(log.text(), HasSubstr("what was known before stays valid: 1 token"));
  // Removed tokens do not return.
  std::filesystem::remove(folder_ / "tokens");
  EXPECT_EQ(tokens.Refresh(), false);
  Write("tokens", "junk line here\n");
  EXPECT_EQ(tokens.Refresh(), false);
  EXPECT_FALSE(knows_alice());
}

// All callers have one address, like those behind one back end.
TEST_F(TokensTest, EachHolderHasItsOwnPlaces) {
  Write("tokens", LineOf("a", "alice") + LineOf("b", "bob"));
  const auto server = Start([&](ServerConfig& config) {
    config.tokens = folder_ / "tokens";
    config.max_streams = 3;
    config.max_streams_of_peer = 1;
  });
  const Client alice(With(*server, "a"));
  const auto dance = alice.StartDance({.frames = 30});
  ASSERT_TRUE(dance->Next());
  ExpectError(ErrorCode::kResourceExhausted,
              server->address() +
                  ": holder \"alice\" has 1 call in progress, of at most 1 for one caller; it "
                  "asks to try again in ",
              [&] { alice.GenerateTransition({.frames = 5}); });
  Write("bobs", "b\n");
  const Client bob(
      {.addresses = {server->address()}, .token_file = folder_ / "bobs", .retry_s = 0});
  EXPECT_EQ(bob.GenerateTransition({.frames = 5}).candidates.size(), 1U);
}

TEST_F(TokensTest, TheSchemeIsTheSameInEitherCase) {
  Write("tokens", LineOf("a", "alice"));
  const Tokens tokens(folder_ / "tokens");
  std::string holder;
  for (const char* good : {"Bearer a", "bearer a", "BEARER a", "bearer   a"}) {
    EXPECT_TRUE(tokens.FindHolder(good, &holder).ok()) << good;
  }
  for (const char* bad :
       {"", "a", "Bearer", "Bearera", "Bearer ", "Basic a", "Bearer\ta", " a", "Bearer a "}) {
    EXPECT_FALSE(tokens.FindHolder(bad, &holder).ok()) << bad;
  }
}

TEST_F(TokensTest, NoneIsLogged) {
  const LogCapture log;
  Write("tokens", LineOf("correct-horse", "alice"));
  auto server = Start([&](ServerConfig& config) { config.tokens = folder_ / "tokens"; });
  EXPECT_TRUE(Serves(With(*server, "correct-horse")));
  EXPECT_FALSE(Serves(With(*server, "wrong-horse")));
  Write("tokens", "correct-horse alice\n");
  ExpectEventually([&] { return log.text().find("tokens line 1") != std::string::npos; },
                   "the bad line is told");
  server.reset();
  EXPECT_THAT(log.text(), HasSubstr("(alice)"));
  EXPECT_THAT(log.text(), HasSubstr("tokens line 1"));
  EXPECT_THAT(log.text(), Not(HasSubstr("horse")));
}

// A token made by `openssl rand -hex 32` looks like a hash.
TEST_F(TokensTest, ARawTokenInTheFileIsTold) {
  const LogCapture log;
  const std::string raw(64, '7');
  Write("tokens", raw + " alice\n");
  const Tokens tokens(folder_ / "tokens");
  std::string holder;
  for (int i = 0; i < 2; ++i) EXPECT_FALSE(tokens.FindHolder("Bearer " + raw, &holder).ok());
  EXPECT_THAT(log.text(), HasSubstr("the line of alice has the token itself"));
  EXPECT_EQ(log.text().find("alice"), log.text().rfind("alice")) << "told once";
  EXPECT_THAT(log.text(), Not(HasSubstr(raw)));
}

TEST_F(TokensTest, AreSentOnlyOverTlsOrLocally) {
  Write("token", "correct-horse");
  ExpectError(ErrorCode::kInvalidArgument, "only over TLS", [&] {
    Client({.addresses = {"127.0.0.1:1", "example.test:1"}, .token_file = folder_ / "token"});
  });
  for (const std::string name : {"127.example.test:1", "localhost.example.test:1"}) {
    ExpectError(ErrorCode::kInvalidArgument, "only over TLS",
                [&] { Client({.addresses = {name}, .token_file = folder_ / "token"}); });
  }
}

TEST_F(TokensTest, EmptyTokensAreRefused) {
  Write("tokens", LineOf("", "nobody"));
  std::string holder;
  const Tokens tokens(folder_ / "tokens");
  EXPECT_EQ(tokens.FindHolder("Bearer ", &holder).error_code(), grpc::StatusCode::UNAUTHENTICATED);
  EXPECT_EQ(holder, "");
}

TEST_F(TokensTest, FilesThatCannotBeUsedAreNamed) {
  Write("tokens", LineOf("a", "alice") + "0123 bob\n");
  ExpectError(ErrorCode::kInvalidArgument, "tokens line 2",
              [&] { Start([&](ServerConfig& config) { config.tokens = folder_ / "tokens"; }); });
  Write("tokens", "\xEF\xBB\xBF" + LineOf("a", "alice"));
  ExpectError(ErrorCode::kInvalidArgument, "line 1 begins with a byte order mark",
              [&] { Start([&](ServerConfig& config) { config.tokens = folder_ / "tokens"; }); });
  Write("tokens", "junk line here\n");
  ExpectError(ErrorCode::kInvalidArgument, "tokens line 1",
              [&] { Start([&](ServerConfig& config) { config.tokens = folder_ / "tokens"; }); });
  Write("tokens", std::string(2 << 20, '#'));
  ExpectError(ErrorCode::kInvalidArgument, "2097152 bytes, of at most 1048576",
              [&] { Start([&](ServerConfig& config) { config.tokens = folder_ / "tokens"; }); });
  for (const char* empty : {"", "# nobody yet\n"}) {
    Write("tokens", empty);
    ExpectError(ErrorCode::kInvalidArgument, "tokens holds no token",
                [&] { Start([&](ServerConfig& config) { config.tokens = folder_ / "tokens"; }); });
  }
  for (const char* none : {"/tmp", "/dev/zero"}) {
    ExpectError(ErrorCode::kInvalidArgument, std::string("--tokens: ") + none,
                [&] { Start([&](ServerConfig& config) { config.tokens = none; }); });
  }
  const auto server = Start({});
  Options options = With(*server, "two words");
  ExpectError(ErrorCode::kInvalidArgument, "visible ASCII",
              [&] { Client(options).GetServerInfo(); });
  options.token_file = "/absent";
  ExpectError(ErrorCode::kInvalidArgument, "/absent", [&] { Client(options).GetServerInfo(); });
}

}  // namespace choreo::client::tokens_test
