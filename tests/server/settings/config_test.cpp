#include "server/settings/config.h"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "model/core/error.h"
#include "server/settings/config_flags.h"

namespace choreo::config_test {

CommandLine Parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "choreod");
  return ParseCommandLine(static_cast<int>(arguments.size()), arguments.data());
}

TEST(ServerConfigTest, DefaultsAreValid) {
  const CommandLine line = Parse({});
  ASSERT_TRUE(line.config);
  EXPECT_EQ(line.config->listen, "127.0.0.1:50051");
  EXPECT_EQ(line.config->max_waiting, 128);
  EXPECT_EQ(line.config->max_streams, 0);
}

TEST(ServerConfigTest, OneCallerMayHaveAllButAnEighth) {
  ServerConfig config;
  config.max_streams = 64;
  EXPECT_EQ(config.MaxStreamsOfPeer(), 56);
  EXPECT_EQ(config.MaxStreamsOfLonePeer(), 64);
}

TEST(ServerConfigTest, OneCallersCallsAreAmongAll) {
  EXPECT_TRUE(Parse({"--max-streams-of-peer", "65"}).config);
  testing::internal::CaptureStderr();
  EXPECT_EQ(Parse({"--max-streams", "64", "--max-streams-of-peer", "65"}).exit_code, 2);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("65 is not in [0, 64]"), std::string::npos);
}

TEST(ServerConfigTest, SmallServersKeepAPlaceForAnotherCaller) {
  for (const auto& [streams, of_peer] : {std::pair{1, 1}, {2, 1}, {4, 3}, {16, 14}}) {
    ServerConfig config;
    config.max_streams = streams;
    EXPECT_EQ(config.MaxStreamsOfPeer(), of_peer) << streams;
  }
}

TEST(ServerConfigTest, AFolderOfModelsExcludesCheckpoints) {
  const CommandLine line = Parse({"--models", "somewhere"});
  ASSERT_TRUE(line.config);
  EXPECT_EQ(line.config->models, "somewhere");
  const std::string path = testing::TempDir() + "choreod_config_test.safetensors";
  std::ofstream(path) << "content";
  testing::internal::CaptureStderr();
  EXPECT_EQ(Parse({"--models", "somewhere", "--checkpoint", path.c_str()}).exit_code, 2);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("exclude each other"), std::string::npos);
}

TEST(ServerConfigTest, FlagsGoBeforeFileBeforeEnvironment) {
  const std::string path = testing::TempDir() + "choreod_config_test.toml";
  std::ofstream(path) << "workers = 3\nmax-streams = 4\nio-threads = 5\n";
  ::setenv("CHOREO_WORKERS", "30", 1);
  ::setenv("CHOREO_MAX_STREAMS", "40", 1);
  ::setenv("CHOREO_MAX_WAITING", "50", 1);
  const CommandLine line = Parse({"--config", path.c_str(), "--workers", "300"});
  ::unsetenv("CHOREO_WORKERS");
  ::unsetenv("CHOREO_MAX_STREAMS");
  ::unsetenv("CHOREO_MAX_WAITING");
  ASSERT_TRUE(line.config);
  EXPECT_EQ(line.config->workers, 300);
  EXPECT_EQ(line.config->max_streams, 4);
  EXPECT_EQ(line.config->max_waiting, 50);
  EXPECT_EQ(line.config->io_threads, 5);
}

TEST(ServerConfigTest, RefusesAFileWithAnUnknownSetting) {
  for (const std::string text : {"workers = 3\nworkerz = 4\n", "\n[workerz]\nworkers = 4\n"}) {
    const std::string path = testing::TempDir() + "choreod_config_extra_test.toml";
    std::ofstream(path) << text;
    testing::internal::CaptureStderr();
    const CommandLine line = Parse({"--config", path.c_str()});
    const std::string message = testing::internal::GetCapturedStderr();
    EXPECT_FALSE(line.config);
    EXPECT_EQ(line.exit_code, 2);
    EXPECT_NE(message.find(path + ":2: "), std::string::npos) << message;
    EXPECT_NE(message.find("workerz"), std::string::npos) << message;
  }
}

