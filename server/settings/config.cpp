#include "server/settings/config.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <regex>
#include <string_view>

#include "model/core/error.h"
#include "model/core/joined.h"
#include "model/core/programs.h"
#include "model/core/text/nearest.h"
#include "model/engine/engine_choice.h"
#include "network/address.h"
#include "network/pem.h"
#include "network/protocol.h"
#include "server/connections/listener.h"
#include "server/settings/config_errors.h"
#include "server/settings/config_file.h"
#include "server/settings/config_flags.h"
#include "server/telemetry/log.h"

namespace choreo {
namespace {

constexpr std::array<std::string_view, 7> kLogLevels = {"trace", "debug",    "info", "warning",
                                                        "error", "critical", "off"};

void CheckAddress(const std::string& name, const std::string& address) {
  // gRPC would silently use the lowest 16 bits of a larger port.
  if (ParsePort(SplitAddress(address).port)) return;
  throw InvalidArgument(name, '"' + address + "\" is not HOST:PORT with a port from 0 to " +
                                  std::to_string(kMaxPort));
}

// Loading a model that uses them checks whether this machine has them.
void CheckKernels(const std::string& name) {
  if (name.empty() || std::ranges::find(kKernelNames, name) != kKernelNames.end()) return;
  throw InvalidArgument("--kernels", '"' + name + "\" is none of " + Joined(kKernelNames));
}

void RequireTlsBeyondThisMachine(const ServerConfig& config) {
  if (config.tls_certificate.empty() && !config.insecure && !IsLocal(config.listen)) {
    throw InvalidArgument(
        "--listen",
        '"' + config.listen +
            "\" can be reached from other machines, and without TLS everybody on the way can read "
            "along: set --tls-cert and --tls-key, or --insecure to allow it");
  }
}

void CheckSecurity(const ServerConfig& config, FaultList* faults) {
  const auto require = [faults](const char* flag, const std::filesystem::path& file) {
    if (!file.empty()) faults->Try([&] { RequireRegularFile(flag, file); });
  };
  if (config.tls_certificate.empty() == config.tls_key.empty()) {
    require("--tls-cert", config.tls_certificate);
    require("--tls-key", config.tls_key);
  } else {
    faults->Add(InvalidArgument(config.tls_key.empty() ? "--tls-key" : "--tls-cert",
                                "missing; a certificate and its key go together"));
  }
  if (!config.tls_client_ca.empty() && config.tls_certificate.empty()) {
    faults->Add(
        InvalidArgument("--tls-client-ca", "needs --tls-cert: without TLS nobody shows one"));
  } else {
    require("--tls-client-ca", config.tls_client_ca);
  }
  require("--tokens", config.tokens);
}

// An empty file name in a script is usually an unset variable. Without this check the server would
// start unprotected.
void CheckFileNames(const CLI::App& app, FaultList* faults) {
  for (const char* name : {"--tls-cert", "--tls-key", "--tls-client-ca", "--tokens"}) {
    const CLI::Option* option = app.get_option(name);
    const char* variable = std::getenv(option->get_envname().c_str());
    const bool empty = option->count() == 0
                           ? variable != nullptr && *variable == '\0'
                           : std::ranges::any_of(option->results(), &std::string::empty);
    if (empty) faults->Add(InvalidArgument(name, "is empty; leave it out for none"));
  }
}

// Variables that Kubernetes sets in pods beside a service called choreo, or choreo-anything.
bool IsOfAService(const std::string& variable) {
  static const std::regex kPattern(
      "CHOREO_([A-Z0-9_]*_)?(SERVICE_(HOST|PORT).*|PORT(_[0-9]+_.*)?)");
  return std::regex_match(variable, kPattern);
}

// The name in `known` that a misspelt variable may mean: a similar one, one that contains it, or
// one that it contains.
std::string MeantBy(const std::string& name, const std::vector<std::string>& known) {
  constexpr size_t kShortestPart = 3;
  Nearest meant(name);
  for (const std::string& one : known) meant.Offer(one);
  if (!meant.nearest().empty()) return meant.nearest();
  for (const std::string& one : known) {
    const auto& [shorter, longer] =
        std::minmax(one, name, [](const auto& a, const auto& b) { return a.size() < b.size(); });
    if (shorter.size() >= kShortestPart &&
        ('_' + longer + '_').find('_' + shorter + '_') != std::string::npos)
      return one;
  }
  return "";
}

// Finds misspelt variables, because their settings would silently be ignored. Returns other unknown
// variables.
std::vector<std::string> CheckVariables(const CLI::App& app, FaultList* faults) {
  const std::string prefix = "CHOREO_";
  std::vector<std::string> known, unknown;
  for (const CLI::Option* option : app.get_options()) {
    const std::string variable = option->get_envname();
    if (variable.starts_with(prefix)) known.push_back(variable.substr(prefix.size()));
  }
  // Variables of clients may be in the same environment.
  constexpr std::array<std::string_view, 7> kOfClients = {
      "SERVER", "TLS", "CA", "CLIENT_CERT", "CLIENT_KEY", "SERVER_NAME", "TOKEN_FILE"};
  for (char** at = environ; *at != nullptr; ++at) {
    const std::string entry = *at, variable = entry.substr(0, entry.find('='));
    if (!variable.starts_with(prefix) || IsOfAService(variable)) continue;
    const std::string name = variable.substr(prefix.size());
    if (std::ranges::find(known, name) != known.end() ||
        std::ranges::find(kOfClients, name) != kOfClients.end())
      continue;
    const std::string meant = MeantBy(name, known);
    if (meant.empty()) {
      unknown.push_back(variable);
    } else {
      faults->Add(InvalidArgument(
          variable, "no setting has this variable; did you mean " + prefix + meant + "?"));
    }
  }
  return unknown;
}

// Whether errors should be JSON, even if parsing stopped before --log-format.
bool WantsJson(int argc, const char* const* argv) {
  const std::vector<std::string> words(argv, argv + argc);
  for (size_t i = 0; i < words.size(); ++i) {
    if (words[i].starts_with("--log-format=")) return words[i] == "--log-format=json";
    if (words[i] == "--log-format") return i + 1 < words.size() && words[i + 1] == "json";
  }
  const char* variable = std::getenv("CHOREO_LOG_FORMAT");
  return variable != nullptr && std::string_view(variable) == "json";
}

// Where the setting of `error`, "--NAME: ...", comes from: "FILE:LINE: " for the file, "VARIABLE: "
// for the environment. Empty if the command line has it, or nothing.
std::string PlaceOf(const std::string& error, const CLI::App& app, const TomlFile& file, int argc,
                    const char* const* argv) {
  const std::string flag = error.substr(0, error.find(':'));
  if (!flag.starts_with("--")) return "";
  const bool is_overridden = std::any_of(argv, argv + argc, [&](const std::string& word) {
    return word == flag || word.starts_with(flag + '=');
  });
  if (is_overridden) return "";
  if (std::string place = file.PlaceOf(flag.substr(2)); !place.empty()) return place;
  const CLI::Option* option = app.get_option_no_throw(flag);
  const std::string variable = option == nullptr ? "" : option->get_envname();
  return variable.empty() || std::getenv(variable.c_str()) == nullptr ? "" : variable + ": ";
}

std::map<std::string, std::string> GivenIn(const CLI::App& app) {
  std::map<std::string, std::string> given;
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() > 0) given[option->get_single_name()] = Joined(option->results());
  }
  return given;
}

