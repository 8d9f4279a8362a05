#pragma once

#include <atomic>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/messages/figures_path.h"
#include "model/messages/style_figures.h"
#include "server/model_folder.h"
#include "tests/server/fixture.h"
#include "tests/support/temporary_folder.h"

namespace choreo {

/// A model of the name and version that a file has; versions dance differently.
class VersionedSampler final : public FakeSampler {
 public:
  VersionedSampler(const std::string& name, int version, std::optional<StyleFigures> figures,
                   std::shared_ptr<std::atomic<int>> alive)
      : version_(version), alive_(std::move(alive)) {
    model_.name = name;
    model_.style_figures = figures;
    model_.fingerprint = name + "-" + std::to_string(version);
    ++*alive_;
  }
  ~VersionedSampler() override { --*alive_; }
  void OnFrame(const TransitionSpec& /*spec*/, Plan* plan) override {
    plan->poses.back().rotations(2, 20) += 0.01 * version_;
  }

 private:
  const int version_;
  const std::shared_ptr<std::atomic<int>> alive_;
};

/// A folder of models that changes while clients dance.
class ReloadTest : public ServerTest {
 protected:
  // The server goes before `alive` does.
  ~ReloadTest() override { server.reset(); }

  // Atomically, as trainers should.
  void Write(const std::string& file, const std::string& content) {
    std::ofstream(models / "written") << content;
    std::filesystem::rename(models / "written", models / file);
  }

  void StartFolder() {
    ServerConfig config;
    config.listen = "127.0.0.1:0";
    config.max_load = 2;
    Connect(std::make_unique<Server>(config, folder.Load()));
  }

  void Reload() {
    folder.Reload(*server, [] { return false; });
  }

  Server::Samplers Load(const std::filesystem::path& file) {
    ++loaded;
    std::string name;
    int version = 0;
    if (!(std::ifstream(file) >> name >> version)) throw InvalidArgument(file, "no model");
    Server::Samplers samplers;
    samplers.push_back(std::make_unique<VersionedSampler>(name, version, Figures(file), alive));
    return samplers;
  }

  // Those of a number in the file of figures.
  static std::optional<StyleFigures> Figures(const std::filesystem::path& checkpoint) {
    StyleFigures figures;
    if (!(std::ifstream(StyleFiguresFile(checkpoint)) >> figures.recognised)) return std::nullopt;
    return figures;
  }

  static v1::DanceConfig ConfigOf(const std::string& model, int frames = 90) {
    v1::DanceConfig config = Config();
    config.set_model(model);
    config.set_frames(frames);
    return config;
  }

  // Begins a dance and stops it in the middle.
  std::unique_ptr<DanceClient> Begin(const std::string& model) {
    auto client = std::make_unique<DanceClient>(stub());
    client->Send(ConfigOf(model));
    client->SendGenerateUntil(30);
    EXPECT_TRUE(client->ReadFrames(30));
    return client;
  }
  Answer Whole(const std::string& model) {
    v1::StreamDanceRequest request;
    *request.mutable_config() = ConfigOf(model);
    return Dance({request});
  }

  std::vector<std::string> Served() {
    grpc::ClientContext context;
    v1::GetServerInfoResponse info;
    EXPECT_TRUE(stub().GetServerInfo(&context, {}, &info).ok());
    std::vector<std::string> served;
    for (const v1::ModelInfo& model : info.models()) served.push_back(model.fingerprint());
    return served;
  }

  void ExpectAlive(int count) {
    ExpectEventually([&] { return *alive == count; }, std::to_string(count) + " engines are left");
  }

  TemporaryFolder models;
  std::shared_ptr<std::atomic<int>> alive = std::make_shared<std::atomic<int>>(0);
  int loaded = 0;
  ModelFolder folder{models.path(), [this](const auto& file) { return Load(file); }};
};

}  // namespace choreo
