#include "server/config.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "model/core/error.h"
#include "model/engine/devices.h"
#include "model/engine/engine_kind.h"
#include "server/music_file.h"

namespace choreo {
namespace {

constexpr std::array<std::string_view, 7> kLogLevels = {"trace", "debug",    "info", "warning",
                                                        "error", "critical", "off"};

/// What the process exits with then.
constexpr int kMisused = 2;

void CheckRange(const std::string& name, double value, double least, double most) {
  if (value >= least && value <= most) return;
  throw InvalidArgument(name, CLI::detail::to_string(value) + " is not in [" +
                                  CLI::detail::to_string(least) + ", " +
                                  CLI::detail::to_string(most) + "]");
}

void CheckAddress(const std::string& listen) {
  const size_t colon = listen.rfind(':');
  const std::string port = colon == std::string::npos ? "" : listen.substr(colon + 1);
  const bool digits = !port.empty() && std::all_of(port.begin(), port.end(),
                                                   [](char c) { return c >= '0' && c <= '9'; });
  if (!digits) throw InvalidArgument("--listen", '"' + listen + "\" is not HOST:PORT");
  // gRPC would listen on the port's last 16 bits.
  if (port.size() > 5 || std::stoi(port) > 65535) {
    throw InvalidArgument("--listen", "port " + port + " is not in [0, 65535]");
  }
}

void CheckFile(const std::string& name, const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) {
    throw Error(ErrorCode::kNotFound, name, "no file " + path.string());
  }
}

void AddOptions(CLI::App& app, ServerConfig& config) {
  app.add_option("--listen", config.listen,
                 "HOST:PORT to listen on. Port 0 picks a free one, which is printed. The default "
                 "serves this machine alone; [::]:50051 serves all.")
      ->envname("CHOREO_LISTEN")
      ->capture_default_str();
  app.add_option("--checkpoint", config.checkpoints,
                 "Model to serve, a .safetensors file; give several for several models, the "
                 "default first. Without it, the models that ship.")
      ->envname("CHOREO_CHECKPOINT");
  app.add_option("--device", config.device,
                 "Where to compute: auto (a GPU if this build and machine have one), cpu, or "
                 "cuda:N[,N...].")
      ->envname("CHOREO_DEVICE")
      ->capture_default_str();
  app.add_option(
         "--engine", config.engine,
         "What steps paper F's flow: torch (LibTorch, on any device), packed (our own kernels, on "
         "the CPU), packed-bf16 (the same with products of bfloat16, on CPUs with AVX512-BF16), or "
         "auto, the fastest of them here. Replicas that take over each other's dances must agree.")
      ->envname("CHOREO_ENGINE")
      ->capture_default_str();
  app.add_option("--slots", config.slots,
                 "Transitions in progress at once, for each model and device; those of "
                 "GenerateTransition get half of them. 0: two for each of --max-streams.")
      ->envname("CHOREO_SLOTS")
      ->capture_default_str();
  app.add_option("--max-waiting", config.max_waiting,
                 "Transitions of GenerateTransition that may wait for a slot, for each model.")
      ->envname("CHOREO_MAX_WAITING")
      ->capture_default_str();
  app.add_option("--max-streams", config.max_streams,
                 "Calls in progress at once. Those beyond are refused (RESOURCE_EXHAUSTED).")
      ->envname("CHOREO_MAX_STREAMS")
      ->capture_default_str();
  app.add_option("--workers", config.workers,
                 "Workers of the CPU, which share the slots. 0: one for every usable core.")
      ->envname("CHOREO_WORKERS")
      ->capture_default_str();
  app.add_option("--threads", config.threads,
                 "Threads of one matrix product. 1 is the fastest for small models; replicas that "
                 "take over each other's dances must agree.")
      ->envname("CHOREO_THREADS")
      ->capture_default_str();
  app.add_option("--io-threads", config.io_threads,
                 "Threads that decode files, and as many that digest long pieces of music.")
      ->envname("CHOREO_IO_THREADS")
      ->capture_default_str();
  app.add_option("--drain-seconds", config.drain_seconds,
                 "After SIGTERM or SIGINT: how long streams may go on before they end as "
                 "UNAVAILABLE. New ones are refused at once, and health says NOT_SERVING.")
      ->envname("CHOREO_DRAIN_SECONDS")
      ->capture_default_str();
  app.add_option("--outbox-kib", config.outbox_kib,
                 "Answers that may wait for a slow client before its dance pauses, KiB.")
      ->envname("CHOREO_OUTBOX_KIB")
      ->capture_default_str();
  app.add_option(
         "--max-file-music-mib", config.max_file_music_mib,
         "Music files that are still coming, over all calls, MiB of memory. Calls that would "
         "go beyond are refused (RESOURCE_EXHAUSTED).")
      ->envname("CHOREO_MAX_FILE_MUSIC_MIB")
      ->capture_default_str();
  app.add_option("--max-network-mib", config.max_network_mib,
                 "Memory for what clients are sending and have not finished, over all connections, "
                 "MiB. Beyond it gRPC takes less at a time, then ends calls.")
      ->envname("CHOREO_MAX_NETWORK_MIB")
      ->capture_default_str();
  app.add_option(
         "--kernels", config.kernels,
         "Instructions of the packed engine: portable, avx2, avx512 or avx512_bf16. Without "
         "it, the fastest here. Replicas on different CPUs take over each other's dances "
         "where all have the slowest one's.")
      ->envname("CHOREO_KERNELS");
  app.add_option("--tls-cert", config.tls_certificate,
                 "PEM file with the certificate chain. Without it, connections are not encrypted.")
      ->envname("CHOREO_TLS_CERT");
  app.add_option("--tls-key", config.tls_key, "PEM file with the private key of --tls-cert.")
      ->envname("CHOREO_TLS_KEY");
  app.add_option("--log-level", config.log_level,
                 "trace, debug, info, warning, error, critical or off. The log goes to stderr.")
      ->envname("CHOREO_LOG_LEVEL")
      ->capture_default_str();
  app.set_config("--config", "", "Read settings from this TOML or INI file, as in: slots = 32");
  app.allow_config_extras(CLI::config_extras_mode::error);
}

// What clients may take, and for how long they may do nothing.
void AddLimits(CLI::App& app, ServerConfig& config) {
  app.add_option("--max-streams-of-peer", config.max_streams_of_peer,
                 "Calls in progress at once from one address. 0: seven eighths of --max-streams.")
      ->envname("CHOREO_MAX_STREAMS_OF_PEER")
      ->capture_default_str();
  app.add_option("--first-message-seconds", config.first_message_seconds,
                 "A call whose first message does not come within these is DEADLINE_EXCEEDED.")
      ->envname("CHOREO_FIRST_MESSAGE_SECONDS")
      ->capture_default_str();
  app.add_option("--idle-seconds", config.idle_seconds,
                 "So is one of which nothing comes and to which nothing goes for these.")
      ->envname("CHOREO_IDLE_SECONDS")
      ->capture_default_str();
  app.add_option("--unread-seconds", config.unread_seconds,
                 "A call whose client does not take an answer within these is reset.")
      ->envname("CHOREO_UNREAD_SECONDS")
      ->capture_default_str();
  app.add_option(
         "--max-sleep-seconds", config.max_sleep_seconds,
         "A dance that waits for its music or for its client keeps its slot for these, once "
         "others wait for one. It goes on later, and is the same.")
      ->envname("CHOREO_MAX_SLEEP_SECONDS")
      ->capture_default_str();
  app.add_option(
         "--max-load", config.max_load,
         "Share of a model's time that goes to frames which are due: beyond it new calls are "
         "refused (RESOURCE_EXHAUSTED). Above 1: none are.")
      ->envname("CHOREO_MAX_LOAD")
      ->capture_default_str();
  app.add_option("--max-connection-seconds", config.max_connection_seconds,
                 "A connection of this age takes no new calls, so that clients spread over "
                 "replicas anew; its calls go on. 0: none is too old.")
      ->envname("CHOREO_MAX_CONNECTION_SECONDS")
      ->capture_default_str();
}

void CheckLimits(const ServerConfig& config) {
  constexpr double kDay = 86'400;
  CheckRange("--max-streams-of-peer", config.max_streams_of_peer, 0, 65536);
  CheckRange("--first-message-seconds", config.first_message_seconds, 0.1, kDay);
  CheckRange("--idle-seconds", config.idle_seconds, 0.1, kDay);
  CheckRange("--unread-seconds", config.unread_seconds, 0.1, kDay);
  CheckRange("--max-sleep-seconds", config.max_sleep_seconds, 0, 60);
  CheckRange("--max-load", config.max_load, 0.1, 2);
  CheckRange("--max-connection-seconds", config.max_connection_seconds, 0, 30 * kDay);
}

}  // namespace

