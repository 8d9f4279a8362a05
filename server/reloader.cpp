#include "server/reloader.h"

#include <spdlog/spdlog.h>

#include <exception>
#include <utility>

#include "model/core/text/printable.h"
#include "server/process/service_manager.h"
#include "server/settings/live_settings.h"

namespace choreo {

Reloader::Reloader(ServerConfig config, SettingsReader read, ModelFolder* folder, Server& server,
                   std::string status)
    : read_(std::move(read)),
      folder_(folder),
      server_(server),
      status_(std::move(status)),
      config_(std::move(config)),
      thread_([this](const std::stop_token& stop) { Run(stop); }) {}

void Reloader::Request() {
  const std::lock_guard lock(mutex_);
  asked_ = true;
  wake_.notify_one();
}

bool Reloader::loads() const {
  const std::lock_guard lock(mutex_);
  return loads_;
}

double Reloader::drain_seconds() const {
  const std::lock_guard lock(mutex_);
  return config_.drain_seconds;
}

void Reloader::Run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [this] { return asked_; })) {
    asked_ = false;
    loads_ = true;
    lock.unlock();
    TellManagerOfReload();
    const std::string fault = RereadSettings();
    if (folder_ != nullptr) folder_->Reload(server_, [&stop] { return stop.stop_requested(); });
    if (!stop.stop_requested())
      TellManager("READY=1\nSTATUS=" + (fault.empty() ? status_ : Printable(fault)));
    lock.lock();
    loads_ = false;
  }
}

std::string Reloader::RereadSettings() {
  ServerConfig config, fresh;
  SettingsChange change;
  try {
    fresh = read_();
    const std::lock_guard lock(mutex_);
    change = TakeOver(fresh, &config_);
    config = config_;
  } catch (const std::exception& error) {
    server_.NoteSettingsReload(false);
    const std::string fault = std::string(error.what()) + "; all settings stay as they were";
    spdlog::error("{}", fault);
    return fault;
  }
  server_.NoteSettingsReload(true);
  if (!change.used.empty()) {
    server_.SetLimits(config);
    spdlog::set_level(spdlog::level::from_str(config.log_level));
  }
  for (const std::string& one : change.used) spdlog::info("settings: {}", one);
  for (const std::string& one : change.waiting)
    spdlog::warn("settings: {}; that needs a restart", one);
  for (const std::string& one : fresh.overridden)
    spdlog::info("settings: the flag --{} overrides the file's line", one);
  if (!change.used.empty() || !change.waiting.empty()) return "";
  spdlog::info("settings: none has changed{}",
               fresh.given.contains("config") ? "" : "; without --config there is no file to read");
  return "";
}

}  // namespace choreo
