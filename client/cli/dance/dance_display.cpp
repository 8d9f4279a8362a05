#include "client/cli/dance/dance_display.h"

#include <string>
#include <variant>

#include "client/authoring/notes/notes.h"
#include "client/cli/report/report.h"

namespace choreo::cli {

void DanceDisplay::operator()(const client::Message& message) {
  if (const auto* header = std::get_if<client::Header>(&message)) {
    bar_ = std::make_unique<ProgressBar>(
        who_.empty() ? "dancing" : "dancing " + who_,
        1 + static_cast<int64_t>(static_cast<double>(frames_ - 1) * header->fps / model_fps_));
  } else if (const auto* block = std::get_if<client::FrameBlock>(&message)) {
    bar_->Advance(static_cast<int64_t>(block->poses.size()));
  } else if (const auto* key = std::get_if<client::KeyReached>(&message)) {
    bar_->Advance(0, key->id);
  } else if (const auto* warning = std::get_if<client::Warning>(&message)) {
    Print(Describe(*warning, {model_fps_}));
  } else if (const auto* rejected = std::get_if<client::KeyRejected>(&message)) {
    Print("warning: key " + rejected->id + " was refused: " + rejected->reason);
  } else if (const auto* resumed = std::get_if<client::Resumed>(&message)) {
    Print("lost the server (" + resumed->reason + "); " + resumed->address + " goes on" +
          (resumed->exact ? "" : ", with another model or build"));
  } else if (std::holds_alternative<client::Report>(message)) {
    bar_->Finish();
  }
}

void DanceDisplay::Print(const std::string& line) {
  bar_->Print(who_.empty() ? line : authoring::NoteAbout(who_, line));
}

}  // namespace choreo::cli