void ServerConfig::Validate() const {
  CheckAddress(listen);
  for (const auto& path : checkpoints) CheckFile("--checkpoint", path);
  ParseEngineKind(engine, "--engine");
  // Whether they are there is told when they are used; `auto` is whatever is there.
  if (device != "auto")
    ParseDevices(device, {.cuda_build = true, .cuda_devices = std::numeric_limits<int>::max()});
  CheckRange("--slots", slots, 0, 4096);
  CheckRange("--max-waiting", max_waiting, 0, 65536);
  CheckRange("--max-streams", max_streams, 1, 65536);
  CheckRange("--workers", workers, 0, 1024);
  CheckRange("--threads", threads, 1, 1024);
  CheckRange("--io-threads", io_threads, 1, 256);
  CheckRange("--drain-seconds", drain_seconds, 0, 3600);
  CheckRange("--outbox-kib", outbox_kib, 1, 65536);
  // At least one file has room.
  CheckRange("--max-file-music-mib", max_file_music_mib, kMaxAudioFileBytes >> 20, 1 << 20);
  CheckLimits(*this);
  // A largest message has room.
  CheckRange("--max-network-mib", max_network_mib, 64, 1 << 20);
  if (tls_certificate.empty() != tls_key.empty()) {
    throw InvalidArgument(tls_key.empty() ? "--tls-key" : "--tls-cert",
                          "missing; a certificate and its key go together");
  }
  if (!tls_certificate.empty()) {
    CheckFile("--tls-cert", tls_certificate);
    CheckFile("--tls-key", tls_key);
  }
  if (std::find(kLogLevels.begin(), kLogLevels.end(), log_level) == kLogLevels.end()) {
    throw InvalidArgument("--log-level", '"' + log_level +
                                             "\" is none of trace, debug, info, warning, error, "
                                             "critical, off");
  }
}