TEST(ServerConfigTest, ReadsTomlAsItIs) {
  const std::string path = testing::TempDir() + "choreod_config_toml_test.toml";
  std::ofstream(path)
      << "# A comment\nlisten = '127.0.0.1:0' # and another\nmodel = [\n  \"free\",\n"
         "  \"paper-f\", # the last\n]\nmax-network-mib = 1_024\n"
         "drain-seconds = 1e1\nreflection = false\nmax-load = 0.5\n";
  const CommandLine line = Parse({"--config", path.c_str()});
  ASSERT_TRUE(line.config);
  EXPECT_EQ(line.config->listen, "127.0.0.1:0");
  EXPECT_EQ(line.config->names, (std::vector<std::string>{"free", "paper-f"}));
  EXPECT_EQ(line.config->max_network_mib, 1024);
  EXPECT_EQ(line.config->drain_seconds, 10);
  EXPECT_FALSE(line.config->reflection);
  EXPECT_EQ(line.config->max_load, 0.5);
}

// An error in the file names file and line; an error in a flag does not.
TEST(ServerConfigTest, SaysWhereInTheFileAnErrorIs) {
  const std::string path = testing::TempDir() + "choreod_config_line_test.toml";
  const auto said = [&](const std::string& text, std::vector<const char*> more = {}) {
    std::ofstream(path) << "\n" << text;
    more.insert(more.end(), {"--config", path.c_str()});
    testing::internal::CaptureStderr();
    EXPECT_EQ(Parse(more).exit_code, 2) << text;
    return testing::internal::GetCapturedStderr();
  };
  const std::string at = "choreod: " + path + ":2: ";
  EXPECT_EQ(said("workers = \"many\"\n"),
            at + "--workers: \"many\" is not a whole number in [0, 1024]\n");
  EXPECT_EQ(said("workers = -1\n"), at + "--workers: -1 is not in [0, 1024]\n");
  EXPECT_EQ(said("workers = -1\n", {"--workers=-2"}),
            "choreod: --workers: -2 is not in [0, 1024]\n");
  for (const char* broken :
       {"listen = \"127.0.0.1:0\n", "listen = \"a\"b\"\n", "workers 2\n", "insecure = yes\n",
        "listen = 127.0.0.1:0\n", "workers = 2000-01-01\n", "workers = {a = 1}\n"})
    EXPECT_TRUE(said(broken).starts_with(at)) << said(broken);
  for (const char* bare : {"listen = 127.0.0.1:0\n", "listen = [::]:50051\n", "listen=::1 # all\n",
                           "listen = localhost:50051"})
    EXPECT_TRUE(said(bare).starts_with(at + "listen: texts need quotation marks; ")) << said(bare);
  for (const char* other : {"listen = \"127.0.0.1:0\n", "workers =\n", "model = [\"free\"\n",
                            "workers = 2\nworkers = 3\n"})
    EXPECT_EQ(said(other).find("quotation marks"), std::string::npos) << said(other);
  EXPECT_EQ(said("check = true\n"), at + "check is a flag only\n");
  EXPECT_EQ(said("config = \"x\"\n"), at + "config is a flag only\n");
  EXPECT_TRUE(said("workers = 2\nworkers = 3\n").starts_with("choreod: " + path + ":3: "));
}

TEST(ServerConfigTest, NamesAMissingFile) {
  testing::internal::CaptureStderr();
  const CommandLine line = Parse({"--config", "/nonexistent.toml"});
  const std::string message = testing::internal::GetCapturedStderr();
  EXPECT_FALSE(line.config);
  EXPECT_EQ(line.exit_code, 2);
  EXPECT_NE(message.find("/nonexistent.toml"), std::string::npos) << message;
}

TEST(ServerConfigTest, PortsEndAt65535) {
  ServerConfig config;
  config.listen = "127.0.0.1:65535";
  config.Check();
}

