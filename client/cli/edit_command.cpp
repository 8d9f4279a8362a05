#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/control_options.h"
#include "client/cli/key_file.h"
#include "client/cli/music.h"
#include "client/cli/options.h"
#include "client/cli/output_file.h"
#include "client/cli/pose_source.h"
#include "client/cli/report.h"
#include "client/edit.h"
#include "model/core/atomic_file.h"
#include "model/core/rounded.h"
#include "model/formats/motion_file.h"
#include "model/formats/npz.h"
#include "model/motion/canonical.h"
#include "model/motion/resample.h"

namespace choreo::cli {
namespace {

struct EditOptions {
  ServerOptions server;
  std::string dance;
  std::vector<std::string> keys;
  std::vector<double> at_s;
  bool in_place = false;
  bool loop = false;
  std::optional<double> around_s;
  std::string song;
  std::string report;
  std::string new_report;
  std::optional<uint64_t> seed;
  std::optional<double> temperature;
  ControlOptions controls;
  std::string model;
  std::string out;
};

constexpr double kAround = 2;  // seconds, where nothing says how far an edit may reach

void CheckOptions(const EditOptions& options) {
  if (options.keys.empty() && !options.loop) {
    throw InvalidArgument("--key", "is missing, and so is --loop: nothing is to be changed");
  }
  if (options.keys.size() != options.at_s.size()) {
    throw InvalidArgument("--at", std::to_string(options.at_s.size()) + " times for " +
                                      std::to_string(options.keys.size()) +
                                      " keys; each --key needs one");
  }
  RequireMotionFile(options.out);
  std::vector<NamedFile> inputs = options.controls.Files();
  inputs.push_back({"dance", options.dance});
  inputs.push_back({"--report", options.report});
  inputs.push_back({"--song", options.song});
  for (const std::string& key : options.keys) inputs.push_back({"--key", FileOf(key)});
  RequireOutputs({{"--out", options.out}, {"--new-report", options.new_report}}, inputs);
  if (options.report.empty() && !options.new_report.empty()) {
    throw InvalidArgument("--new-report", "needs --report, which it is made of");
  }
}

client::FinishedDance ReadDance(const std::filesystem::path& path, const Skeleton& skeleton) {
  client::FinishedDance dance;
  // A retargeted dance would not be the one that was to stay as it is.
  dance.motion = ReadMotion(path, skeleton, OtherSkeleton::kRefuse);
  if (SmallExtension(path) != ".npz") return dance;
  const NpzArchive npz = NpzArchive::Read(path);
  if (!npz.Has("contacts")) return dance;
  const NpyArray array = npz.Array("contacts");
  if (array.shape != std::vector{static_cast<int64_t>(dance.motion.frames.size()), int64_t{4}}) {
    throw InvalidArgument(path.string() + ":contacts",
                          "has not four values for each of the " +
                              std::to_string(dance.motion.frames.size()) + " frames");
  }
  const std::vector<float> values = array.As<float>();
  dance.contacts.resize(dance.motion.frames.size());
  for (size_t i = 0; i < values.size(); ++i) dance.contacts[i / 4][i % 4] = values[i];
  return dance;
}

/// A dance while its keys are changed, one after another.
class Session {
 public:
  Session(const EditOptions& options, const Connection& connection)
      : options_(options), client_(connection.client()) {
    edit_.model = connection.model(options.model);
    edit_.seed = options.seed.value_or(0);
    edit_.temperature = options.temperature;
    edit_.controls = options.controls.Read(edit_.model, connection.server());
    NoteDeterministic(edit_.model, {{"--seed", options.seed.has_value()},
                                    {"--temperature", edit_.temperature.value_or(0) != 0}});
    longest_ = edit_.model.max_transition_frames - 1;
    if (options.around_s) CheckAround(*options.around_s);
    CheckKeys();
    dance_ = ReadDance(options.dance, edit_.model.skeleton);
    frames_ = CountModelFrames(dance_, edit_.model);
    options.controls.RequireBegun(edit_.controls, {frames_, edit_.model.fps});
    if (!options.song.empty()) {
      const Music music = ReadMusic(options.song, Seconds(frames_));
      edit_.audio = AudioFor(music.audio, Seconds(frames_));
      edit_.music_beats = BeatsBefore(music, Seconds(frames_));
    }
    if (!options.report.empty()) ReadKeys();
  }

