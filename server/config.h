#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "model/core/limits.h"

namespace choreo {

/// What a choreod is started with. Flags, a configuration file and the environment fill it; main
/// is the only place that acts on it.
struct ServerConfig {
  /// HOST:PORT to listen on. Port 0: a free one is picked and printed.
  std::string listen = "127.0.0.1:" + std::to_string(kDefaultPort);
  /// One model each; the first is the default. Empty: checkpoints that ship.
  std::vector<std::filesystem::path> checkpoints;
  std::vector<std::string> names;  ///< of the checkpoints that ship; empty: those for every day
  std::filesystem::path models;    ///< a folder of checkpoints instead (ModelFolder); empty: none
  std::string device = "auto";     ///< auto, cpu, or cuda:N[,N...]
  std::string engine = "auto";     ///< one of kEngineKindNames
  int max_waiting = 128;      ///< transitions of GenerateTransition in hand at once, of each model
  int max_streams = 64;       ///< calls in progress at once; those beyond are refused
  int workers = 0;            ///< of the CPU, for each model; 0: one for every usable core
  int threads = 1;            ///< of one matrix product; part of the fingerprint
  int io_threads = 2;         ///< that decode files, and as many for long pieces of music
  double drain_seconds = 20;  ///< that streams get to finish after SIGTERM
  int outbox_kib = 256;       ///< of answers that wait for a slow client before its dance pauses
  int max_file_music_mib = 1024;  ///< of music files that have not come whole, over all calls
  int max_network_mib = 512;  ///< of bytes that come from or go to clients, over all connections
  std::string kernels;        ///< of the packed engine; empty: the fastest of this machine
  std::filesystem::path tls_certificate;  ///< PEM chain; empty: no TLS
  std::filesystem::path tls_key;          ///< PEM; goes with tls_certificate
  std::filesystem::path tls_client_ca;    ///< PEM; empty: clients need no certificate
  std::filesystem::path tokens;           ///< who may call (Tokens); empty: everybody
  bool insecure = false;                  ///< no TLS beyond this machine is what is wanted
  bool reflection = true;                 ///< clients may ask what the API is
  std::string log_level = "info";         ///< trace, debug, info, warning, error, critical, off
  std::string log_format = "text";        ///< text, json
  std::string metrics;                    ///< HOST:PORT or PORT for Prometheus; empty: nowhere

  // What clients may take, and for how long they may do nothing.
  int max_streams_of_peer = 0;        ///< calls of one caller; 0: seven eighths of max_streams
  double first_message_seconds = 10;  ///< within which a call's first message must come
  double idle_seconds = 120;          ///< that a call may go on with nothing coming or going
  double unread_seconds = 60;         ///< that an answer may wait for its client
  double max_load = 0.9;  ///< share of the engines' time that may be promised (FrameBudget)
  double max_connection_seconds = 0;  ///< then a connection takes no new calls; 0: for ever

  /// HOST:PORT of `metrics`; a port alone is of this machine.
  std::string MetricsAddress() const;
  int MaxStreamsOfPeer() const {
    return max_streams_of_peer > 0 ? max_streams_of_peer : max_streams - max_streams / 8;
  }

  /// Throws Error(kInvalidArgument) naming the first setting that cannot be used.
  void Validate() const;
};

/// What the command line asked for: a configuration that is valid, or to leave with `exit_code`
/// (the help or an error has been printed).
struct CommandLine {
  std::optional<ServerConfig> config;
  int exit_code = 0;
};

/// A flag goes before the file that --config names (TOML or INI), that before the flag's
/// environment variable (CHOREO_LISTEN, ...).
CommandLine ParseCommandLine(int argc, const char* const* argv);

/// The checkpoints that ship and have these names: installed beside the program, or in the source
/// tree that it was built in. Without names those for every day. Throws Error(kNotFound) naming
/// where it looked, or which there are.
std::vector<std::filesystem::path> ShippedCheckpoints(const std::vector<std::string>& names);

}  // namespace choreo