TEST(ServerConfigTest, HelpExplainsAndLeaves) {
  testing::internal::CaptureStdout();
  const CommandLine line = Parse({"--help"});
  const std::string help = testing::internal::GetCapturedStdout();
  EXPECT_FALSE(line.config);
  EXPECT_EQ(line.exit_code, 0);
  for (const char* word : {"--listen", "--checkpoint", "--device", "--drain-seconds", "--tls-cert",
                           "CHOREO_WORKERS", "--config"}) {
    EXPECT_NE(help.find(word), std::string::npos) << word;
  }
}

struct BadSetting {
  const char* flag;
  const char* value;
};

class BadServerConfigTest : public testing::TestWithParam<BadSetting> {};

TEST_P(BadServerConfigTest, IsNamed) {
  testing::internal::CaptureStderr();
  const CommandLine line = Parse({GetParam().flag, GetParam().value});
  const std::string message = testing::internal::GetCapturedStderr();
  EXPECT_FALSE(line.config);
  EXPECT_EQ(line.exit_code, 2);
  EXPECT_NE(message.find(GetParam().flag), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    All, BadServerConfigTest,
    testing::Values(
        BadSetting{"--listen", "nowhere"}, BadSetting{"--listen", "host:"},
        BadSetting{"--listen", "127.0.0.1:65536"}, BadSetting{"--listen", "0.0.0.0:0"},
        BadSetting{"--listen", "[::]:0"}, BadSetting{"--tokens", "/nonexistent"},
        BadSetting{"--log-format", "xml"}, BadSetting{"--tls-client-ca", "/nonexistent"},
        BadSetting{"--metrics", "65536"}, BadSetting{"--metrics", "here:"},
        BadSetting{"--listen", "127.0.0.1:99999999999999999999"},
        BadSetting{"--max-file-music-mib", "127"}, BadSetting{"--max-network-mib", "63"},
        BadSetting{"--workers", "-1"}, BadSetting{"--workers", "many"},
        BadSetting{"--max-streams", "-1"}, BadSetting{"--max-streams-of-peer", "65537"},
        BadSetting{"--engine", "fast"}, BadSetting{"--kernels", "avx9"}, BadSetting{"--tokens", ""},
        BadSetting{"--tls-cert", ""}, BadSetting{"--tls-client-ca", ""},
        BadSetting{"--tokens", "/tmp"}, BadSetting{"--tokens", "/dev/zero"},
        BadSetting{"--checkpoint", "/dev/null"}, BadSetting{"--device", "gpu"},
        BadSetting{"--log-level", "loud"}, BadSetting{"--checkpoint", "/nonexistent.safetensors"},
        BadSetting{"--max-waiting", "0"}, BadSetting{"--drain-seconds", "-3"},
        BadSetting{"--max-connection-seconds", "2073601"}, BadSetting{"--frobnicate", "1"}));

// Whoever collects JSON lines must get no other lines.
TEST(ServerConfigTest, ErrorsAreJsonWhereTheLogIs) {
  for (const std::vector<const char*>& arguments :
       {std::vector<const char*>{"--log-format", "json", "--workers", "-1"},
        {"--log-format=json", "--frobnicate", "1"},
        {"--config", "/nonexistent.toml", "--log-format", "json"}}) {
    testing::internal::CaptureStderr();
    EXPECT_FALSE(Parse(arguments).config);
    const std::string line = testing::internal::GetCapturedStderr();
    const auto object = nlohmann::json::parse(line, nullptr, /*allow_exceptions=*/false);
    ASSERT_TRUE(object.is_object()) << line;
    EXPECT_EQ(object.at("level"), "critical");
  }
}

// So `choreod --check` names all that is to mend at once.
TEST(ServerConfigTest, NamesEachOfSeveralFaults) {
  const std::string path = testing::TempDir() + "choreod_config_faults_test.toml";
  std::ofstream(path) << "max-load = 7\ntokens = \"/nonexistent\"\n";
  ::setenv("CHOREO_TOKEN", "x", 1);
  testing::internal::CaptureStderr();
  EXPECT_EQ(Parse({"--config", path.c_str(), "--workers", "-1", "--kernels", "avx9"}).exit_code, 2);
  ::unsetenv("CHOREO_TOKEN");
  const std::string said = testing::internal::GetCapturedStderr();
  for (const std::string& fault :
       {std::string("CHOREO_TOKEN: no setting has this variable"),
        path + ":1: --max-load: 7 is not", path + ":2: --tokens: no file /nonexistent",
        std::string("--workers: -1 is not in"), std::string("--kernels: \"avx9\" is none of")})
    EXPECT_THAT(said, testing::HasSubstr("choreod: " + fault));
  EXPECT_EQ(std::ranges::count(said, '\n'), 5) << said;
}

// A flag overrides the variable.
TEST(ServerConfigTest, NamesTheVariableOfABadValue) {
  const auto said = [](const std::vector<const char*>& arguments) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(Parse(arguments).exit_code, 2);
    return testing::internal::GetCapturedStderr();
  };
  ::setenv("CHOREO_WORKERS", "many", 1);
  ::setenv("CHOREO_MAX_NETWORK_MIB", "2000000", 1);
  EXPECT_EQ(said({}),
            "choreod: CHOREO_WORKERS: --workers: \"many\" is not a whole number in [0, 1024]\n"
            "choreod: CHOREO_MAX_NETWORK_MIB: --max-network-mib: 2000000 is not in [64, "
            "1048576]\n");
  ::unsetenv("CHOREO_MAX_NETWORK_MIB");
  EXPECT_EQ(said({"--workers=1000000"}), "choreod: --workers: 1000000 is not in [0, 1024]\n");
  ::unsetenv("CHOREO_WORKERS");
}

