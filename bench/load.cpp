#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <functional>
#include <iostream>
#include <mutex>
#include <thread>

#include "bench/cold_start.h"
#include "bench/edited_dance.h"
#include "bench/lateness.h"
#include "bench/relay.h"
#include "client/authoring/keys/pose_library.h"
#include "client/authoring/local_server.h"
#include "client/authoring/music/music.h"
#include "client/cli/options/options.h"
#include "model/audio/signal/format.h"
#include "model/audio/signal/mfcc.h"
#include "model/core/error.h"
#include "server/process/process_usage.h"

/// Measures how many dances one choreod serves over gRPC, on a machine that also runs all its
/// clients. The server has its defaults, or the environment's settings (choreod --help).
namespace choreo::bench {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  std::string song;
  double seconds = 8;
  std::optional<double> temperature;
  std::vector<int> streams = {1, 20, 50, 60, 100, 200};
  std::vector<int> addresses = {1, 4};
  std::vector<std::string> tables = {"start", "chunks", "live",   "beside",
                                     "edits", "closed", "minutes"};
};

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Runs `dance(i)` for i in [0, count) concurrently; throws the first error when all have ended.
void Together(int count, const std::function<void(int)>& dance) {
  std::vector<std::thread> dancers;
  std::mutex mutex;
  std::exception_ptr failed;
  for (int i = 0; i < count; ++i) {
    dancers.emplace_back([&, i] {
      try {
        dance(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failed) failed = std::current_exception();
      }
    });
  }
  for (std::thread& dancer : dancers) dancer.join();
  if (failed) std::rethrow_exception(failed);
}

// The server under load, and its clients.
class Load {
 public:
  explicit Load(const Options& options)
      : options_(options),
        client_({.addresses = {server_->address()}}),
        song_(options.song.empty()
                  ? ClickSong(options.seconds, 44100, 1)
                  : authoring::AudioFor(authoring::ReadSong(options.song, options.seconds + 1, 0),
                                        options.seconds)) {
    const client::ServerDescription server = client_.GetServerInfo();
    std::printf("model %s on %s, %u cores; dances of %g s in real time, a key each 2 s\n",
                server.models.front().name.c_str(), server.devices.front().c_str(),
                std::thread::hardware_concurrency(), options.seconds);
  }

  /// Dances for which a server is started, once the programs are in the system's cache.
  void Starts() {
    constexpr int kTimes = 5;
    std::vector<double> listens_ms, first_ms;
    for (int i = 0; i < kTimes; ++i) {
      const ColdStart cold = DanceFromStart(song_);
      listens_ms.push_back(cold.listens_ms);
      first_ms.push_back(cold.first_frame_ms);
    }
    std::printf(
        "\n| a dance without a server | until it listens p50 ms | until the first frame p50 ms |\n"
        "|---|---|---|\n| started %d times | %.0f | %.0f |\n",
        kTimes, Percentile(listens_ms, 0.5), Percentile(first_ms, 0.5));
    std::fflush(stdout);
  }

  /// Lateness by the size of music chunks, with four dances at once.
  void Chunks() {
    std::printf(
        "\n| chunks ms | first frame p50 ms | p99 | frames p50 ms | p95 | p99 | max | "
        "missed %% |\n|---|---|---|---|---|---|---|---|\n");
    for (const auto& [shortest, longest] :
         {std::pair(5.0, 5.0), {20.0, 20.0}, {100.0, 100.0}, {500.0, 500.0}, {5.0, 500.0}}) {
      Lateness lateness = Live(4, shortest / 1000, longest / 1000);
      std::printf("| %g to %g ", shortest, longest);
      PrintLateness(lateness);
      std::printf("|\n");
      std::fflush(stdout);
    }
  }

