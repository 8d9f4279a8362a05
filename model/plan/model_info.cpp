#include "model/plan/model_info.h"

#include "model/core/error.h"
#include "model/core/text/nearest.h"

namespace choreo {

void CheckStyle(const ModelInfo& model, const std::string& style) {
  if (style.empty() || std::ranges::find(model.styles, style) != model.styles.end()) return;
  if (style.size() > kMaxIdLength) {
    throw InvalidArgument("style", "has " + std::to_string(style.size()) + " bytes, at most " +
                                       std::to_string(kMaxIdLength));
  }
  throw InvalidArgument("style", "\"" + style + "\" is not a style of the model " + model.name +
                                     "; " + DidYouMean(style, model.styles));
}

}  // namespace choreo