// A fault that ends CLI11's reading hides no other.
TEST(ServerConfigTest, NamesFaultsBesideThoseOfCli11) {
  const std::string path = testing::TempDir() + "choreod_config_all_test.toml";
  const auto expect = [&](const std::vector<const char*>& arguments,
                          const std::vector<std::string>& faults) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(Parse(arguments).exit_code, 2);
    const std::string said = testing::internal::GetCapturedStderr();
    for (const std::string& fault : faults)
      EXPECT_THAT(said, testing::HasSubstr("choreod: " + fault));
    EXPECT_EQ(static_cast<size_t>(std::ranges::count(said, '\n')), faults.size()) << said;
  };
  std::ofstream(path) << "workers = -1\nlog-level = \"loud\"\nmax-load = \"x\"\nkernels = \"foo\"\n"
                         "drain-seconds = 9999\nnosuch = 4\nio-threads = [1, 2]\ncheck = true\n"
                         "threads = 2000-01-01\n";
  expect(
      {"--config", path.c_str(), "--max-streams", "many"},
      {path + ":1: --workers: -1 is not in", path + ":2: --log-level: \"loud\" is none of",
       path + ":3: --max-load: \"x\" is not a number", path + ":4: --kernels: \"foo\" is none",
       path + ":5: --drain-seconds: 9999 is not in", path + ":6: no setting is called \"nosuch\"",
       path + ":7: --io-threads: 2 values are more than 1", path + ":8: check is a flag only",
       path + ":9: \"threads\" is neither", "--max-streams: \"many\" is not a whole number"});
  expect({"--nosuch", "4", "--neither", "--workers", "many", "--kernels", "foo", "--outbox-kib"},
         {"no setting is called \"--nosuch\"", "no setting is called \"--neither\"",
          "--workers: \"many\" is not", "--kernels: \"foo\" is none of",
          "--outbox-kib: has no value"});
  std::ofstream(path) << "listen = 127.0.0.1:0\n";
  expect({"--config", path.c_str(), "--tokens", "", "--workers", "-1"},
         {path + ":1: listen: texts need quotation marks", "--tokens: is empty",
          "--workers: -1 is not in"});
}