  void SetKey(const std::string& source, double at_s) {
    const NamedPose named = ReadPose(source, edit_.model.skeleton);
    const int64_t frame = Frame(at_s);
    if (frame >= frames_) {
      throw InvalidArgument("--at", InFull(at_s) +
                                        " s lies behind the dance, which has its last frame at " +
                                        Rounded(Seconds(frames_ - 1)) + " s");
    }
    client::KeyEdit edit;
    edit.key = named.key;
    edit.key.frame = frame;
    if (!named.has_place || options_.in_place) {
      const GroundFrame here = GroundFrame::Of(PoseAt(dance_.motion, Seconds(frame)));
      edit.key.pose =
          here.ToWorld(named.has_place ? GroundFrame::Of(named.key.pose).ToLocal(named.key.pose)
                                       : named.key.pose);
    }
    edit.from = frame == 0 ? -1 : Before(frame);
    edit.to = frame == frames_ - 1 ? frames_ : Behind(frame);
    if (const auto next = keys_.find(edit.to); next != keys_.end())
      edit.to_id = next->second["id"].get<std::string>();
    DropWarnings(edit.from, edit.to);
    Take(client::SetKey(client_, dance_, edit_, edit), "key " + edit.key.id);
  }

  void CloseLoop() {
    const int64_t from = std::max<int64_t>(0, frames_ - 1 - Around());
    for (auto key = keys_.upper_bound(from); key != keys_.end(); key = keys_.erase(key)) {
      std::cerr << "warning: key " << key->second["id"].get<std::string>() << " at "
                << Rounded(Seconds(key->first)) << " s makes way for the loop\n";
    }
    DropWarnings(from, frames_);
    Take(client::CloseLoop(client_, dance_, edit_, from), "loop");
  }

  void Write() const {
    WriteMotion(options_.out, edit_.model.skeleton, dance_.motion,
                dance_.contacts.empty() ? nullptr : &dance_.contacts);
    std::cout << options_.out << std::endl;
    if (options_.new_report.empty()) return;
    // Of the old report, only what still holds.
    nlohmann::ordered_json report = {{"frames", frames_}, {"fps", edit_.model.fps}};
    report["keyframes"] = nlohmann::ordered_json::array();
    for (const auto& [frame, key] : keys_) report["keyframes"].push_back(key);
    report["warnings"] = WarningsJson(warnings_);
    WriteFile(options_.new_report, report.dump(2) + "\n");
  }

 private:
  int64_t Frame(double seconds) const { return std::llround(seconds * edit_.model.fps); }
  double Seconds(int64_t frame) const { return static_cast<double>(frame) / edit_.model.fps; }

  void ReadKeys() {
    const auto report = ReadReport(options_.report);
    if (report["fps"] != edit_.model.fps) {
      std::ostringstream message;
      message << report["fps"].dump() << ", but the model runs at " << edit_.model.fps;
      throw InvalidArgument(options_.report + ":fps", message.str());
    }
    for (const auto& key : report["keyframes"]) {
      const auto frame = key["frame"].get<int64_t>();
      if (frame >= frames_) {
        throw InvalidArgument(options_.report + ":keyframes",
                              key["id"].get<std::string>() + " stands at frame " +
                                  std::to_string(frame) + ", but the dance has " +
                                  std::to_string(frames_) + ": it is the report of another one");
      }
      keys_[frame] = key;
    }
    warnings_ = ReadWarnings(report, options_.report);
  }

  void CheckKeys() const {
    std::map<int64_t, std::string> sources;  // by frame
    for (size_t i = 0; i < options_.keys.size(); ++i) {
      const auto [same, is_new] = sources.emplace(Frame(options_.at_s[i]), options_.keys[i]);
      if (!is_new) {
        throw InvalidArgument("--key", same->second + " and " + options_.keys[i] +
                                           " both ask for frame " + std::to_string(same->first));
      }
    }
  }
  void CheckAround(double seconds) const {
    constexpr double kLeast = 2;  // frames
    const double frames = std::round(seconds * edit_.model.fps);
    if (frames >= kLeast && frames <= static_cast<double>(longest_)) return;
    std::ostringstream message;
    message << seconds << " s, must be " << Rounded(kLeast / edit_.model.fps) << " to "
            << Rounded(Seconds(longest_)) << " s: " << kLeast << " to " << longest_ << " frames";
    throw InvalidArgument("--around", message.str());
  }
  int64_t Around() const {
    return std::min(
        longest_,
        static_cast<int64_t>(std::llround(options_.around_s.value_or(kAround) * edit_.model.fps)));
  }
  /// How far the edit of a key may reach at most, in frames.
  int64_t Reach() const {
    return options_.around_s || options_.report.empty() ? Around() : longest_;
  }
  /// The last frame before a key that stays, and the first behind it: those of other keys, where
  /// they are known and near enough.
  int64_t Before(int64_t frame) const {
    const auto next = keys_.lower_bound(frame);
    const int64_t key = next == keys_.begin() ? 0 : std::prev(next)->first;
    return std::max({int64_t{0}, key, frame - Reach()});
  }
  int64_t Behind(int64_t frame) const {
    const auto next = keys_.upper_bound(frame);
    const int64_t key = next == keys_.end() ? frames_ - 1 : next->first;
    return std::min({frames_ - 1, key, frame + Reach()});
  }

