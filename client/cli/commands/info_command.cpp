#include <cstdio>
#include <iomanip>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "client/authoring/keys/pose_library.h"
#include "client/cli/commands/commands.h"
#include "client/cli/options/connection.h"
#include "client/describe_styles.h"
#include "model/core/text/counted.h"
#include "model/motion/controls/controls.h"

namespace choreo::cli {
namespace {

struct InfoOptions {
  ServerOptions server;
  bool json = false;
  bool poses = false;
  bool cards = false;
};

/// {"name": "median", "trunk": 0.012, ...}: metres a frame.
nlohmann::ordered_json ToJson(const VelocityReference& reference) {
  nlohmann::ordered_json out;
  out["name"] = reference.name;
  for (size_t part = 0; part < reference.speeds.size(); ++part)
    out[std::string(kBodyPartNames[part])] = reference.speeds[part];
  return out;
}

nlohmann::ordered_json ToJson(const client::ModelDescription& model) {
  nlohmann::ordered_json out;
  out["name"] = model.name;
  out["fingerprint"] = model.fingerprint;
  out["fps"] = model.fps;
  out["history_frames"] = model.history_frames;
  out["default_temperature"] = model.default_temperature;
  out["latency_frames"] = model.latency_frames;
  out["max_transition_frames"] = model.max_transition_frames;
  out["controls"] = model.controls;
  out["takes_music"] = model.takes_music;
  out["deterministic"] = model.deterministic;
  out["likelihood"] = model.likelihood;
  out["styles"] = model.styles;
  if (const auto& figures = model.style_figures)
    out["styles_recognised"] = {{"percent", figures->recognised},
                                {"chance_percent", figures->chance},
                                {"shows", figures->shows()}};
  out["velocity_references"] = nlohmann::ordered_json::array();
  for (const auto& reference : model.velocity_references)
    out["velocity_references"].push_back(ToJson(reference));
  out["skeleton"] = {{"name", model.skeleton.name}, {"joints", model.skeleton.joint_names}};
  out["licence"] = model.licence;
  // The card is JSON of the model's own; shown as text if a server sends anything else.
  const auto card = nlohmann::ordered_json::parse(model.card, nullptr, false);
  out["card"] = card.is_discarded() ? nlohmann::ordered_json(model.card) : card;
  return out;
}

/// Formats JSON for people: strings without quotes, lists and objects as "name value, name value".
std::string Plain(const nlohmann::ordered_json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) {
    std::ostringstream number;
    number << std::setprecision(4) << value.get<double>();
    return number.str();
  }
  if (!value.is_structured()) return value.dump();
  std::string text;
  for (const auto& [name, member] : value.items()) {
    text += text.empty() ? "" : ", ";
    text += (value.is_object() ? name + " " : "") + Plain(member);
  }
  return text;
}

/// Prints how the checkpoints from which training continued were trained, the latest first.
void PrintAncestors(const nlohmann::ordered_json& card) {
  const nlohmann::ordered_json unknown = "?";
  const nlohmann::ordered_json* from = &card;
  while (from->is_object() && from->contains("from")) {
    const nlohmann::ordered_json& parent = (*from)["from"];
    if (!parent.is_object() || !parent.contains("card") || !parent["card"].is_object()) return;
    from = &parent["card"];
    std::printf("  went on from %s: %s\n", Plain(parent.value("hash", unknown)).c_str(),
                Plain(from->value("command", unknown)).c_str());
  }
}

/// Prints a model's card: one line per member and, for the validation, one per length. --json also
/// prints everything about its ancestors.
void PrintCard(const std::string& card) {
  const auto all = nlohmann::ordered_json::parse(card, nullptr, false);
  if (!all.is_object()) return;
  for (const auto& [name, value] : all.items()) {
    if (name == "validation" && value.is_array()) {
      for (const auto& row : value) std::printf("  validation: %s\n", Plain(row).c_str());
    } else if (name == "data" && value.is_object()) {
      for (const auto& [part, content] : value.items())
        std::printf("  data, %s: %s\n", part.c_str(), Plain(content).c_str());
    } else if (name == "from") {
      PrintAncestors(all);
    } else if (name != "licence") {  // printed above
      std::printf("  %s: %s\n", name.c_str(), Plain(value).c_str());
    }
  }
}

void PrintControls(const client::ModelDescription& model) {
  if (!model.takes_music) std::printf("  takes no music\n");
  if (model.deterministic)
    std::printf("  deterministic: --seed, --temperature and --candidates change nothing\n");
  if (model.likelihood) std::printf("  likelihood (--rank-by likelihood)\n");
  for (const std::string& control : model.controls) {
    const ControlRow& row = kControls[FindControl(control)];
    std::printf("  control: %s (%s)\n", row.label.data(), row.option.data());
  }
  for (const auto& reference : model.velocity_references) {
    std::printf("  velocity reference %s, cm a frame:", reference.name.c_str());
    for (size_t part = 0; part < reference.speeds.size(); ++part)
      std::printf("%s %s %.2f", part == 0 ? "" : ",", kBodyPartNames[part].data(),
                  100 * reference.speeds[part]);
    std::printf("\n");
  }
}

void PrintStyles(const client::ModelDescription& model) {
  if (model.styles.empty()) return;
  const auto& figures = model.style_figures;
  std::printf("  styles (--style)%s:", !figures           ? ""
                                       : figures->shows() ? " that show"
                                                          : " that do not show");
  for (size_t i = 0; i < model.styles.size(); ++i)
    std::printf("%s %s", i == 0 ? "" : ",", model.styles[i].c_str());
  std::printf("\n");
  std::printf("    %s\n", client::DescribeStyles(model.style_figures).c_str());
}

void PrintServer(const client::ServerDescription& server, const InfoOptions& options) {
  if (options.json) {
    nlohmann::ordered_json out;
    out["version"] = server.version;
    out["devices"] = server.devices;
    out["workers"] = server.workers;
    out["active_streams"] = server.active_streams;
    out["draining"] = server.draining;
    out["limits"] = {{"max_audio_s", server.limits.max_audio_s},
                     {"max_keyframes", server.limits.max_keyframes},
                     {"max_transition_frames", server.limits.max_transition_frames},
                     {"max_candidates", server.limits.max_candidates},
                     {"max_streams", server.limits.max_streams},
                     {"max_message_bytes", server.limits.max_message_bytes}};
    for (const client::ModelDescription& model : server.models)
      out["models"].push_back(ToJson(model));
    std::cout << out.dump(2) << std::endl;
    return;
  }
  std::printf("choreod %s, %s, %s in progress, on", server.version.c_str(),
              Counted(server.workers, "worker").c_str(),
              Counted(server.active_streams, "call").c_str());
  for (const std::string& device : server.devices) std::printf(" %s", device.c_str());
  std::printf("\n");
  for (const client::ModelDescription& model : server.models) {
    std::printf(
        "model %s: %s at %g fps, history %d frames, latency %d frames, transitions of "
        "up to %d frames, temperature %g\n  "
        "fingerprint %s\n  licence: %s\n",
        model.name.c_str(), model.skeleton.name.c_str(), model.fps, model.history_frames,
        model.latency_frames, model.max_transition_frames, model.default_temperature,
        model.fingerprint.c_str(), model.licence.c_str());
    PrintControls(model);
    PrintStyles(model);
    if (options.cards) PrintCard(model.card);
  }
}

/// Whether the server may be serving. A failed check counts as serving, because proxies may not
/// forward health checks.
bool MayServe(const client::Client& client) {
  try {
    return client.IsServing();
  } catch (const Error&) {
    return true;
  }
}

void Run(const InfoOptions& options) {
  if (options.poses && options.json) {
    auto out = nlohmann::ordered_json::array();
    for (const authoring::LibraryPose& pose : authoring::PoseLibrary())
      out.push_back({{"id", pose.id}, {"description", pose.description}});
    std::cout << out.dump(2) << std::endl;
    return;
  }
  if (options.poses) {
    for (const authoring::LibraryPose& pose : authoring::PoseLibrary())
      std::printf("%-14s %s\n", pose.id.c_str(), pose.description.c_str());
    return;
  }
  const Connection connection(options.server);
  PrintServer(connection.server(), options);
  if (connection.server().draining) {
    std::cerr << "note: the server drains: it takes no new dances\n";
  } else if (!MayServe(connection.client())) {
    std::cerr
        << "note: the server does not serve: it is stopping, or the engine of a model fails\n";
  }
}

}  // namespace

void AddInfoCommand(CLI::App& program) {
  auto options = std::make_shared<InfoOptions>();
  options->server.even_draining = true;
  CLI::App* command =
      program.add_subcommand("info", "Show a server's models, licences, limits and devices.");
  command->add_flag("--json", options->json, "Print everything as JSON, with the model cards.");
  command->add_flag(
      "--cards", options->cards,
      "Print the models' cards, too: how each was trained, on which data, and how well it dances.");
  command->add_flag("--poses", options->poses, "List the key poses of the library instead.");
  options->server.AddTo(*command);
  command->callback([options] { Run(*options); });
}

}  // namespace choreo::cli
