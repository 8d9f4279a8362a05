#include "server/settings/config_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "model/core/error.h"
#include "model/core/rounded.h"
#include "model/core/running/threads.h"
#include "model/core/text/nearest.h"
#include "server/messages/music_file.h"

namespace choreo {
namespace {

/// A number as people write it, 1000000 rather than 1e+06.
std::string Shown(double value) {
  constexpr double kExact = 1e15;
  const bool is_whole = std::abs(value) < kExact && value == std::floor(value);
  return is_whole ? std::to_string(static_cast<int64_t>(value)) : InFull(value);
}

/// A numeric setting.
struct NumberSetting {
  const char* flag;
  double (*of)(const ServerConfig&);
  double least, most;
  bool whole;
};

constexpr double kDay = 86'400;
using Config = ServerConfig;
constexpr std::array kNumbers = {
    NumberSetting{"--max-waiting", [](const Config& c) -> double { return c.max_waiting; }, 1,
                  65536, true},
    NumberSetting{"--max-streams", [](const Config& c) -> double { return c.max_streams; }, 0,
                  kMostStreams, true},
    NumberSetting{"--max-streams-of-peer",
                  [](const Config& c) -> double { return c.max_streams_of_peer; }, 0, kMostStreams,
                  true},
    NumberSetting{"--workers", [](const Config& c) -> double { return c.workers; }, 0, 1024, true},
    NumberSetting{"--threads", [](const Config& c) -> double { return c.threads; }, 1,
                  kMaxMathThreads, true},
    NumberSetting{"--io-threads", [](const Config& c) -> double { return c.io_threads; }, 1, 256,
                  true},
    NumberSetting{"--drain-seconds", [](const Config& c) { return c.drain_seconds; }, 0, 3600,
                  false},
    NumberSetting{"--outbox-kib", [](const Config& c) -> double { return c.outbox_kib; }, 1, 65536,
                  true},
    // There must be room for one file.
    NumberSetting{"--max-file-music-mib",
                  [](const Config& c) -> double { return c.max_file_music_mib; },
                  kMaxAudioFileBytes >> 20, 1 << 20, true},
    // There must be room for the largest message.
    NumberSetting{"--max-network-mib", [](const Config& c) -> double { return c.max_network_mib; },
                  64, 1 << 20, true},
    NumberSetting{"--first-message-seconds",
                  [](const Config& c) { return c.first_message_seconds; }, 0.1, kDay, false},
    NumberSetting{"--idle-seconds", [](const Config& c) { return c.idle_seconds; }, 0.1, kDay,
                  false},
    NumberSetting{"--unread-seconds", [](const Config& c) { return c.unread_seconds; }, 0.1, kDay,
                  false},
    NumberSetting{"--max-load", [](const Config& c) { return c.max_load; }, 0.1, 2, false},
    // gRPC counts milliseconds in 32 bits.
    NumberSetting{"--max-connection-seconds",
                  [](const Config& c) { return c.max_connection_seconds; }, 0, 24 * kDay, false},
};

std::string RangeOf(const NumberSetting& setting) {
  return '[' + Shown(setting.least) + ", " + Shown(setting.most) + ']';
}

/// "Could not convert: --workers = many"
std::string Unconverted(const std::string& said) {
  constexpr std::string_view kBefore = "Could not convert: ", kBetween = " = ";
  const size_t at = said.find(kBetween);
  if (!said.starts_with(kBefore) || at == std::string::npos) return said;
  const std::string flag = said.substr(kBefore.size(), at - kBefore.size());
  const auto number = std::ranges::find(kNumbers, flag, &NumberSetting::flag);
  const std::string wanted = number == kNumbers.end() ? "neither true nor false"
                             : number->whole          ? "not a whole number in " + RangeOf(*number)
                                                      : "not a number in " + RangeOf(*number);
  return flag + ": \"" + said.substr(at + kBetween.size()) + "\" is " + wanted;
}

/// "--workers: 1 required INT missing", "--workers: At Most 1 required but received 2"
std::string Miscounted(const std::string& said) {
  const std::string flag = said.substr(0, said.find(':'));
  constexpr std::string_view kReceived = "received ";
  const size_t at = said.find(kReceived);
  if (at == std::string::npos) return flag + ": has no value";
  return flag + ": " + said.substr(at + kReceived.size()) + " values are more than 1";
}

/// Rewrites a CLI11 error about one setting.
std::string InOurWords(const CLI::ParseError& error) {
  const std::string said = error.what();
  if (dynamic_cast<const CLI::ConversionError*>(&error)) return Unconverted(said);
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) return Miscounted(said);
  if (dynamic_cast<const CLI::FileError*>(&error)) return said;  // FaultOfFile's
  return said + "; see --help";
}

}  // namespace

void CheckNumbers(const ServerConfig& config, FaultList* faults) {
  for (const NumberSetting& setting : kNumbers) {
    const double value = setting.of(config);
    if (value >= setting.least && value <= setting.most) continue;
    faults->Add(InvalidArgument(setting.flag, Shown(value) + " is not in " + RangeOf(setting)));
  }
  // Above this bound the setting would limit nothing.
  if (config.max_streams > 0 && config.max_streams_of_peer > config.max_streams) {
    faults->Add(InvalidArgument("--max-streams-of-peer",
                                std::to_string(config.max_streams_of_peer) + " is not in [0, " +
                                    std::to_string(config.max_streams) +
                                    "], which --max-streams allows"));
  }
}

std::string UnknownSetting(const CLI::App& app, const std::string& name) {
  Nearest meant(name);
  for (const CLI::Option* option : app.get_options()) {
    const std::string known = option->get_name();
    meant.Offer(name.starts_with("--") ? known : known.substr(2));
  }
  return "no setting is called \"" + name + "\"; " +
         (meant.nearest().empty() ? "choreod --help lists them"
                                  : "did you mean " + meant.nearest() + "?");
}

void AddFaults(CLI::App& app, const CLI::ParseError& error, FaultList* faults) {
  const auto add = [&](const std::string& fault) {
    faults->Add({ErrorCode::kInvalidArgument, "", fault});
  };
  if (!dynamic_cast<const CLI::ExtrasError*>(&error)) add(InOurWords(error));
  // CLI11 stops at the first value that it cannot convert.
  for (CLI::Option* option : app.get_options()) {
    try {
      if (option->count() > 0) option->run_callback();
    } catch (const CLI::Success&) {
      throw;
    } catch (const CLI::ParseError& other) {
      add(InOurWords(other));
    }
  }
  const std::vector<std::string> extra = app.remaining();
  const auto is_flag = [](const std::string& word) { return word.starts_with('-'); };
  // Words after an unknown flag are probably its values.
  for (size_t i = 0; i < extra.size(); ++i)
    if (i == 0 || is_flag(extra[i])) add(UnknownSetting(app, extra[i]));
}

}  // namespace choreo
