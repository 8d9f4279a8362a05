#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "client/cli/commands/commands.h"
#include "client/cli/options/connection.h"
#include "client/cli/options/interruption.h"
#include "studio/server_supervisor.h"
#include "studio/web_server.h"

namespace choreo::cli {
namespace {

struct StudioOptions {
  ServerOptions server;
  std::string song;
  std::string listen = "127.0.0.1:8765";
};

std::filesystem::path ProgramFolder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

void Run(const StudioOptions& options) {
  const Interruption interruption;
  client::Options server = options.server.ForClient();
  std::optional<studio::ServerSupervisor> own;
  if (options.server.addresses.empty()) {
    own.emplace(ProgramFolder() / "choreod");
    server.addresses = {own->address()};
  }
  server.before_retry = [] { Interruption::Check(); };
  // The folder where scripts/photo_model.sh puts it: beside the program, built or installed.
  const std::filesystem::path photo_model = ProgramFolder().parent_path() / "share/choreo/photo";
  const studio::StudioContext context(server, options.song, photo_model);
  studio::WebServer web(options.listen, context);
  std::cout << "The studio is open at " << web.url() << "  (Ctrl-C closes it)" << std::endl;
  web.Run([] { return !Interruption::Came(); });
}

}  // namespace

void AddStudioCommand(CLI::App& program) {
  auto options = std::make_shared<StudioOptions>();
  CLI::App* command =
      program.add_subcommand("studio",
                             "Compose dances in the browser: a song, key poses on its beats, and "
                             "the dance through them.\nServes a page on this machine and prints "
                             "its address. Nothing on the page leaves the machine.");
  command
      ->add_option("song", options->song,
                   "Song to begin with. More songs can be dropped on the page.")
      ->check(CLI::ExistingFile);
  command
      ->add_option("--listen", options->listen,
                   "HOST:PORT of the page; port 0 takes a free one. The studio has no passwords: "
                   "whoever reaches it can use it.")
      ->capture_default_str();
  options->server.AddTo(*command);
  command->callback([options] { Run(*options); });
}

}  // namespace choreo::cli