CommandLine ParseCommandLine(int argc, const char* const* argv) {
  ServerConfig config;
  CLI::App app{
      "choreod makes people dance: it serves the gRPC API choreo.v1.Choreography, with health "
      "checking and reflection.\nEvery setting can also come from the environment or a file.",
      "choreod"};
  app.set_version_flag("--version", CHOREO_VERSION);
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("choreod: ") + error.what() + "; see --help\n";
  });
  AddOptions(app, config);
  AddLimits(app, config);
  try {
    app.parse(argc, argv);
    config.Validate();
    return {.config = std::move(config), .exit_code = 0};
  } catch (const CLI::ConfigError& error) {  // "INI was not able to parse KEY"
    const std::string what = error.what();
    std::cerr << "choreod: " << app.get_config_ptr()->as<std::string>()
              << ": no setting is called \"" << what.substr(what.rfind(' ') + 1)
              << "\"; choreod --help lists them\n";
  } catch (const CLI::ParseError& error) {
    if (app.exit(error) == 0) return {.config = std::nullopt, .exit_code = 0};
  } catch (const Error& error) {
    std::cerr << "choreod: " << error.what() << '\n';
  }
  return {.config = std::nullopt, .exit_code = kMisused};
}

std::vector<std::filesystem::path> ShippedCheckpoints() {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  std::string looked;
  for (const auto& folder : {program / "../share/choreo/checkpoints",
                             std::filesystem::path(CHOREO_SOURCE_DIR) / "model/checkpoints"}) {
    std::vector<std::filesystem::path> found;
    for (const char* name : {"default.safetensors", "free.safetensors"}) {
      const std::filesystem::path path = (folder / name).lexically_normal();
      if (std::filesystem::is_regular_file(path)) found.push_back(path);
    }
    if (!found.empty()) return found;
    looked += "\n  " + folder.lexically_normal().string();
  }
  throw Error(ErrorCode::kNotFound, "--checkpoint", "none given, and none found in" + looked);
}

}  // namespace choreo
