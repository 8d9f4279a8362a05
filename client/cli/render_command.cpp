#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "client/cli/commands.h"
#include "client/cli/report.h"
#include "model/draw/contact_sheet.h"
#include "model/formats/motion_file.h"

namespace choreo::cli {
namespace {

struct RenderOptions {
  std::string motion;
  std::string out;
  std::string report;
  ContactSheetOptions sheet;
};

/// The frames of the motion at which a dance's report has its keys.
std::vector<int64_t> KeyFrames(const std::string& path, const Motion& motion) {
  const auto report = ReadReport(path);
  std::vector<int64_t> frames;
  for (const auto& key : report["keyframes"]) {
    const double seconds = key.at("frame").get<double>() / report["fps"].get<double>();
    const int64_t frame = std::llround(seconds * motion.fps);
    if (frame < static_cast<int64_t>(motion.frames.size())) frames.push_back(frame);
  }
  return frames;
}

void Run(RenderOptions options) {
  const Motion motion = ReadMotion(options.motion, Skeleton::Smpl24());
  if (!options.report.empty()) options.sheet.key_frames = KeyFrames(options.report, motion);
  if (options.sheet.title.empty())
    options.sheet.title = std::filesystem::path(options.motion).filename().string();
  DrawContactSheet(Skeleton::Smpl24(), motion, options.sheet, options.out);
}

}  // namespace

void AddRenderCommand(CLI::App& program) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = program.add_subcommand("render", "Draw a motion as a contact sheet.");
  command->add_option("motion", options->motion, ".npz, .bvh or .glb file.")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("-o,--out", options->out, "PNG file to write.")->required();
  command
      ->add_option("--report", options->report,
                   "Report of the dance: its key poses are highlighted.")
      ->check(CLI::ExistingFile);
  command->add_option("--frames", options->sheet.frames, "Frames to show, evenly spaced.")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--columns", options->sheet.columns, "Frames in a row.")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command->add_option("--title", options->sheet.title, "Heading; default: the file's name.");
  command->callback([options] { Run(*options); });
}

}  // namespace choreo::cli