/// One reading of the command line, the environment and the file of --config.
class Reading {
 public:
  Reading(int argc, const char* const* argv) : argc_(argc), argv_(argv) {
    app_.set_version_flag("--version", CHOREO_VERSION);
    AddFlags(app_, config);
    app_.config_formatter(file_);
  }

  /// Fills `config`, and `unknown` with variables that look like ours. Throws
  /// Error(kInvalidArgument), with a line for each bad setting, and CLI::Success for --help and
  /// --version.
  void Read() try {
    FaultList faults;
    try {
      app_.parse(argc_, argv_);
    } catch (const CLI::Success&) {
      throw;
    } catch (const CLI::ParseError& error) {
      AddFaults(app_, error, &faults);
    }
    faults.Add(file_->faults());
    unknown = CheckVariables(app_, &faults);
    CheckFileNames(app_, &faults);
    CheckValues(&faults);
    faults.Throw();
    if (app_.count("--reflection") == 0)
      config.reflection = config.tls_certificate.empty() && config.tokens.empty();
    config.given = GivenIn(app_);
    config.overridden = file_->overridden();
    for (const auto& [name, value] : config.given) {
      const std::string flag = "--" + name;
      config.places[flag] = PlaceOf(flag, app_, *file_, argc_, argv_);
    }
  } catch (const Error& error) {
    throw Placed(error.what());
  }
  /// Prints what --help and --version ask for.
  void Answer(const CLI::Success& asked) { app_.exit(asked); }

  ServerConfig config;
  std::vector<std::string> unknown;

 private:
  // CLI11 sets a number that it cannot convert to 0, so settings with a fault are not checked.
  void CheckValues(FaultList* faults) const try { config.Check(); } catch (const Error& error) {
    const FaultList before = *faults;
    for (const std::string& fault : FaultsIn(error.what())) {
      const std::string setting = fault.substr(0, fault.find(':') + 1);
      if (!before.HasOneOf(setting)) faults->Add({ErrorCode::kInvalidArgument, "", fault});
    }
  }

  Error Placed(const std::string& what) const {
    std::vector<std::string> faults = FaultsIn(what);
    for (std::string& fault : faults) fault.insert(0, PlaceOf(fault, app_, *file_, argc_, argv_));
    return {ErrorCode::kInvalidArgument, "", Joined(faults, std::identity(), "\n")};
  }

