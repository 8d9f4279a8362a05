#include "model/training/model_card.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace choreo {

namespace {

const nlohmann::json kNothing;

}  // namespace

nlohmann::json ModelCard(const TrainOptions& options, const std::vector<PreparedClip>& clips,
                         const std::string& hash, const NamedFigures& figures,
                         const std::string& limits, const nlohmann::json& from) {
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
  // What a model went on from binds it, too.
  nlohmann::json all_terms = terms;
  for (const nlohmann::json* base = &from; base->is_object() && base->contains("card");
       base = base->at("card").contains("from") ? &base->at("card").at("from") : &kNothing) {
    const auto data = base->at("card").value("data", nlohmann::json::object());
    const auto bound = data.value("clips_by_terms", nlohmann::json::object());
    for (const auto& [of, count] : bound.items())
      all_terms[of] = std::max(all_terms.value(of, 0), count.get<int>());
  }
  std::string licence = "as the recordings that it was trained on allow:";
  for (const auto& [of, count] : all_terms.items()) {
    licence += " [" + std::to_string(count.get<int>()) + " clips] " + of + ";";
  }
  nlohmann::json names = nlohmann::json::array();
  for (const auto& folder : options.data) names.push_back(folder.filename().string());
  licence.back() = '.';
  nlohmann::json card = {{"preset", options.preset},
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
  if (!from.is_null()) card["from"] = from;
  return card;
}

}  // namespace choreo
