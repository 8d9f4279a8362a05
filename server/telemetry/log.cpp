#include "server/telemetry/log.h"

#include <grpc/support/log.h>
#include <spdlog/fmt/chrono.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <ctime>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/connections/handshakes.h"
#include "server/messages/status.h"

namespace choreo {
namespace {

/// The logger for lines whose text already consists of JSON members.
constexpr std::string_view kMembers = "members";

bool log_is_json = false;  // written before threads start

std::string Quoted(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Implements the pattern's flag %*: the rest of the JSON object.
class Members final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm& /*time*/,
              spdlog::memory_buf_t& line) override {
    const std::string_view text(message.payload.data(), message.payload.size());
    const std::string_view name(message.logger_name.data(), message.logger_name.size());
    const std::string members =
        name == kMembers ? std::string(text) : "\"message\":" + Quoted(text);
    line.append(members.data(), members.data() + members.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<Members>();
  }
};

/// Limits the log lines per period and counts the rest, because anybody can cause a line per
/// connection or call. Thread-safe.
class LineLimit {
 public:
  LineLimit(int lines, std::chrono::seconds period) : most_(lines), period_(period) {}

  /// Whether one more line may be written.
  bool Admit() {
    const std::lock_guard lock(mutex_);
    BeginPeriod();
    if (lines_ == most_) {
      ++left_out_;
      return false;
    }
    ++lines_;
    return true;
  }

  /// The lines suppressed in finished periods and not yet reported.
  int TakeLeftOut() {
    const std::lock_guard lock(mutex_);
    BeginPeriod();
    return lines_ == most_ ? 0 : std::exchange(left_out_, 0);
  }

 private:
  void BeginPeriod() {  // if the previous one is over. Requires the lock
    const auto now = std::chrono::steady_clock::now();
    if (now - begin_ < period_) return;
    begin_ = now;
    lines_ = 0;
  }

  const int most_;
  const std::chrono::seconds period_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point begin_;
  int lines_ = 0, left_out_ = 0;
};

LineLimit& RefusedCalls() {
  static LineLimit limit(10, std::chrono::seconds(1));
  return limit;
}

/// Forwards gRPC's own log, which contains only errors unless GRPC_VERBOSITY is set. Harmless
/// clients cause most of them, so they are warnings here.
void ForwardGrpcLine(gpr_log_func_args* line) {
  CountHandshakeFault(line->message);
  static LineLimit limit(10, std::chrono::seconds(10));
  const int left_out = limit.TakeLeftOut();
  if (left_out > 0) spdlog::warn("gRPC: {} lines were left out", left_out);
  if (!limit.Admit()) return;
  // A server that shuts down ends handshakes with this error.
  const bool is_orderly =
      std::string_view(line->message).find("Listener stopped serving") != std::string_view::npos;
  const auto level = is_orderly                                 ? spdlog::level::info
                     : line->severity == GPR_LOG_SEVERITY_ERROR ? spdlog::level::warn
                     : line->severity == GPR_LOG_SEVERITY_INFO  ? spdlog::level::info
                                                                : spdlog::level::debug;
  spdlog::log(level, "gRPC: {}", line->message);
}

std::string ObjectOf(const CallRecord& call) {
  nlohmann::json object = {{"message", "call"},        {"method", call.method},
                           {"peer", call.caller.peer}, {"status", NameOf(call.status.error_code())},
                           {"seconds", call.seconds},  {"frames", call.frames}};
  const auto add = [&object](const char* name, const std::string& value) {
    if (!value.empty()) object[name] = value;
  };
  add("error", call.status.error_message());
  add("holder", call.caller.holder);
  add("trace_id", call.caller.trace_id);
  add("span_id", call.caller.span_id);
  add("stream_id", call.caller.stream_id);
  add("resumed_from", call.caller.resumed_from);
  add("model", std::string(call.model));
  if (call.seed) object["seed"] = *call.seed;
  if (call.refusal) object["refusal"] = kRefusals[static_cast<size_t>(*call.refusal)];
  if (call.frames > 0) object["first_frame_seconds"] = call.first_frame_s;
  return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string TextOf(const CallRecord& call) {
  std::string text = std::string(call.method) + ' ' + call.caller.peer;
  if (!call.caller.holder.empty()) text += " (" + call.caller.holder + ')';
  if (!call.caller.stream_id.empty()) text += " stream " + call.caller.stream_id;
  if (!call.caller.resumed_from.empty()) text += " from " + call.caller.resumed_from;
  if (!call.caller.trace_id.empty()) text += " trace " + call.caller.trace_id;
  text += fmt::format(": {} in {:.3f} s", NameOf(call.status.error_code()), call.seconds);
  if (call.frames > 0) {
    text += fmt::format(", {} frames, the first after {:.3f} s", call.frames, call.first_frame_s);
  }
  if (!call.model.empty()) text += fmt::format(", model \"{}\"", call.model);
  if (call.seed) text += fmt::format(", seed {}", *call.seed);
  if (!call.status.ok()) text += ": " + call.status.error_message();
  return text;
}

}  // namespace

void StartLog(const std::string& level, bool json) {
  log_is_json = json;
  spdlog::drop_all();
  const auto logger = spdlog::stderr_color_mt("choreod");
  if (json) {
    auto formatter = std::make_unique<spdlog::pattern_formatter>(spdlog::pattern_time_type::utc);
    formatter->add_flag<Members>('*').set_pattern(
        R"({"time":"%Y-%m-%dT%H:%M:%S.%eZ","level":"%l",%*})");
    logger->set_formatter(std::move(formatter));
    spdlog::register_logger(logger->clone(std::string(kMembers)));
  }
  spdlog::set_default_logger(logger);
  spdlog::set_level(spdlog::level::from_str(level));
  ForwardGrpcLog();
}

void ForwardGrpcLog() { gpr_set_log_function(ForwardGrpcLine); }

std::string JsonLine(const std::string& level, const std::string& message) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
  return fmt::format(R"({{"time":"{:%Y-%m-%dT%H:%M:%S}.{:03}Z","level":"{}","message":{}}})",
                     fmt::gmtime(static_cast<std::time_t>(ms / 1000)), ms % 1000, level,
                     Quoted(message));
}

void LogLeftOutCalls() {
  const int left_out = RefusedCalls().TakeLeftOut();
  if (left_out > 0) spdlog::warn("{} lines of refused calls were left out", left_out);
}

void LogCall(const CallRecord& call) {
  if (call.refusal) {
    LogLeftOutCalls();
    if (!RefusedCalls().Admit()) return;
  }
  if (!log_is_json) return spdlog::info("{}", TextOf(call));
  const std::string object = ObjectOf(call);
  spdlog::get(std::string(kMembers))->info("{}", object.substr(1, object.size() - 2));
}

}  // namespace choreo
