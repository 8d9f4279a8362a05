#include <lo/lo.h>

#include <cmath>
#include <string_view>
#include <utility>

#include "client/live/cues.h"
#include "model/core/error.h"

namespace choreo::live {
namespace {

class OscCues final : public Cues {
 public:
  explicit OscCues(int port)
      : server_(lo_server_new(std::to_string(port).c_str(), [](int, const char*, const char*) {}),
                lo_server_free) {
    if (!server_) {
      throw Error(ErrorCode::kUnavailable, "--osc",
                  "port " + std::to_string(port) + " can't be opened; is it in use?");
    }
    lo_server_add_method(server_.get(), "/choreo/key", nullptr, Key, this);
    lo_server_add_method(server_.get(), "/choreo/undo", nullptr, Undo, this);
  }

  std::vector<Cue> Take() override {
    // Messages beyond the limit wait for the next call, or are lost.
    for (int i = 0; i < kMaxAtOnce && lo_server_recv_noblock(server_.get(), 0) > 0; ++i) continue;
    return std::exchange(cues_, {});
  }

 private:
  static constexpr int kMaxAtOnce = 64;

  static int Key(const char*, const char* types, lo_arg** values, int, lo_message, void* self) {
    const std::string_view given = types;
    const bool has_ahead =
        given.size() == 2 && lo_is_numerical_type(static_cast<lo_type>(given[1]));
    if (!given.starts_with(LO_STRING) || (given.size() > 1 && !has_ahead)) return 0;
    Cue cue{&values[0]->s};
    if (has_ahead) {
      const auto ahead =
          static_cast<double>(lo_hires_val(static_cast<lo_type>(given[1]), values[1]));
      // The receiver reports impossible times, like unknown poses.
      cue.ahead_s = ahead;
    }
    if (!cue.pose.empty()) static_cast<OscCues*>(self)->cues_.push_back(std::move(cue));
    return 0;
  }
  static int Undo(const char*, const char*, lo_arg**, int, lo_message, void* self) {
    static_cast<OscCues*>(self)->cues_.push_back({});
    return 0;
  }

  std::unique_ptr<void, void (*)(lo_server)> server_;
  std::vector<Cue> cues_;
};

}  // namespace

std::unique_ptr<Cues> HearOsc(int port) { return std::make_unique<OscCues>(port); }

}  // namespace choreo::live
