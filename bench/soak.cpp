#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <mutex>
#include <random>
#include <thread>

#include "bench/lateness.h"
#include "client/authoring/local_server.h"
#include "client/cli/options/options.h"
#include "model/audio/signal/format.h"
#include "model/core/error.h"
#include "server/process/process_usage.h"

/// Runs one choreod for a long time with well-behaved and misbehaving clients. Checks whether its
/// memory, threads and descriptors grow, and whether lateness of well-behaved clients increases.
namespace choreo::bench {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr double kSong_s = 20;
constexpr int kRate = kModelSampleRate;

struct Options {
  double minutes = 30;
  int dances = 4;
  std::string dance_at;  // the server for the crashing client
};

double MinutesSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count() / 60;
}

/// A process's resources at a moment.
struct Sample {
  double minute = 0, mebibytes = 0;
};

/// MiB per hour, by least squares.
double SlopeAnHour(const std::vector<Sample>& samples) {
  double minute = 0, mebibytes = 0, product = 0, square = 0;
  for (const Sample& sample : samples) {
    minute += sample.minute / static_cast<double>(samples.size());
    mebibytes += sample.mebibytes / static_cast<double>(samples.size());
  }
  for (const Sample& sample : samples) {
    product += (sample.minute - minute) * (sample.mebibytes - mebibytes);
    square += (sample.minute - minute) * (sample.minute - minute);
  }
  return 60 * product / square;
}

class Soak {
 public:
  explicit Soak(const Options& options) : options_(options) {}

  /// False if something grew.
  bool Run() {
    DanceLive(client::Client(ClientOptions()), song_, {});  // gRPC initialises on its first call
    const Usage before = Now();
    start_ = Clock::now();
    {
      std::vector<std::jthread> clients;
      for (int i = 0; i < options_.dances; ++i) {
        clients.emplace_back([this, i] { RunWellBehaved(i); });
        std::this_thread::sleep_for(milliseconds(500));  // spread over time
      }
      clients.emplace_back([this] { Crash(); });
      clients.emplace_back([this] { RunSilent(); });
      clients.emplace_back([this] { RunGreedy(); });
      while (!IsOver()) {
        std::this_thread::sleep_for(seconds(1));
        server_->RequireRunning();
        samples_.push_back({MinutesSince(start_), Mebibytes()});
      }
    }
    // gRPC closes connections a little later.
    const auto end = Clock::now() + seconds(20);
    Usage after = Now();
    while ((after.threads > before.threads || after.descriptors > before.descriptors) &&
           Clock::now() < end) {
      std::this_thread::sleep_for(milliseconds(100));
      after = Now();
    }
    return Report(before, after);
  }

 private:
  struct Usage {
    int64_t threads = 0, descriptors = 0;
  };

  client::Options ClientOptions() const { return {.addresses = {server_->address()}}; }
  bool IsOver() const { return MinutesSince(start_) >= options_.minutes; }
  Usage Now() const { return {Threads(server_->process()), Descriptors(server_->process())}; }
  double Mebibytes() const {
    return static_cast<double>(ResidentBytes(server_->process())) / (1 << 20);
  }
  // Sleeps, but not beyond the end.
  void Wait(milliseconds time) const {
    const auto end = Clock::now() + time;
    while (Clock::now() < end && !IsOver()) std::this_thread::sleep_for(milliseconds(50));
  }

  // One dance after another, in real time.
  void RunWellBehaved(int number) {
    const client::Client client(ClientOptions());
    for (uint32_t round = 0; !IsOver(); ++round) {
      const double minute = MinutesSince(start_);
      try {
        const Lateness lateness =
            DanceLive(client, song_, {.seed = round * 100 + static_cast<uint32_t>(number)});
        if (!lateness.refused_ms.empty())
          throw Error(ErrorCode::kResourceExhausted, "", "the server is full");
        const std::lock_guard lock(mutex_);
        ++danced_;
        if (minute < options_.minutes / 3) first_.Add(lateness);
        if (minute >= 2 * options_.minutes / 3) last_.Add(lateness);
      } catch (const Error& error) {
        std::fprintf(stderr, "soak: a dance was lost: %s\n", error.what());
        ++lost_;
        Wait(seconds(1));
      }
    }
  }

  // Kills a client process in the middle of its dance.
  void Crash() {
    std::minstd_rand random(1);
    while (!IsOver()) {
      std::string name = "soak", option = "--dance-at", address = server_->address();
      char* arguments[] = {name.data(), option.data(), address.data(), nullptr};
      pid_t process = 0;
      if (posix_spawn(&process, "/proc/self/exe", nullptr, nullptr, arguments, environ) != 0) {
        throw Error(ErrorCode::kInternal, "", "a client can't be started");
      }
      Wait(milliseconds(std::uniform_int_distribution(300, 4000)(random)));
      kill(process, SIGKILL);
      waitpid(process, nullptr, 0);
      ++crashes_;
    }
  }