// A server that should require tokens does not start without them.
TEST(ServerConfigTest, RefusesAnEmptyFileName) {
  const std::string path = testing::TempDir() + "choreod_config_empty_test.toml";
  std::ofstream(path) << "tokens = \"\"\n";
  testing::internal::CaptureStderr();
  EXPECT_FALSE(Parse({"--config", path.c_str()}).config);
  ::setenv("CHOREO_TOKENS", "", 1);
  EXPECT_FALSE(Parse({}).config);
  ::unsetenv("CHOREO_TOKENS");
  const std::string message = testing::internal::GetCapturedStderr();
  EXPECT_EQ(message, "choreod: " + path +
                         ":1: --tokens: is empty; leave it out for none\nchoreod: "
                         "CHOREO_TOKENS: --tokens: is empty; leave it out for none\n");
}

TEST(ServerConfigTest, ListsValidChoices) {
  testing::internal::CaptureStderr();
  EXPECT_FALSE(Parse({"--kernels", "avx9"}).config);
  EXPECT_FALSE(Parse({"--engine", "fast"}).config);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "choreod: --kernels: \"avx9\" is none of portable, avx2, avx512, avx512_bf16, "
            "amx_bf16\n"
            "choreod: --engine: \"fast\" is none of auto, torch, packed, packed-bf16\n");
}

// Each error names the setting, its value and the limit.
TEST(ServerConfigTest, ErrorsAreOfOneShape) {
  const std::string path = testing::TempDir() + "choreod_config_shape_test.toml";
  std::ofstream(path) << "max-loud = 1\n";
  const auto said = [](const std::vector<const char*>& arguments) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(Parse(arguments).exit_code, 2);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said({"--workers", "-1"}), "choreod: --workers: -1 is not in [0, 1024]\n");
  EXPECT_EQ(said({"--workers", "many"}),
            "choreod: --workers: \"many\" is not a whole number in [0, 1024]\n");
  EXPECT_EQ(said({"--max-load", "much"}),
            "choreod: --max-load: \"much\" is not a number in [0.1, 2]\n");
  EXPECT_EQ(said({"--insecure=maybe"}),
            "choreod: --insecure: \"maybe\" is neither true nor false\n");
  EXPECT_EQ(said({"--workers"}), "choreod: --workers: has no value\n");
  EXPECT_EQ(said({"--workers", "1", "--workers", "2"}),
            "choreod: --workers: 2 values are more than 1\n");
  EXPECT_EQ(said({"--worker", "1"}),
            "choreod: no setting is called \"--worker\"; did you mean --workers?\n");
  EXPECT_EQ(said({"--config", path.c_str()}),
            "choreod: " + path + ":1: no setting is called \"max-loud\"; did you mean max-load?\n");
  EXPECT_EQ(said({"--config", "/nonexistent.toml"}),
            "choreod: --config: no file /nonexistent.toml\n");
  EXPECT_EQ(said({"--log-format", "xml"}),
            "choreod: --log-format: \"xml\" is none of text, json\n");
  EXPECT_EQ(
      said({"--model", "free", "--models", "here"}),
      "choreod: --model: \"free\" is a shipped model; it excludes --checkpoint and --models\n");
}

// The same holds for settings in the file.
TEST(ServerConfigTest, EverySettingHasAVariable) {
  ServerConfig config;
  CLI::App app;
  AddFlags(app, config);
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_lnames().front();
    if (name == "help" || name == "check") continue;  // what is no setting
    std::string variable = "CHOREO_";
    for (const char c : name) {
      variable += c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    EXPECT_EQ(option->get_envname(), variable);
  }
  const std::string path = testing::TempDir() + "choreod_config_variable_test.toml";
  std::ofstream(path) << "io-threads = 5\n";
  ::setenv("CHOREO_CONFIG", path.c_str(), 1);
  const CommandLine line = Parse({});
  ::setenv("CHOREO_CONFIG", "/nonexistent.toml", 1);
  const CommandLine flag = Parse({"--config", path.c_str()});
  testing::internal::CaptureStderr();
  EXPECT_FALSE(Parse({}).config);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("/nonexistent.toml"), std::string::npos);
  ::unsetenv("CHOREO_CONFIG");
  ASSERT_TRUE(line.config && flag.config);
  EXPECT_EQ(line.config->io_threads, 5);
  EXPECT_EQ(flag.config->io_threads, 5);
}

