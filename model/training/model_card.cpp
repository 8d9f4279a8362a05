#include "model/training/model_card.h"

#include <nlohmann/json.hpp>

namespace choreo {

nlohmann::json ModelCard(const TrainOptions& options, const std::vector<PreparedClip>& clips,
                         const std::string& hash, const NamedFigures& figures,
                         const std::string& limits) {
  nlohmann::json validation = nlohmann::json::object();
  for (const auto& [name, value] : figures) validation[name] = value;
  nlohmann::json sources = nlohmann::json::object(), terms = nlohmann::json::object();
  int64_t frames = 0;
  for (const auto& clip : clips) {
    frames += static_cast<int64_t>(clip.motion.frames.size());
    sources[clip.source] = sources.value(clip.source, 0) + 1;
    const auto stated = clip.notes.find("terms");
    const std::string of = stated == clip.notes.end() ? "not stated" : stated->second;
    terms[of] = terms.value(of, 0) + 1;
  }
  std::string licence = "as the recordings that it was trained on allow:";
  for (const auto& [of, count] : terms.items()) {
    licence += " [" + std::to_string(count.get<int>()) + " clips] " + of + ";";
  }
  nlohmann::json names = nlohmann::json::array();
  for (const auto& folder : options.data) names.push_back(folder.filename().string());
  licence.back() = '.';
  return {{"preset", options.preset},
          {"data",
           {{"names", names},
            {"clips_by_layout", sources},
            {"clips_by_terms", terms},
            {"frames", frames},
            {"hash", hash}}},
          {"licence", licence},
          {"command", options.Command()},
          {options.with_validation ? "training_clips" : "validation", validation},
          {"limits", limits}};
}

}  // namespace choreo
