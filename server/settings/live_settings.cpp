#include "server/settings/live_settings.h"

#include <set>

#include "server/settings/config_flags.h"

namespace choreo {
namespace {

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
  const RereadSettings reread = SettingsToReread();
  SettingsChange change;
  for (const std::string& flag : flags) {
    const std::string before = ValueOf(*config, flag), now = ValueOf(fresh, flag);
    if (now == before) continue;
    const auto live = reread.find(flag);
    const bool is_live = live != reread.end();
    (is_live ? change.used : change.waiting).push_back(flag + " is " + now + ", was " + before);
    if (!is_live) continue;
    live->second(fresh, config);
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
