#pragma once

#include <functional>
#include <string>
#include <vector>

/// This library prints nothing: it passes notes about songs, beats and motions to the program.
namespace choreo::authoring {

/// Receives a line for people: "note: song.wav: ..." or "warning: --tempo ...". Called from any
/// thread.
using NoteSink = std::function<void(const std::string& line)>;

/// Sets the process's sink; without one, lines are dropped. Call it before other threads start.
void SetNoteSink(NoteSink sink);

/// While it lives, keeps the lines of the thread that made it, which ends it, from the sink.
class NotesApart {
 public:
  NotesApart();
  ~NotesApart();
  NotesApart(const NotesApart&) = delete;
  NotesApart& operator=(const NotesApart&) = delete;

  const std::vector<std::string>& lines() const { return lines_; }

 private:
  friend void Note(const std::string& line);
  NotesApart* outer_;
  std::vector<std::string> lines_;
};

/// For this library and programs' code: passes a line to the sink.
void Note(const std::string& line);

/// A line that names whom it is about: "warning: ada: 3 s: ...".
std::string NoteAbout(const std::string& whom, const std::string& line);

}  // namespace choreo::authoring
