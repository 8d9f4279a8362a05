#include "server/settings/config_flags.h"

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "model/core/error.h"
#include "model/engine/engine_choice.h"
#include "network/pem.h"

namespace choreo {
namespace {

// CLI11 says of every unusable file that it is missing, and would wait for the writer of a FIFO.
std::string FaultOfFile(const std::string& path) try {
  constexpr size_t kMostBytes = 1 << 20;
  if (!path.empty()) ReadSmallFile("--config", path, kMostBytes);
  return "";
} catch (const Error& error) {
  throw CLI::FileError(error.what());  // yields to --help
}

/// Adds an option that SIGHUP changes: it concerns only calls to come, or the next look at those in
/// progress.
template <auto Member>
CLI::Option* Reread(CLI::App& app, ServerConfig& config, RereadSettings& reread,
                    const std::string& flag, const std::string& help) {
  reread[flag.substr(2)] = [](const ServerConfig& from, ServerConfig* to) {
    to->*Member = from.*Member;
  };
  return app.add_option(flag, config.*Member, help);
}

void AddOptions(CLI::App& app, ServerConfig& config, RereadSettings& reread) {
  app.add_option("--listen", config.listen,
                 "HOST:PORT to listen on. Port 0 picks a free one, which is printed. The default "
                 "serves this machine alone; [::] in place of 127.0.0.1 serves all, with TLS or "
                 "--insecure.")
      ->envname("CHOREO_LISTEN")
      ->capture_default_str();
  app.add_option("--checkpoint", config.checkpoints,
                 "Model to serve, a .safetensors file. Repeatable; the first is the default. "
                 "Without it: the shipped models default and free.")
      ->envname("CHOREO_CHECKPOINT");
  app.add_option("--model", config.names,
                 "Name of a shipped model to serve alone: default, free, or a paper's own network, "
                 "paper-f or paper-c. Repeatable.")
      ->envname("CHOREO_MODEL");
  app.add_option("--models", config.models,
                 "Folder of models to serve instead: each .safetensors file in it, "
                 "default.safetensors first. SIGHUP reads it again while dances continue.")
      ->envname("CHOREO_MODELS");
  app.add_option("--device", config.device,
                 "Where to compute: auto (a GPU if this build and machine have one), cpu, or "
                 "cuda:N[,N...].")
      ->envname("CHOREO_DEVICE")
      ->capture_default_str();
  app.add_option(
         "--engine", config.engine,
         "Engine of the flows' networks: torch (LibTorch, on any device), packed (our own kernels, "
         "on the CPU), packed-bf16 (the same with products of bfloat16, on CPUs with AVX512-BF16), "
         "or auto, the fastest here. Replicas that resume each other's dances must agree.")
      ->envname("CHOREO_ENGINE")
      ->capture_default_str();
  app.add_option("--max-waiting", config.max_waiting,
                 "Most transitions of GenerateTransition in progress or waiting, for each model; "
                 "candidates count, not calls. More are refused (RESOURCE_EXHAUSTED). One call may "
                 "have as many candidates, at most 32.")
      ->envname("CHOREO_MAX_WAITING")
      ->capture_default_str();
  Reread<&ServerConfig::max_streams>(
      app, config, reread, "--max-streams",
      "Most calls in progress. More are refused (RESOURCE_EXHAUSTED). 0: 50 a core, and "
      "at least 64; --max-load also refuses what the cores cannot carry.")
      ->envname("CHOREO_MAX_STREAMS")
      ->capture_default_str();
  app.add_option("--workers", config.workers,
                 "CPU workers for each model: transitions sampled at the same time. 0: one for "
                 "each usable core.")
      ->envname("CHOREO_WORKERS")
      ->capture_default_str();
  app.add_option("--threads", config.threads,
                 "Threads of one matrix product. 1 is the fastest for small models; replicas that "
                 "resume each other's dances must agree.")
      ->envname("CHOREO_THREADS")
      ->capture_default_str();
  app.add_option("--io-threads", config.io_threads,
                 "Threads that decode files, and as many that analyse long pieces of music.")
      ->envname("CHOREO_IO_THREADS")
      ->capture_default_str();
  Reread<&ServerConfig::drain_seconds>(
      app, config, reread, "--drain-seconds",
      "Seconds that streams may continue after SIGTERM or SIGINT before they end as "
      "UNAVAILABLE. New ones are refused, and health says NOT_SERVING.")
      ->envname("CHOREO_DRAIN_SECONDS")
      ->capture_default_str();
  app.add_option("--outbox-kib", config.outbox_kib,
                 "KiB of answers that may wait for a slow client before its dance pauses.")
      ->envname("CHOREO_OUTBOX_KIB")
      ->capture_default_str();
  app.add_option("--max-file-music-mib", config.max_file_music_mib,
                 "MiB of memory for incomplete music files of all calls. Calls that need more are "
                 "refused (RESOURCE_EXHAUSTED).")
      ->envname("CHOREO_MAX_FILE_MUSIC_MIB")
      ->capture_default_str();
  app.add_option("--max-network-mib", config.max_network_mib,
                 "MiB of memory for incomplete messages of all connections. Beyond it gRPC reads "
                 "less at a time, then ends calls.")
      ->envname("CHOREO_MAX_NETWORK_MIB")
      ->capture_default_str();
  app.add_option("--kernels", config.kernels,
                 "Instructions of the packed engine, one of " + KernelNames() +
                     ". Default: the fastest here. Replicas on different CPUs can resume each "
                     "other's dances if all use those of the slowest.")
      ->envname("CHOREO_KERNELS");
  // Only available on the command line: a variable or a file must not keep a server from serving.
  app.add_flag("--check", config.check,
               "Read settings, models, certificates and tokens as at start, print \"ok\" or a line "
               "for each fault, and exit. Use it before a restart, beside the running server: an "
               "address in use is no fault. An expired certificate is a warning, as at start.")
      ->configurable(false);
  // CLI11 reads variables only after the file, so this variable must be set as the option's
  // default.
  const char* file = std::getenv("CHOREO_CONFIG");
  const bool is_named = file != nullptr && *file != '\0';
  app.set_config("--config", is_named ? file : "",
                 "Read settings from this TOML file, as in: workers = 2", is_named)
      ->envname("CHOREO_CONFIG")
      ->check(FaultOfFile);
  app.allow_config_extras(CLI::config_extras_mode::error);
}

// Limits on clients' resources and idle time.
void AddLimits(CLI::App& app, ServerConfig& config, RereadSettings& reread) {
  Reread<&ServerConfig::max_streams_of_peer>(
      app, config, reread, "--max-streams-of-peer",
      "Most calls in progress of one token's holder or, without --tokens, from one "
      "address. 0: --max-streams for a lone caller, seven eighths of it beside another.")
      ->envname("CHOREO_MAX_STREAMS_OF_PEER")
      ->capture_default_str();
  Reread<&ServerConfig::first_message_seconds>(
      app, config, reread, "--first-message-seconds",
      "Seconds within which a call's first message must come, or it ends as DEADLINE_EXCEEDED.")
      ->envname("CHOREO_FIRST_MESSAGE_SECONDS")
      ->capture_default_str();
  Reread<&ServerConfig::idle_seconds>(
      app, config, reread, "--idle-seconds",
      "Seconds without a message in either direction after which a call ends as "
      "DEADLINE_EXCEEDED.")
      ->envname("CHOREO_IDLE_SECONDS")
      ->capture_default_str();
  Reread<&ServerConfig::unread_seconds>(
      app, config, reread, "--unread-seconds",
      "Seconds within which a client must take an answer, or its call is reset.")
      ->envname("CHOREO_UNREAD_SECONDS")
      ->capture_default_str();
  Reread<&ServerConfig::max_load>(
      app, config, reread, "--max-load",
      "Share of the cores' and engines' time that calls may need, by their frames. More "
      "calls are refused (RESOURCE_EXHAUSTED). Above 1: none are.")
      ->envname("CHOREO_MAX_LOAD")
      ->capture_default_str();
  app.add_option("--max-connection-seconds", config.max_connection_seconds,
                 "Age at which a connection takes no new calls, so that clients spread over "
                 "replicas again; its calls continue. 0: no limit.")
      ->envname("CHOREO_MAX_CONNECTION_SECONDS")
      ->capture_default_str();
}

// Authentication and encryption.
void AddSecurity(CLI::App& app, ServerConfig& config) {
  app.add_option("--tls-cert", config.tls_certificate,
                 "PEM file with the certificate chain. Without it, connections are not encrypted.")
      ->envname("CHOREO_TLS_CERT");
  app.add_option("--tls-key", config.tls_key, "PEM file with the private key of --tls-cert.")
      ->envname("CHOREO_TLS_KEY");
  app.add_option("--tls-client-ca", config.tls_client_ca,
                 "PEM file of authorities; clients need a certificate from one of them.")
      ->envname("CHOREO_TLS_CLIENT_CA");
  app.add_option(
         "--tokens", config.tokens,
         "File of lines \"SHA256 NAME\". Calls must send the token of one line as \"authorization: "
         "Bearer TOKEN\"; health checks need none, nor does --reflection. The file is read again "
         "when "
         "it changes.")
      ->envname("CHOREO_TOKENS");
  app.add_flag("--insecure", config.insecure,
               "Listen beyond this machine without TLS. Everybody on the way can then read and "
               "change messages: only for networks that are secured otherwise.")
      ->envname("CHOREO_INSECURE");
  app.add_flag(
         "--reflection,!--no-reflection", config.reflection,
         "Describe the API to clients (gRPC's reflection), who need no token for it. Default: "
         "on, but off with --tls-cert or --tokens.")
      ->envname("CHOREO_REFLECTION");
}

// Logs, metrics and health.
void AddObservability(CLI::App& app, ServerConfig& config, RereadSettings& reread) {
  Reread<&ServerConfig::log_level>(
      app, config, reread, "--log-level",
      "trace, debug, info, warning, error, critical or off. The log goes to stderr.")
      ->envname("CHOREO_LOG_LEVEL")
      ->capture_default_str();
  app.add_option("--log-format", config.log_format,
                 "text, or json: one object a line. Each call leaves one line at level info.")
      ->envname("CHOREO_LOG_FORMAT")
      ->capture_default_str();
  app.add_option(
         "--metrics", config.metrics,
         "HOST:PORT at which Prometheus finds figures, http://HOST:PORT/metrics; a PORT alone "
         "is of this machine. They are not encrypted. Without it, there are none.")
      ->envname("CHOREO_METRICS");
}

}  // namespace

RereadSettings AddFlags(CLI::App& app, ServerConfig& config) {
  RereadSettings reread;
  AddOptions(app, config, reread);
  AddLimits(app, config, reread);
  AddSecurity(app, config);
  AddObservability(app, config, reread);
  return reread;
}

RereadSettings SettingsToReread() {
  CLI::App app;
  ServerConfig config;
  return AddFlags(app, config);
}

}  // namespace choreo