  /// What was said of frames that are danced anew, and of the way to `to`: of a loop, too, where
  /// the first frame is another one now.
  void DropWarnings(int64_t from, int64_t to) {
    std::erase_if(warnings_, [&](const client::Warning& warning) {
      const bool anew = warning.frame > from && warning.frame <= to;
      return anew || (from < 0 && warning.frame >= frames_);
    });
  }

  void Take(client::EditedDance edited, const std::string& what) {
    ShowWarnings(edited.warnings);
    warnings_.insert(warnings_.end(), edited.warnings.begin(), edited.warnings.end());
    dance_ = std::move(edited.dance);
    std::cout << what << ": frames " << edited.first_changed << " to " << edited.end_changed - 1
              << " of " << dance_.motion.frames.size() << " are new";
    for (const client::KeyReached& key : edited.keys) {
      keys_[key.frame] = KeyJson(key);
      std::cout << "; hit at " << Rounded(Seconds(key.frame)) << " s within "
                << Rounded(1000 * key.final_error_m) << " mm and " << Rounded(key.final_error_deg)
                << " degrees";
    }
    std::cout << std::endl;
  }

  const EditOptions& options_;
  const client::Client& client_;
  client::EditOptions edit_;
  int64_t longest_ = 0;
  client::FinishedDance dance_;
  int64_t frames_ = 0;                              // at the model's rate
  std::map<int64_t, nlohmann::ordered_json> keys_;  // those known, by frame
  std::vector<client::Warning> warnings_;           // of the report and of the edits
};

void Run(const EditOptions& options) {
  CheckOptions(options);
  const Connection connection(options.server);
  Session session(options, connection);
  try {
    for (size_t i = 0; i < options.keys.size(); ++i)
      session.SetKey(options.keys[i], options.at_s[i]);
    if (options.loop) session.CloseLoop();
  } catch (const Error& error) {
    throw options.controls.InTermsOf(error);
  }
  session.Write();
}

}  // namespace

void AddEditCommand(CLI::App& program) {
  auto options = std::make_shared<EditOptions>();
  CLI::App* command = program.add_subcommand(
      "edit",
      "Set key poses into a finished dance, or close it to a loop.\n"
      "Only the two intervals around a key are danced anew; every other frame stays as it is, bit "
      "for bit. They end at the neighbouring keys, if --report names them, else --around seconds "
      "away. A key at the frame of another one replaces it.");
  command->add_option("dance", options->dance, ".npz, .bvh or .glb file.")
      ->required()
      ->check(CLI::ExistingFile);
  AddRepeated(*command, "-k,--key", options->keys,
              "A pose of the library (kick, ...), which is set where the dancer is; or a "
              "key file, or MOTION@SECOND. May be given more than once, each with its --at.");
  AddRepeated(*command, "--at", options->at_s, "Second of the dance for the key.")
      ->check(TimeInSeconds());
  command->add_flag("--in-place", options->in_place,
                    "Set poses of files, too, where the dancer is and faces at that moment.");
  command->add_flag("--loop", options->loop,
                    "Lead the last frames back into the first, so that the dance can be repeated.");
  command
      ->add_option("--around", options->around_s,
                   "Seconds that may change before and behind a key, or before the end of a loop. "
                   "Default: up to the neighbouring keys of --report; 2 without it.")
      ->check(AboveZero());
  command->add_option("--song", options->song, "Music that the dance was made to.")
      ->check(CLI::ExistingFile);
  command->add_option("--report", options->report, "Report of the dance, which names its keys.")
      ->check(CLI::ExistingFile);
  command->add_option("--new-report", options->new_report,
                      "JSON file to write the keys of the new dance to, for the next edit, and the "
                      "warnings of its edits and of frames that stay.");
  AddSeed(*command, options->seed, "Same seed, same edit. Default: 0. " + kOfChance);
  AddTemperature(*command, options->temperature);
  options->controls.AddTo(*command);
  command->add_option("-m,--model", options->model, "Model of the server; default: its first.");
  command->add_option("-o,--out", options->out, "FILE.npz, FILE.bvh or FILE.glb to write.")
      ->required();
  options->server.AddTo(*command);
  command->callback([options] { Run(*options); });
}

}  // namespace choreo::cli