// Other machines may connect only with TLS, or with --insecure.
TEST(ServerConfigTest, PlaintextBeyondLocalhostNeedsAFlag) {
  for (const char* everywhere : {"0.0.0.0:0", "[::]:0", "203.0.113.1:1"}) {
    testing::internal::CaptureStderr();
    EXPECT_FALSE(Parse({"--listen", everywhere}).config);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("--insecure"), std::string::npos);
    EXPECT_TRUE(Parse({"--listen", everywhere, "--insecure"}).config);
  }
  for (const char* here : {"localhost:0", "[::1]:0", "127.8.8.8:0"}) {
    EXPECT_TRUE(Parse({"--listen", here}).config) << here;
  }
}

TEST(ServerConfigTest, EnvironmentSetsFlags) {
  ::setenv("CHOREO_INSECURE", "true", 1);
  ::setenv("CHOREO_REFLECTION", "false", 1);
  const CommandLine line = Parse({"--listen", "0.0.0.0:0"});
  ::unsetenv("CHOREO_INSECURE");
  ::unsetenv("CHOREO_REFLECTION");
  ASSERT_TRUE(line.config);
  EXPECT_FALSE(line.config->reflection);
  EXPECT_FALSE(Parse({"--no-reflection"}).config->reflection);
  EXPECT_TRUE(Parse({}).config->reflection);
}

// Reflection asks nobody for a token.
TEST(ServerConfigTest, WhoDemandsTokensOrTlsReflectsOnlyIfAsked) {
  const std::string file = testing::TempDir() + "choreod_config_secret_test";
  std::ofstream(file) << "content";
  for (const std::vector<const char*>& secrets :
       {std::vector<const char*>{"--tokens", file.c_str()},
        {"--tls-cert", file.c_str(), "--tls-key", file.c_str()}}) {
    EXPECT_FALSE(Parse(secrets).config->reflection);
    std::vector<const char*> asked = secrets;
    asked.push_back("--reflection");
    EXPECT_TRUE(Parse(asked).config->reflection);
  }
}

// An ignored variable would be a limit or a protection that is missing.
TEST(ServerConfigTest, RefusesAMisspeltVariable) {
  const auto said = [](const char* variable, bool starts) {
    ::setenv(variable, "7", 1);
    testing::internal::CaptureStderr();
    const CommandLine line = Parse({});
    ::unsetenv(variable);
    EXPECT_EQ(line.config.has_value(), starts) << variable;
    return testing::internal::GetCapturedStderr();
  };
  for (const auto& [variable, meant] : {std::pair{"CHOREO_MAX_STREAM", "CHOREO_MAX_STREAMS"},
                                        {"CHOREO_TOKENZ", "CHOREO_TOKENS"},
                                        {"CHOREO_CERT", "CHOREO_TLS_CERT"},
                                        {"CHOREO_LISTEN_ADDRESS", "CHOREO_LISTEN"}}) {
    EXPECT_EQ(said(variable, false), std::string("choreod: ") + variable +
                                         ": no setting has this variable; did you mean " + meant +
                                         "?\n");
  }
  EXPECT_EQ(said("CHOREO_XYLOPHONE", true),
            "choreod: CHOREO_XYLOPHONE: no setting has this variable; choreod --help lists them\n");
  // Variables of a client, and those of a Kubernetes service called choreo.
  for (const char* other : {"CHOREO_SERVER", "CHOREO_SERVICE_HOST", "CHOREO_SERVICE_PORT_GRPC",
                            "CHOREO_PORT", "CHOREO_PORT_50051_TCP_ADDR", "CHORE", "CHOREOD_PORT"})
    EXPECT_EQ(said(other, true), "");
}

TEST(ServerConfigTest, ACertificateNeedsItsKey) {
  ServerConfig config;
  config.tls_certificate = "cert.pem";
  try {
    config.Check();
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.field(), "--tls-key");
  }
}

}  // namespace choreo::config_test
