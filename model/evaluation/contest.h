#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "model/evaluation/evaluation.h"
#include "model/training/clip_split.h"

namespace choreo {

/// The requested choice of methods to compare.
struct ContestOptions {
  std::filesystem::path model;  ///< checkpoint
  std::vector<std::string> baselines = {"real", "interpolation", "music_only"};
  std::vector<std::string> others;  ///< NAME=CHECKPOINT
  std::string engine = "auto";      ///< ParseEngineKind
  std::string name = "model";       ///< the judged model's name in tables
};

/// The engines of an evaluation and the methods that use them, the judged one last.
struct Contest {
  std::vector<std::unique_ptr<Sampler>> samplers;
  std::vector<Method> methods;
  std::string engine;  ///< "packed float32; torch for Harvey et al. 2020"

  Sampler& judged() const { return *samplers.front(); }
};

/// Throws Error(kInvalidArgument, "--other") for text that is not NAME=CHECKPOINT, a name that
/// another row has (--name, if it is that one's), or a model on another skeleton; otherwise what
/// MakeSampler throws. Checks names before loading anything.
Contest MakeContest(const ContestOptions& options);

/// The clips in each folder that belong to the group `split`, with their beats, as a set named
/// after the folder. Throws Error(kInvalidArgument, "--data") for two folders of one name, or
/// another skeleton than `skeleton`; otherwise what LoadClips throws.
std::vector<ClipSet> LoadSets(const std::vector<std::filesystem::path>& folders,
                              const std::filesystem::path& splits, const std::string& split,
                              const Skeleton& skeleton);
/// The names of those sets, with the same checks, without reading the folders.
std::vector<std::string> SetNames(const std::vector<std::filesystem::path>& folders);

}  // namespace choreo