  /// Concurrent real-time streams, with music in chunks of 100 ms. Admitted streams dance; the
  /// others are asked to retry later.
  void Streams() {
    std::printf(
        "\n| streams | from addresses | admitted | refused, with a time to come back | told after "
        "ms, p99 | first frame p50 ms | p99 | frames p50 ms | p95 | p99 | max | missed %% | "
        "server's CPU, ms for a second of dance | server MiB |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const int addresses : options_.addresses) {
      for (const int streams : options_.streams) {
        if (streams < addresses) continue;
        const double cpu = CpuSeconds(server_->process());
        Lateness lateness = Live(streams, 0.1, 0.1, addresses);
        const size_t admitted = lateness.first_ms.size();
        const double cost = (CpuSeconds(server_->process()) - cpu) /
                            (static_cast<double>(admitted) * options_.seconds);
        std::printf("| %d | %d | %zu | %zu | ", streams, addresses, admitted,
                    lateness.refused_ms.size());
        if (!lateness.refused_ms.empty())
          std::printf("%.0f ", Percentile(lateness.refused_ms, 0.99));
        PrintLateness(lateness);
        std::printf("| %.1f | %.0f |\n", 1000 * cost, Mebibytes());
        std::fflush(stdout);
      }
    }
  }

  /// One live dance beside calls that use all capacity.
  void Beside() {
    PrintBesideHead();
    DanceBeside("nothing", [](const std::atomic<bool>&) { return 0; });
    for (const auto& [frames, candidates] : {std::pair(1800, 32), {600, 32}, {300, 8}}) {
      const std::string name = std::to_string(frames) + " frames, " + std::to_string(candidates) +
                               " candidates, again and again";
      DanceBeside(name, [&, frames = frames, candidates = candidates](const auto& over) {
        return AskForTransitions(frames, candidates, over);
      });
    }
    DanceBeside("5,000 times 1800 frames, 32 candidates, with 1 ms each",
                [this](const std::atomic<bool>& over) { return CallAfterDeadline(5'000, over); });
  }

  /// One live dance beside others whose next key poses are dragged.
  void Edits() {
    PrintBesideHead();
    DanceBeside("8 dances with 30 edits a second each", [this](const auto& over) {
      std::atomic<int64_t> frames = 0;
      Together(
          8, [&](int i) { frames += DanceEdited(client_, song_, static_cast<uint64_t>(i), over); });
      return frames.load();
    });
  }

  /// Dances one after another, as fast as possible.
  void Closed() {
    std::printf(
        "\n| dances at once, music known ahead | frames/s | frames/s of the server's CPU "
        "time |\n|---|---|---|\n");
    for (const int streams : {1, 8, 32}) {
      const double cpu = CpuSeconds(server_->process());
      const Clock::time_point start = Clock::now();
      std::atomic<int64_t> frames = 0;
      Together(streams, [&](int i) {
        for (int round = 0; round < 4; ++round) frames += DanceAtOnce(song_, i + 100 * round);
      });
      const auto count = static_cast<double>(frames.load());
      std::printf("| %d | %.0f | %.0f |\n", streams, count / Since(start),
                  count / (CpuSeconds(server_->process()) - cpu));
      std::fflush(stdout);
    }
  }

  /// Memory of streams that wait for music, more than the defaults admit.
  void Idle() {
    constexpr int kStreams = 128;
    const double before = Mebibytes();
    std::vector<std::unique_ptr<client::RemoteDance>> dances;
    for (int i = 0; i < kStreams; ++i) {
      dances.push_back(client_.StartDance({.seed = 1, .audio = song_.format}));
      SendKeys(*dances.back(), options_.seconds, 2);
      dances.back()->SendSamples(std::span(song_.samples).first(4410));
      while (const std::optional<client::Message> message = dances.back()->Next())
        if (std::holds_alternative<client::Header>(*message)) break;
    }
    std::printf("\n%d idle streams: %.0f KiB each\n", kStreams,
                (Mebibytes() - before) * 1024 / kStreams);
  }

  /// Compares the tenth minute of streams with their first.
  void Minutes() {
    constexpr int kStreams = 8, kMinutes = 10;
    std::printf("\n| minute | ms of the server's CPU a frame | server MiB |\n|---|---|---|\n");
    constexpr int64_t kFrames = 1790;  // of a minute: ten with their music are a song's limit
    const client::Audio song = ClickSong(60 * kMinutes, kModelSampleRate, 1);
    struct Stream {
      std::unique_ptr<client::RemoteDance> dance;
      size_t sent = 0;
      int64_t frames = 0;
    };
    std::vector<Stream> streams(kStreams);
    for (int i = 0; i < kStreams; ++i) {
      streams[i].dance =
          client_.StartDance({.seed = static_cast<uint64_t>(i), .audio = song.format});
      SendKeys(*streams[i].dance, 60 * kMinutes, 2);
    }
    const auto samples = size_t{kFrames} * kFeatureHop;
    for (int minute = 1; minute <= kMinutes; ++minute) {
      // Like a player, but faster: sends a minute of music once the previous minute's frames have
      // arrived.
      const double before = CpuSeconds(server_->process());
      for (Stream& stream : streams) {
        const size_t ahead = minute == 1 ? size_t{kModelSampleRate} : 0;
        const auto next = std::span(song.samples).subspan(stream.sent);
        stream.dance->SendSamples(next.first(std::min(samples + ahead, next.size())));
        stream.sent += std::min(samples + ahead, next.size());
        if (stream.sent == song.samples.size()) stream.dance->EndAudio();
      }
      for (Stream& stream : streams) {
        while (stream.frames < minute * kFrames) {
          const std::optional<client::Message> message = stream.dance->Next();
          if (!message) break;
          if (const auto* block = std::get_if<client::FrameBlock>(&*message))
            stream.frames += static_cast<int64_t>(block->poses.size());
        }
      }
      if (minute > 1 && minute < kMinutes) continue;
      const double used = CpuSeconds(server_->process()) - before;
      std::printf("| %d | %.3f | %.0f |\n", minute, 1000 * used / (kStreams * kFrames),
                  Mebibytes());
      std::fflush(stdout);
    }
  }

 private:
  static void PrintBesideHead() {
    std::printf(
        "\n| beside one live dance | frames p50 ms | p95 | p99 | max | missed %% | others' "
        "frames/s |\n|---|---|---|---|---|---|---|\n");
  }
  // Makes one dance beside `others`, which runs until shortly after its flag is set and returns the
  // number of frames it received.
  void DanceBeside(const std::string& name,
                   const std::function<int64_t(const std::atomic<bool>&)>& others) {
    std::atomic<bool> over = false;
    int64_t frames = 0;
    std::thread beside([&] { frames = others(over); });
    std::this_thread::sleep_for(std::chrono::milliseconds(500));  // they have started
    const Clock::time_point start = Clock::now();
    Lateness lateness = DanceLive(client_, song_, {.seed = 1});
    const double took = Since(start);
    over = true;
    beside.join();
    if (lateness.all_ms.empty())
      throw Error(ErrorCode::kResourceExhausted, "", "a dance beside " + name + " was refused");
    std::printf("| %s ", name.c_str());
    PrintFrames(lateness);
    std::printf("| %.0f |\n", static_cast<double>(frames) / took);
    std::fflush(stdout);
  }

  client::TransitionRequest Transition(int frames, int candidates) const {
    client::TransitionRequest request;
    request.frames = frames;
    request.candidates = candidates;
    request.target = {.pose = authoring::PoseLibrary().front().pose};
    return request;
  }

  int64_t AskForTransitions(int frames, int candidates, const std::atomic<bool>& over) const {
    // Cancels what is in progress when the dance ends.
    const client::Client client(
        {.addresses = {server_->address()}, .deadline_s = options_.seconds + 1, .retry_s = 0});
    int64_t made = 0;
    while (!over) {
      try {
        for (const auto& candidate :
             client.GenerateTransition(Transition(frames, candidates)).candidates)
          made += static_cast<int64_t>(candidate.motion.frames.size());
      } catch (const Error& error) {
        // Its deadline passed, or the full server asks it to retry.
        if (error.code() != ErrorCode::kDeadlineExceeded &&
            error.code() != ErrorCode::kResourceExhausted)
          throw;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
      }
    }
    return made;
  }

  // Calls whose deadline passes before they are handled.
  int64_t CallAfterDeadline(int calls, const std::atomic<bool>& over) const {
    constexpr int kCallers = 50;
    const client::Client client(
        {.addresses = {server_->address()}, .deadline_s = 1e-3, .retry_s = 0});
    Together(kCallers, [&](int) {
      for (int i = 0; i < calls / kCallers && !over; ++i) {
        try {
          client.GenerateTransition(Transition(1800, 32));
        } catch (const Error&) {  // as expected
        }
      }
    });
    return 0;
  }

  Lateness Live(int streams, double shortest_s, double longest_s, int addresses = 1) {
    // The first client connects directly. Relays give the others addresses of their own, which
    // limits per address need.
    std::vector<std::unique_ptr<Relay>> relays;
    std::vector<client::Client> clients;
    for (int i = 0; i < addresses; ++i) {
      if (i > 0) relays.push_back(std::make_unique<Relay>(server_->address(), 1 + i));
      client::Options options{.addresses = {i > 0 ? relays.back()->address() : server_->address()}};
      // Without a retry time a refused client does not retry, and fails.
      options.before_retry = [] {
        throw Error(ErrorCode::kResourceExhausted, "", "is to come back later");
      };
      clients.emplace_back(std::move(options));
    }
    Lateness all;
    std::mutex mutex;
    Together(streams, [&](int i) {
      // Spread over time.
      std::this_thread::sleep_for(std::chrono::duration<double>(2.0 * i / streams));
      const Lateness one = DanceLive(clients[static_cast<size_t>(i % addresses)], song_,
                                     {.shortest_chunk_s = shortest_s,
                                      .longest_chunk_s = longest_s,
                                      .seed = static_cast<uint32_t>(i + 1)});
      const std::lock_guard lock(mutex);
      all.Add(one);
    });
    return all;
  }

  int64_t DanceAtOnce(const client::Audio& song, int seed) {
    client::DanceConfig config{.seed = static_cast<uint64_t>(seed), .audio = song.format};
    config.manner.temperature = options_.temperature;
    const auto dance = client_.StartDance(config);
    SendKeys(*dance, options_.seconds, 2);
    dance->SendSamples(song.samples);
    dance->EndAudio();
    int64_t frames = 0;
    while (const std::optional<client::Message> message = dance->Next())
      if (const auto* block = std::get_if<client::FrameBlock>(&*message))
        frames += static_cast<int64_t>(block->poses.size());
    return frames;
  }

  static void PrintLateness(Lateness& lateness) {
    std::printf("| %.1f | %.1f ", Percentile(lateness.first_ms, 0.5),
                Percentile(lateness.first_ms, 0.99));
    PrintFrames(lateness);
  }
  static void PrintFrames(Lateness& lateness) {
    std::printf("| %.1f | %.1f | %.1f | %.0f | %.2f ", Percentile(lateness.all_ms, 0.5),
                Percentile(lateness.all_ms, 0.95), Percentile(lateness.all_ms, 0.99),
                Percentile(lateness.all_ms, 1),
                100.0 * lateness.missed / static_cast<double>(lateness.all_ms.size()));
  }

  double Mebibytes() const {
    return static_cast<double>(ResidentBytes(server_->process())) / (1 << 20);
  }

  Options options_;
  const std::unique_ptr<authoring::LocalServer> server_ = authoring::LocalServer::Start("");
  client::Client client_;
  client::Audio song_;
};

}  // namespace
}  // namespace choreo::bench

int main(int argc, char** argv) {
  using choreo::bench::Load;
  CLI::App program{"Starts a choreod, loads it over gRPC, and measures when the frames come.",
                   "load"};
  choreo::bench::Options options;
  program.add_option("--song", options.song, "Default: a made-up one, 44.1 kHz.")
      ->check(CLI::ExistingFile);
  program.add_option("--seconds", options.seconds, "Length of a dance.")
      ->check(choreo::cli::NumberFrom(2, choreo::kMaxAudioSeconds))
      ->capture_default_str();
  program.add_option("--temperature", options.temperature,
                     "Of the dances in the table closed. Default: the model's.");
  program.add_option("--streams", options.streams, "Real-time streams at once.")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  program
      .add_option("--addresses", options.addresses,
                  "Addresses that they come from, each an equal share of them.")
      ->check(CLI::Range(1, 200))
      ->capture_default_str();
  const std::vector<std::pair<std::string, void (Load::*)()>> tables = {
      {"idle", &Load::Idle},  // first: memory freed by other tables would hide its use
      {"start", &Load::Starts},   {"chunks", &Load::Chunks}, {"live", &Load::Streams},
      {"beside", &Load::Beside},  {"edits", &Load::Edits},   {"closed", &Load::Closed},
      {"minutes", &Load::Minutes}};
  std::vector<std::string> names;
  for (const auto& table : tables) names.push_back(table.first);
  program.add_option("--tables", options.tables, "What to measure.")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  CLI11_PARSE(program, argc, argv);
  try {
    Load load(options);
    for (const auto& [name, measure] : tables)
      if (std::ranges::find(options.tables, name) != options.tables.end()) (load.*measure)();
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "load: " << error.what() << '\n';
    return 1;
  }
}
