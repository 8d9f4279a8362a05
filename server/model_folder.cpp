#include "server/model_folder.h"

#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <tuple>
#include <utility>

#include "model/core/error.h"
#include "model/core/text/printable.h"
#include "model/messages/figures_path.h"
#include "model/messages/style_figures.h"
#include "network/pem.h"
#include "server/settings/fault_list.h"

namespace choreo {
namespace {

constexpr const char* kFlag = "--models";
constexpr const char* kDefault = "default.safetensors";

int64_t Nanoseconds(const timespec& time) {
  return int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

std::vector<double> NumbersOf(const std::optional<StyleFigures>& figures) {
  if (!figures) return {};
  return {figures->recognised, figures->chance, figures->low};
}

}  // namespace

std::vector<std::filesystem::path> ModelFolder::List() const {
  std::vector<std::filesystem::path> files;
  try {
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      const std::filesystem::path& path = entry.path();
      if (path.extension() == ".safetensors" && path.filename().string().front() != '.') {
        files.push_back(path);
      }
    }
  } catch (const std::filesystem::filesystem_error& error) {
    throw InvalidArgument(kFlag, folder_.string() + ": " + error.code().message());
  }
  if (files.empty()) {
    throw InvalidArgument(kFlag, folder_.string() + ": no .safetensors file is in it");
  }
  std::ranges::sort(files, {}, [](const std::filesystem::path& path) {
    return std::pair(path.filename() != kDefault, path);
  });
  return files;
}

bool ModelFolder::Has(const Files& files, const std::string& model) {
  return std::ranges::any_of(files, [&](const auto& one) { return one.second.model == model; });
}

ModelFolder::Stamp ModelFolder::StampOf(const std::filesystem::path& file) {
  struct stat status;
  if (stat(file.c_str(), &status) != 0) {
    throw InvalidArgument(kFlag, file.string() + ": " + std::generic_category().message(errno));
  }
  return {.device = status.st_dev,
          .inode = status.st_ino,
          .bytes = status.st_size,
          .written_ns = Nanoseconds(status.st_mtim),
          .changed_ns = Nanoseconds(status.st_ctim)};
}

ModelFolder::Stamp ModelFolder::FiguresStampOf(const std::filesystem::path& file) try {
  return StampOf(StyleFiguresFile(file));
} catch (const Error&) {
  return {};
}

Server::Samplers ModelFolder::LoadFile(const std::filesystem::path& file, Files* files) const {
  RequireRegularFile(kFlag, file);
  // Taken first, so that the next Reload sees changes during loading.
  const Stamp stamp = StampOf(file), figures_stamp = FiguresStampOf(file);
  Server::Samplers engines = load_(file);
  const ModelInfo& model = engines.front()->model();
  for (const auto& [other, served] : *files) {
    if (served.model == model.name) {
      throw InvalidArgument(kFlag, file.string() + ": its model \"" + model.name +
                                       "\" comes from " + other.filename().string());
    }
  }
  files->emplace(file, Served{stamp, figures_stamp, model.name, model.fingerprint, model.card,
                              NumbersOf(model.style_figures)});
  return engines;
}

std::vector<Server::Samplers> ModelFolder::Load() {
  std::vector<Server::Samplers> models;
  FaultList faults;
  for (const auto& file : List()) faults.Try([&] { models.push_back(LoadFile(file, &served_)); });
  faults.Throw();
  return models;
}

void ModelFolder::Reload(Server& server, const std::function<bool()>& stopped) {
  try {
    const std::vector<std::filesystem::path> listed = List();
    Files files;
    Faults faults;
    std::vector<Server::Samplers> fresh;
    for (const auto& file : listed) {
      if (stopped()) return;
      if (std::optional<Server::Samplers> engines = Inspect(file, &files, &faults)) {
        fresh.push_back(std::move(*engines));
      }
    }
    KeepServing(faults, &files);
    std::vector<std::string> names;
    for (const auto& file : listed) {
      // A faulty file stands for its previous model, which another file may have taken over.
      const Files& from = files.contains(file) ? files : served_;
      const auto at = from.find(file);
      if (at != from.end() && std::ranges::find(names, at->second.model) == names.end()) {
        names.push_back(at->second.model);
      }
    }
    if (names.empty()) throw InvalidArgument(kFlag, folder_.string() + ": no file can be used");
    const size_t count = fresh.size();
    if (!server.SetModels(names, std::move(fresh))) return;
    served_ = std::move(files);
    server.NoteModelReload(faults.empty());
    spdlog::info("{} of {} models are new; \"{}\" is the default", count, names.size(),
                 names.front());
  } catch (const std::exception& error) {
    server.NoteModelReload(false);
    spdlog::error("{}; all models are served as before", Printable(error.what()));
  }
}

std::optional<Server::Samplers> ModelFolder::Inspect(const std::filesystem::path& file,
                                                     Files* files, Faults* faults) const {
  try {
    const auto before = served_.find(file);
    if (before != served_.end() && StampOf(file) == before->second.stamp &&
        FiguresStampOf(file) == before->second.figures_stamp &&
        !Has(*files, before->second.model)) {
      files->insert(*before);
      return std::nullopt;
    }
    Server::Samplers engines = LoadFile(file, files);
    const Served& now = files->at(file);
    const bool is_served = std::ranges::any_of(served_, [&](const auto& other) {
      const Served& then = other.second;
      return std::tie(then.model, then.fingerprint, then.card, then.figures) ==
             std::tie(now.model, now.fingerprint, now.card, now.figures);
    });
    if (is_served) return std::nullopt;
    return engines;
  } catch (const std::exception& error) {
    faults->emplace(file, error.what());
    return std::nullopt;
  }
}

void ModelFolder::KeepServing(const Faults& faults, Files* files) const {
  for (const auto& [file, fault] : faults) {
    const auto before = served_.find(file);
    const bool goes_on = before != served_.end() && !Has(*files, before->second.model);
    spdlog::error("{}; {}", Printable(fault),
                  goes_on ? "its model \"" + before->second.model + "\" is served as before"
                          : "nothing is served of it");
    if (goes_on) files->insert(*before);
  }
}

}  // namespace choreo
