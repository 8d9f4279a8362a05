#include "server/settings/live_settings.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

namespace choreo {
namespace {

template <auto Member>
void Copy(const ServerConfig& from, ServerConfig* to) {
  to->*Member = from.*Member;
}

struct LiveSetting {
  std::string_view flag;
  void (*copy)(const ServerConfig& from, ServerConfig* to);
};

/// Those that concern only calls to come, or the next look at those in progress.
constexpr std::array kLive = {
    LiveSetting{"max-streams", Copy<&ServerConfig::max_streams>},
    LiveSetting{"max-streams-of-peer", Copy<&ServerConfig::max_streams_of_peer>},
    LiveSetting{"max-load", Copy<&ServerConfig::max_load>},
    LiveSetting{"first-message-seconds", Copy<&ServerConfig::first_message_seconds>},
    LiveSetting{"idle-seconds", Copy<&ServerConfig::idle_seconds>},
    LiveSetting{"unread-seconds", Copy<&ServerConfig::unread_seconds>},
    LiveSetting{"drain-seconds", Copy<&ServerConfig::drain_seconds>},
    LiveSetting{"log-level", Copy<&ServerConfig::log_level>},
};

std::string ValueOf(const ServerConfig& config, const std::string& flag) {
  const auto at = config.given.find(flag);
  return at == config.given.end() ? "the default" : at->second;
}

}  // namespace

SettingsChange TakeOver(const ServerConfig& fresh, ServerConfig* config) {
  std::set<std::string> flags;
  for (const ServerConfig* one : {&fresh, static_cast<const ServerConfig*>(config)}) {
    for (const auto& [flag, value] : one->given) flags.insert(flag);
  }
  SettingsChange change;
  for (const std::string& flag : flags) {
    const std::string before = ValueOf(*config, flag), now = ValueOf(fresh, flag);
    if (now == before) continue;
    const auto live = std::ranges::find(kLive, flag, &LiveSetting::flag);
    const bool is_live = live != kLive.end();
    (is_live ? change.used : change.waiting).push_back(flag + " is " + now + ", was " + before);
    if (!is_live) continue;
    live->copy(fresh, config);
    const auto given = fresh.given.find(flag);
    if (given == fresh.given.end()) {
      config->given.erase(flag);
    } else {
      config->given[flag] = given->second;
    }
  }
  return change;
}

}  // namespace choreo
