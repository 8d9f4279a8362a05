#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "model/evaluation/evaluation.h"
#include "model/training/clips/clip_split.h"

namespace choreo {

/// The methods to compare, as requested on the command line.
struct ContestOptions {
  std::filesystem::path model;  ///< checkpoint
  std::vector<std::string> baselines = {"real", "interpolation", "music_only"};
  std::vector<std::string> others;  ///< NAME=CHECKPOINT
  std::string engine = "auto";      ///< as ParseEngineKind reads it
  std::string name = "model";       ///< the judged model's name in tables
};

/// The engines of an evaluation and the methods that use them, the judged one last.
struct Contest {
  std::vector<std::unique_ptr<Sampler>> samplers;
  std::vector<Method> methods;
  std::string engine;  ///< "packed float32; torch for Harvey et al. 2020"

  Sampler& judged() const { return *samplers.front(); }
};

/// Loads the models. Throws Error(kInvalidArgument, "--other") for text that is not
/// NAME=CHECKPOINT, a name that another row has (the field is --name if the judged model has it),
/// or a model on another skeleton; otherwise what MakeSampler throws. Checks names before it loads
/// anything.
Contest MakeContest(const ContestOptions& options);

/// Loads the clips of each folder in the group `split`, with their beats, as a set named after the
/// folder. Throws Error(kInvalidArgument, "--data") for two folders with one name, or a skeleton
/// other than `skeleton`; otherwise what LoadClips throws.
std::vector<ClipSet> LoadSets(const std::vector<std::filesystem::path>& folders,
                              const std::filesystem::path& splits, const std::string& split,
                              const Skeleton& skeleton);
/// The names of LoadSets' sets, with the same checks of names, without reading the folders.
std::vector<std::string> SetNames(const std::vector<std::filesystem::path>& folders);

}  // namespace choreo
