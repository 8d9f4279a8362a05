#include "client/cli/options/interruption.h"

#include "model/core/error.h"

namespace choreo::cli {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM};
volatile sig_atomic_t came = 0;

}  // namespace

Interruption::Interruption() {
  struct sigaction note {};
  note.sa_handler = [](int) { came = 1; };
  note.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  for (int i = 0; i < 2; ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    // A shell that runs us in the background may have set it to be ignored.
    if (before_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &note, nullptr);
  }
}

Interruption::~Interruption() {
  for (int i = 0; i < 2; ++i) sigaction(kSignals[i], &before_[i], nullptr);
}

bool Interruption::Came() { return came != 0; }

void Interruption::Check() {
  if (Came()) throw Error(ErrorCode::kCancelled, "", "interrupted");
}

}  // namespace choreo::cli
