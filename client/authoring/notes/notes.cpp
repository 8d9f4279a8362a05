#include "client/authoring/notes/notes.h"

#include <utility>

namespace choreo::authoring {
namespace {

NoteSink& Sink() {
  static NoteSink sink;
  return sink;
}

thread_local NotesApart* innermost = nullptr;

}  // namespace

NotesApart::NotesApart() : outer_(std::exchange(innermost, this)) {}
NotesApart::~NotesApart() { innermost = outer_; }

void SetNoteSink(NoteSink sink) { Sink() = std::move(sink); }

void Note(const std::string& line) {
  if (innermost)
    innermost->lines_.push_back(line);
  else if (Sink())
    Sink()(line);
}

std::string NoteAbout(const std::string& whom, const std::string& line) {
  for (const std::string kind : {"note: ", "warning: "})
    if (line.starts_with(kind)) return kind + whom + ": " + line.substr(kind.size());
  return whom + ": " + line;
}

}  // namespace choreo::authoring
