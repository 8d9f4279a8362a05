#include "model/evaluation/judges/contest.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "model/core/error.h"
#include "model/core/files/safetensors.h"
#include "model/evaluation/judges/interpolation_sampler.h"
#include "model/metrics/song_beats.h"
#include "model/samplers/samplers.h"

namespace choreo {
namespace {

const char* const kFree = "model without keys";
const char* const kFootworkLine = "interpolation, footwork";

struct Other {
  std::string name;
  std::filesystem::path checkpoint;
};

std::vector<Other> ParseOthers(const std::vector<std::string>& texts, const std::string& judged) {
  std::set<std::string> taken = {kFree, "real", "interpolation", kFootworkLine};
  if (!taken.insert(judged).second)
    throw InvalidArgument("--name", "'" + judged + "': another row is called so");
  std::vector<Other> others;
  for (const std::string& text : texts) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw InvalidArgument("--other", "'" + text + "' is not NAME=CHECKPOINT");
    const std::string name = text.substr(0, equals);
    if (!taken.insert(name).second)
      throw InvalidArgument("--other", "'" + text + "': another row is called '" + name + "'");
    others.push_back({name, text.substr(equals + 1)});
  }
  return others;
}

// The engine of a model. For float32, the instruction set does not matter.
std::string EngineOf(const ModelInfo& model, EngineKind kind) {
  if (model.packed_kernels.empty()) return "torch";
  return "packed " + (kind == EngineKind::kPacked ? "float32" : model.packed_kernels);
}

// Whether a network was trained with keys: all but paper F's --no-keys.
bool LearntKeys(const std::filesystem::path& checkpoint) {
  const auto metadata = ReadSafetensors(checkpoint).metadata;
  const auto config = metadata.find("config");
  return config == metadata.end() || nlohmann::json::parse(config->second).value("keys", true);
}

}  // namespace

Contest MakeContest(const ContestOptions& options) {
  using Kind = Method::Kind;
  const std::vector<Other> others = ParseOthers(options.others, options.name);
  const EngineKind kind = ParseEngineKind(options.engine);
  Contest contest;
  const auto add = [&](std::unique_ptr<Sampler> sampler) {
    contest.samplers.push_back(std::move(sampler));
    return contest.samplers.back().get();
  };
  Sampler* judged = add(MakeSampler(options.model, Device{}, kind));
  const ModelInfo& model = judged->model();
  contest.engine = EngineOf(model, kind);
  const std::set<std::string> baselines(options.baselines.begin(), options.baselines.end());
  if (baselines.contains("real")) contest.methods.push_back({"real", Kind::kReal});
  if (baselines.contains("interpolation")) {
    contest.methods.push_back({"interpolation", Kind::kInterpolation});
    contest.methods.push_back({kFootworkLine, Kind::kModel,
                               add(std::make_unique<InterpolationSampler>(model)), true, false});
  }
  if (baselines.contains("music_only"))
    contest.methods.push_back({kFree, Kind::kModel, judged, false});
  for (const Other& other : others) {
    Sampler* sampler = add(MakeSampler(other.checkpoint, Device{}, kind));
    if (!(sampler->model().skeleton == model.skeleton)) {
      throw InvalidArgument("--other", "'" + other.checkpoint.string() +
                                           "' dances on another skeleton than the model");
    }
    contest.methods.push_back({other.name, Kind::kModel, sampler, LearntKeys(other.checkpoint)});
    const std::string by = EngineOf(sampler->model(), kind);
    if (by != EngineOf(model, kind)) contest.engine += "; " + by + " for " + other.name;
  }
  contest.methods.push_back({options.name, Kind::kModel, judged, LearntKeys(options.model)});
  return contest;
}

std::vector<std::string> SetNames(const std::vector<std::filesystem::path>& folders) {
  std::vector<std::string> names;
  for (const std::filesystem::path& folder : folders) {
    const auto plain = folder.has_filename() ? folder : folder.parent_path();
    names.push_back(plain.filename().string());
    if (std::ranges::count(names, names.back()) > 1) {
      throw InvalidArgument("--data", "'" + folder.string() + "': another set is called '" +
                                          names.back() + "', after its folder");
    }
  }
  return names;
}

std::vector<ClipSet> LoadSets(const std::vector<std::filesystem::path>& folders,
                              const std::filesystem::path& splits, const std::string& split,
                              const Skeleton& skeleton) {
  const std::vector<std::string> names = SetNames(folders);
  std::vector<ClipSet> sets;
  for (size_t i = 0; i < folders.size(); ++i) {
    sets.push_back({names[i], LoadClips({folders[i]}, splits, split)});
    for (const PreparedClip& clip : sets.back().clips)
      sets.back().beats.push_back(SongBeats(clip.audio, clip.motion.fps));
    const Skeleton& theirs = sets.back().clips.front().skeleton;
    if (!(theirs == skeleton)) {
      throw InvalidArgument("--data", folders[i].string() + ": the clips' skeleton is " +
                                          theirs.Describe() + ", the model's " +
                                          skeleton.Describe());
    }
  }
  return sets;
}

}  // namespace choreo
