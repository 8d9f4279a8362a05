// A choreod with a fake engine that takes controls: its settings and its life are choreod's, its
// checkpoints are not. A file of a line is one that takes as long to load as the file that the line
// names takes to be read. $FAKE_FINGERPRINT makes it a replica of another build.
#include <spdlog/spdlog.h>

#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "server/serve.h"
#include "server/telemetry/log.h"
#include "tests/support/fake_sampler.h"

namespace {

class Sampler final : public choreo::ControlledSampler {
 public:
  Sampler() {
    if (const char* fingerprint = std::getenv("FAKE_FINGERPRINT")) model_.fingerprint = fingerprint;
  }
};

choreo::Server::Samplers Load(const std::filesystem::path& path) {
  std::string slow;
  if (std::getline(std::ifstream(path), slow)) {
    std::ifstream file(slow);
    const std::string read(std::istreambuf_iterator<char>(file), {});
  }
  choreo::Server::Samplers samplers;
  samplers.push_back(std::make_unique<Sampler>());
  return samplers;
}

}  // namespace

int main(int argc, char** argv) {
  choreo::OpenStandardStreams();
  choreo::CommandLine command_line = choreo::ParseCommandLine(argc, argv);
  if (!command_line.config) return command_line.exit_code;
  choreo::ServerConfig& config = *command_line.config;
  if (config.checkpoints.empty()) config.checkpoints = {"/dev/null"};  // which loads at once
  choreo::StartLog(config.log_level, config.log_format == "json");
  choreo::HoldSignals();
  try {
    choreo::Serve(config, Load, [&] { return choreo::RereadConfig(argc, argv); });
    return 0;
  } catch (const std::exception& error) {
    spdlog::critical("{}", error.what());
    return choreo::ExitCodeOf(error);
  }
}