  // Begins dances, sends nothing more, and disconnects.
  void RunSilent() {
    while (!IsOver()) {
      const client::Client client(ClientOptions());
      std::vector<std::unique_ptr<client::RemoteDance>> dances;
      for (uint64_t i = 0; i < 4; ++i)
        dances.push_back(client.StartDance({.seed = i, .audio = song_.format}));
      Wait(seconds(20));
      silent_ += static_cast<int>(dances.size());
    }
  }

  // Requests more than it reads: endless alternatives, and dances.
  void RunGreedy() {
    const client::Client client(ClientOptions());
    while (!IsOver()) {
      std::vector<std::unique_ptr<client::RemoteDance>> dances;
      try {
        for (uint64_t i = 0; i < 8; ++i) {
          dances.push_back(client.StartDance({.seed = i, .frames = 600}));
          dances.back()->CompleteKeys();
        }
        client.GenerateTransition({.frames = 150, .candidates = 8});
      } catch (const Error&) {  // the server asks it to retry
        ++refused_;
      }
      greedy_ += static_cast<int>(dances.size()) + 1;
      Wait(seconds(4));
    }
  }

  bool Report(const Usage& before, const Usage& after) {
    const double warm = options_.minutes / 6;
    std::erase_if(samples_, [&](const Sample& sample) { return sample.minute < warm; });
    const double slope = samples_.size() > 2 ? SlopeAnHour(samples_) : 0;
    std::printf(
        "%g minutes: %d dances in real time, %d lost; beside them %d clients killed, %d silent "
        "dances, %d greedy calls (%d refused)\n",
        options_.minutes, danced_.load(), lost_.load(), crashes_.load(), silent_.load(),
        greedy_.load(), refused_.load());
    if (samples_.size() > 2) {
      std::printf("memory %.1f MiB at minute %.1f, %.1f at the end, %+.2f MiB an hour between\n",
                  samples_.front().mebibytes, samples_.front().minute, samples_.back().mebibytes,
                  slope);
    }
    std::printf("threads %ld -> %ld, descriptors %ld -> %ld\n", before.threads, after.threads,
                before.descriptors, after.descriptors);
    std::printf(
        "frames behind their music, first third: p50 %.1f ms, p99 %.1f ms; last third: p50 "
        "%.1f ms, p99 %.1f ms\n",
        Percentile(first_.all_ms, 0.5), Percentile(first_.all_ms, 0.99),
        Percentile(last_.all_ms, 0.5), Percentile(last_.all_ms, 0.99));
    // gRPC keeps a few threads for a while.
    constexpr int64_t kSpareThreads = 8, kSpareDescriptors = 4;
    return lost_ == 0 && after.threads <= before.threads + kSpareThreads &&
           after.descriptors <= before.descriptors + kSpareDescriptors;
  }

  const Options options_;
  const std::unique_ptr<authoring::LocalServer> server_ = authoring::LocalServer::Start("");
  const client::Audio song_ = ClickSong(kSong_s, kRate, 1);
  Clock::time_point start_;
  std::vector<Sample> samples_;
  std::atomic<int> danced_ = 0, lost_ = 0, crashes_ = 0, silent_ = 0, greedy_ = 0, refused_ = 0;
  std::mutex mutex_;  // guards the two below
  Lateness first_, last_;
};

// The client to be killed: dances until then.
[[noreturn]] void DanceForEver(const std::string& address) {
  const client::Client client({.addresses = {address}});
  const client::Audio song = ClickSong(kSong_s, kRate, 1);
  for (uint32_t seed = 0;; ++seed) DanceLive(client, song, {.seed = seed});
}

}  // namespace
}  // namespace choreo::bench

int main(int argc, char** argv) {
  CLI::App program{
      "Starts a choreod and leaves it for long among clients that behave and others that crash, "
      "fall silent or want too much; prints what grew. Fails where threads or descriptors did, or "
      "a dance was lost.",
      "soak"};
  choreo::bench::Options options;
  program.add_option("--minutes", options.minutes, "How long.")
      ->check(choreo::cli::NumberFrom(0.1, 10'000))
      ->capture_default_str();
  program.add_option("--dances", options.dances, "Clients that behave.")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  program.add_option("--dance-at", options.dance_at)->group("");
  CLI11_PARSE(program, argc, argv);
  try {
    if (!options.dance_at.empty()) choreo::bench::DanceForEver(options.dance_at);
    return choreo::bench::Soak(options).Run() ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "soak: " << error.what() << '\n';
    return 1;
  }
}
