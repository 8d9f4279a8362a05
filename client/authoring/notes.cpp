#include "client/authoring/notes.h"

#include <utility>

namespace choreo::authoring {
namespace {

NoteSink& Sink() {
  static NoteSink sink;
  return sink;
}

}  // namespace

void SetNoteSink(NoteSink sink) { Sink() = std::move(sink); }

void Note(const std::string& line) {
  if (Sink()) Sink()(line);
}

}  // namespace choreo::authoring
