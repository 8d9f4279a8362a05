#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/interruption.h"
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
  CLI::App* command = program.add_subcommand(
      "studio",
      "Compose dances in the browser: a song, key poses on its beats, and the dance that goes "
      "through them.\n"
      "Serves a page on this machine and says where; nothing that the page does leaves it.");
  command->add_option("song", options->song, "Song to begin with; others are dropped on the page.")
      ->check(CLI::ExistingFile);
  command
      ->add_option("--listen", options->listen,
                   "HOST:PORT to serve the page at; port 0 takes a free one. Whoever reaches it "
                   "can use the studio: it knows no passwords.")
      ->capture_default_str();
  options->server.AddTo(*command);
  command->callback([options] { Run(*options); });
}

}  // namespace choreo::cli