  const int argc_;
  const char* const* const argv_;
  CLI::App app_{
      "choreod makes people dance: it serves the gRPC API choreo.v1.Choreography, with health "
      "checking and reflection.\nEvery setting can also come from the environment or a file.",
      "choreod"};
  const std::shared_ptr<TomlFile> file_ = std::make_shared<TomlFile>(app_);
};

}  // namespace

std::string ServerConfig::MetricsAddress() const {
  return metrics.find(':') == std::string::npos ? "127.0.0.1:" + metrics : metrics;
}

std::string ServerConfig::Placed(const std::string& fault) const {
  const auto place = places.find(fault.substr(0, fault.find(':')));
  return (place == places.end() ? "" : place->second) + fault;
}

void ServerConfig::Check() const {
  FaultList faults;
  faults.Try([&] {
    CheckAddress("--listen", listen);
    RequireTlsBeyondThisMachine(*this);
  });
  if (!metrics.empty()) faults.Try([&] { CheckAddress("--metrics", MetricsAddress()); });
  for (const auto& path : checkpoints)
    faults.Try([&] { RequireRegularFile("--checkpoint", path); });
  if (!models.empty() && !checkpoints.empty()) {
    faults.Add(InvalidArgument("--models", models.string() +
                                               " and --checkpoint exclude each other; put the "
                                               "checkpoint into the folder"));
  }
  if (!names.empty() && (!models.empty() || !checkpoints.empty()))
    faults.Add(InvalidArgument(
        "--model",
        '"' + names.front() + "\" is a shipped model; it excludes --checkpoint and --models"));
  faults.Try([&] { ParseEngineKind(engine, "--engine"); });
  faults.Try([&] { CheckKernels(kernels); });
  // Devices are checked for existence when they are used; `auto` uses whatever exists.
  if (device != "auto") {
    faults.Try([&] {
      ParseDevices(device, {.cuda_build = true, .cuda_devices = std::numeric_limits<int>::max()});
    });
  }
  CheckNumbers(*this, &faults);
  CheckSecurity(*this, &faults);
  if (log_format != "text" && log_format != "json") {
    faults.Add(InvalidArgument("--log-format", '"' + log_format + "\" is none of text, json"));
  }
  if (std::find(kLogLevels.begin(), kLogLevels.end(), log_level) == kLogLevels.end()) {
    faults.Add(InvalidArgument("--log-level", '"' + log_level +
                                                  "\" is none of trace, debug, info, warning, "
                                                  "error, critical, off"));
  }
  faults.Throw();
}

CommandLine ParseCommandLine(int argc, const char* const* argv) {
  Reading reading(argc, argv);
  const auto say = [&](const char* level, const std::string& what) {
    const bool json = reading.config.log_format == "json" || WantsJson(argc, argv);
    std::cerr << (json ? JsonLine(level, what) : "choreod: " + what) << '\n';
  };
  try {
    reading.Read();
  } catch (const CLI::Success& asked) {
    reading.Answer(asked);
    return {.config = std::nullopt, .exit_code = 0};
  } catch (const Error& error) {
    for (const std::string& fault : FaultsIn(error.what())) say("critical", fault);
    return {.config = std::nullopt, .exit_code = kMisused};
  }
  for (const std::string& variable : reading.unknown)
    say("warning", variable + ": no setting has this variable; choreod --help lists them");
  return {.config = std::move(reading.config), .exit_code = 0};
}

ServerConfig RereadConfig(int argc, const char* const* argv) {
  Reading reading(argc, argv);
  try {
    reading.Read();
  } catch (const Error& error) {
    throw Error(error.code(), "", Joined(FaultsIn(error.what()), std::identity(), "; "));
  }
  return std::move(reading.config);
}

std::vector<std::filesystem::path> ShippedCheckpoints(const std::vector<std::string>& names) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  std::string looked;
  for (const auto& folder : {program / "../share/choreo/checkpoints",
                             std::filesystem::path(CHOREO_SOURCE_DIR) / "model/checkpoints"}) {
    std::map<std::string, std::filesystem::path> ship;
    std::vector<std::filesystem::path> found;
    std::string known;
    for (const std::string_view name : kShippedModels) {
      const std::filesystem::path path = (folder / name).lexically_normal() += ".safetensors";
      if (!std::filesystem::is_regular_file(path)) continue;
      known += (known.empty() ? "" : ", ") + std::string(name);
      ship.emplace(name, path);
      if (std::ranges::find(kEverydayModels, name) != std::end(kEverydayModels))
        found.push_back(path);
    }
    looked += "\n  " + folder.lexically_normal().string();
    if (names.empty() ? found.empty() : ship.empty()) continue;
    if (names.empty()) return found;
    found.clear();
    for (const std::string& name : names) {
      const auto path = ship.find(name);
      if (path == ship.end())
        throw Error(ErrorCode::kNotFound, "--model", '"' + name + "\" does not ship, but " + known);
      found.push_back(path->second);
    }
    return found;
  }
  throw Error(ErrorCode::kNotFound, "--checkpoint", "none given, and none found in" + looked);
}

}  // namespace choreo
