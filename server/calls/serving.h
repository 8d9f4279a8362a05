#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "server/calls/call_registry.h"
#include "server/calls/frame_budget.h"
#include "server/calls/models.h"
#include "server/messages/music_file.h"
#include "server/process/task_pool.h"
#include "server/settings/reloads.h"
#include "server/settings/tokens.h"
#include "server/telemetry/tally.h"

namespace choreo {

/// The state shared by a server's calls. Thread-safe after construction; outlives every call.
struct Serving {
  Serving(std::vector<std::unique_ptr<SampleQueue>> queues, const CallLimits& limits,
          const FrameShares& shares, std::filesystem::path tokens_file, size_t outbox_limit,
          int64_t file_music_bytes, int candidates, int io_threads,
          const TimeSource& time = TimeSource::System())
      : calls(limits, time),
        frames(
            shares, [this](const std::string& caller) { return calls.HasRival(caller); }, &cost,
            time),
        tokens(std::move(tokens_file)),
        outbox_bytes(outbox_limit),
        file_music(file_music_bytes),
        max_candidates(candidates),
        models(std::move(queues)),
        decoding(io_threads),
        tasks(io_threads) {}

  /// A seed for requests without one.
  static uint64_t FreshSeed();

  /// Updates the cost of serving. Call regularly.
  void LookAtCost();

  CallRegistry calls;
  ServingCost cost;
  FrameBudget frames;
  Tokens tokens;
  Tally tally;
  Reloads reloads;
  const size_t outbox_bytes;
  MusicBudget file_music;
  const int max_candidates;  ///< of one transition, 1..kMaxCandidates
  // Last, because their threads use all members above.
  Models models;
  TaskPool decoding;  ///< decodes music files, which is slow, so that other calls do not wait
  TaskPool tasks;     ///< runs tasks too long for gRPC's threads, but of seconds at most
};

}  // namespace choreo
