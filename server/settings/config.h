#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "network/protocol.h"

namespace choreo {

inline constexpr double kMostStreams = 65'536;
/// Live dances that one core can serve beside other work (docs/operations.md). The default limit
/// follows from it.
inline constexpr int kStreamsPerCore = 50;

/// The settings of choreod, from flags, a configuration file and the environment. Only main acts on
/// them.
struct ServerConfig {
  /// HOST:PORT to listen on. Port 0 picks a free port and prints it.
  std::string listen = "127.0.0.1:" + std::to_string(kDefaultPort);
  /// Checkpoint files, each with one model; the first is the default. Empty: the shipped
  /// checkpoints.
  std::vector<std::filesystem::path> checkpoints;
  std::vector<std::string> names;  ///< of shipped checkpoints; empty: the default ones
  std::filesystem::path models;    ///< a folder of checkpoints instead (ModelFolder); empty: none
  std::string device = "auto";     ///< auto, cpu, or cuda:N[,N...]
  std::string engine = "auto";     ///< one of kEngineKindNames
  int max_waiting = 128;  ///< concurrent transitions of GenerateTransition, per model; at least 1
  int max_streams = 0;    ///< concurrent calls; more are refused. 0: depends on the number of cores
  int workers = 0;        ///< on the CPU, per model; 0: one per usable core
  int threads = 1;        ///< per matrix product; part of the fingerprint
  int io_threads = 2;     ///< for decoding files; the same number again analyses long music
  double drain_seconds = 20;  ///< for streams to finish after SIGTERM
  int outbox_kib = 256;  ///< of answers that may wait for a slow client before its dance pauses
  int max_file_music_mib = 1024;  ///< of incomplete music files, over all calls
  int max_network_mib = 512;      ///< of bytes to and from clients, over all connections
  std::string kernels;            ///< of the packed engine; empty: the fastest of this machine
  std::filesystem::path tls_certificate;  ///< PEM chain; empty: no TLS
  std::filesystem::path tls_key;          ///< PEM; goes with tls_certificate
  std::filesystem::path tls_client_ca;    ///< PEM; empty: clients need no certificate
  std::filesystem::path tokens;           ///< allowed callers (Tokens); empty: everybody
  bool insecure = false;                  ///< allow connections from other machines without TLS
  bool reflection = true;                 ///< clients may query the API's schema, without a token
  std::string log_level = "info";         ///< trace, debug, info, warning, error, critical, off
  std::string log_format = "text";        ///< text, json
  bool check = false;                     ///< only report whether it could serve
  std::string metrics;                    ///< HOST:PORT or PORT for Prometheus; empty: nowhere

  // Limits on clients' calls and idle time.
  int max_streams_of_peer = 0;        ///< calls of one caller; 0: MaxStreamsOfPeer
  double first_message_seconds = 10;  ///< limit for a call's first message
  double idle_seconds = 120;          ///< limit for a call without messages in either direction
  double unread_seconds = 60;         ///< limit for a client to take an answer
  double max_load = 0.85;  ///< share of the machine's time that may be promised (FrameBudget)
  double max_connection_seconds = 0;  ///< age limit for new calls on a connection; 0: none

  /// The settings that were given, as written, by flag without its dashes: {"max-streams", "64"}.
  std::map<std::string, std::string> given;
  /// Settings in the file of --config that flags override.
  std::vector<std::string> overridden;
  /// "FILE:LINE: " or "VARIABLE: " of the settings that the file or a variable has set, by flag.
  std::map<std::string, std::string> places;

  /// The fault of a setting, "--device: ...", behind its place, unless it is a flag.
  std::string Placed(const std::string& fault) const;

  /// `metrics` as HOST:PORT; a port alone means this machine.
  std::string MetricsAddress() const;
  // These need `max_streams` above 0.
  /// The limit on one caller's calls while another caller is connected. By default all but an
  /// eighth, at least one.
  int MaxStreamsOfPeer() const {
    if (max_streams_of_peer > 0) return max_streams_of_peer;
    return std::max(1, max_streams - std::max(1, max_streams / 8));
  }
  /// The limit on one caller's calls while no other is connected. By default all.
  int MaxStreamsOfLonePeer() const {
    return max_streams_of_peer > 0 ? max_streams_of_peer : max_streams;
  }

  /// Throws Error(kInvalidArgument) naming the first unusable setting.
  void Check() const;
};

/// The parsed command line: a valid configuration, or an `exit_code` to exit with (after printing
/// help or an error).
struct CommandLine {
  std::optional<ServerConfig> config;
  int exit_code = 0;
};

/// A flag overrides the file of --config (TOML), which overrides the flag's environment
/// variable (CHOREO_LISTEN, ...).
CommandLine ParseCommandLine(int argc, const char* const* argv);

/// Reads the same settings again, with what the file of --config says now. Throws
/// Error(kInvalidArgument), naming the file and line, for a bad one.
ServerConfig RereadConfig(int argc, const char* const* argv);

/// Finds shipped checkpoints by name, installed beside the program or in the source tree in which
/// it was built. Without names it returns the default ones. Throws Error(kNotFound) that lists the
/// places searched or the names that exist.
std::vector<std::filesystem::path> ShippedCheckpoints(const std::vector<std::string>& names);

}  // namespace choreo
