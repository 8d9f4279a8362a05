#include "server/figures.h"

#include <prometheus/client_metric.h>
#include <prometheus/metric_family.h>
#include <prometheus/metric_type.h>
#include <prometheus/text_serializer.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "server/connections/caller.h"
#include "server/connections/frame_guard.h"
#include "server/connections/handshakes.h"
#include "server/messages/refusal.h"
#include "server/messages/status.h"
#include "server/process/process_usage.h"

namespace choreo {
namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;
using prometheus::MetricType;
using Labels = std::vector<ClientMetric::Label>;

constexpr const char* kMethods[] = {"StreamDance", "GenerateTransition", Tally::kInfoMethod};

/// The metric families of one scrape, in order.
class Families {
 public:
  /// Sets the prefix of the following families. Process metrics use the names common to all
  /// programs.
  void SetPrefix(const char* prefix) { prefix_ = prefix; }
  /// Begins a family, to which the next calls of Add belong.
  void Begin(const char* name, const char* help, MetricType type) {
    families_.push_back(
        {.name = std::string(prefix_) + name, .help = help, .type = type, .metric = {}});
  }
  void Add(double value, Labels labels = {}) {
    ClientMetric& metric = Append(std::move(labels));
    (families_.back().type == MetricType::Counter ? metric.counter.value : metric.gauge.value) =
        value;
  }
  void Add(const Histogram::Snapshot& values, Labels labels = {}) {
    auto& histogram = Append(std::move(labels)).histogram;
    for (size_t i = 0; i < values.counts.size(); ++i) {
      histogram.sample_count += values.counts[i];
      const double bound = i < values.bounds.size() ? values.bounds[i] : INFINITY;
      histogram.bucket.push_back({histogram.sample_count, bound});
    }
    histogram.sample_sum = values.sum;
  }
  std::vector<MetricFamily> Take() { return std::move(families_); }

 private:
  ClientMetric& Append(Labels labels) {
    ClientMetric& metric = families_.back().metric.emplace_back();
    metric.label = std::move(labels);
    return metric;
  }

  const char* prefix_ = "choreo_";
  std::vector<MetricFamily> families_;
};

class Figures {
 public:
  explicit Figures(const Serving& serving) : serving_(serving) {}

  std::vector<MetricFamily> Collect() const {
    Families out;
    const std::map<std::string, Models::Figures> models = serving_.models.figures();
    AddCalls(models, out);
    AddHolders(out);
    AddModels(models, out);
    AddReloads(out);
    AddHistograms(models, out);
    try {
      AddProcess(out);
    } catch (const Error&) {  // /proc cannot be read; report the rest
    }
    return out.Take();
  }

 private:
  void AddCalls(const std::map<std::string, Models::Figures>& models, Families& out) const {
    out.Begin("calls_total", "Finished calls, by method and status.", MetricType::Counter);
    // Reports all series from the start, because Prometheus' rates miss a series' first value.
    const Tally::Calls counted = serving_.tally.calls();
    for (const char* method : kMethods) {
      for (int code = 0; code <= grpc::StatusCode::UNAUTHENTICATED; ++code) {
        const auto status = static_cast<grpc::StatusCode>(code);
        const auto found = counted.find({method, status});
        out.Add(found == counted.end() ? 0 : static_cast<double>(found->second),
                {{"method", method}, {"status", NameOf(status)}});
      }
    }
    out.Begin("call_seconds", "How long calls took, by method and status.", MetricType::Histogram);
    // Only successful calls have series from the start, because other statuses would be many.
    auto durations = serving_.tally.seconds();
    for (const char* method : kMethods)
      durations.try_emplace({method, grpc::StatusCode::OK},
                            Histogram(Histogram::CallSeconds()).snapshot());
    for (const auto& [kind, seconds] : durations)
      out.Add(seconds, {{"method", kind.first}, {"status", NameOf(kind.second)}});
    out.Begin("refused_calls_total",
              "Refused calls, by reason: no room, no valid token, or a draining server.",
              MetricType::Counter);
    const Tally::Refusals refusals = serving_.tally.refusals();
    for (size_t i = 0; i < kRefusals.size(); ++i)
      out.Add(static_cast<double>(refusals[i]), {{"reason", kRefusals[i]}});
    out.Begin("header_floods_total", "Connections closed because of endless headers.",
              MetricType::Counter);
    out.Add(static_cast<double>(HeaderFloods()));
    out.Begin("empty_frame_floods_total",
              "Connections closed because of too many frames of little content, or too many calls.",
              MetricType::Counter);
    out.Add(static_cast<double>(EmptyFrameFloods()));
    out.Begin("connections_total", "Connections, including refused ones.", MetricType::Counter);
    out.Add(static_cast<double>(serving_.tally.connections));
    out.Begin("refused_connections_total",
              "Connections closed on arrival, by what their address had done.",
              MetricType::Counter);
    for (size_t i = 0; i < kConnectionRefusals.size(); ++i)
      out.Add(static_cast<double>(serving_.tally.refused_connections[i]),
              {{"reason", kConnectionRefusals[i]}});
    const CallRegistry& calls = serving_.calls;
    out.Begin("draining", "1 once the server is draining, 0 before.", MetricType::Gauge);
    out.Add(calls.admitting() ? 0 : 1);
    out.Begin("streams", "Calls in progress that have sent their first message.",
              MetricType::Gauge);
    out.Add(calls.count());
    out.Begin("streams_limit", "Most calls that may be in progress.", MetricType::Gauge);
    out.Add(calls.limits().calls);
    out.Begin("utilisation",
              "The fullest of all limits: calls, load, candidates, music files, and the busiest "
              "caller's share of calls and load. At 1 calls are refused.",
              MetricType::Gauge);
    double fullest = std::max(
        {calls.utilisation(), serving_.frames.utilisation(), serving_.file_music.utilisation()});
    for (const auto& [model, figures] : models)
      fullest = std::max(fullest, figures.stats.bulk_share);
    out.Add(fullest);
    out.Begin("sent_frames_total", "Frames of finished calls.", MetricType::Counter);
    out.Add(static_cast<double>(serving_.tally.frames));
    out.Begin("dances_resumed_total",
              "Dances resumed from an earlier call, mostly of a lost server.", MetricType::Counter);
    out.Add(static_cast<double>(serving_.tally.dances_resumed));
    out.Begin("first_frame_seconds", "Time from a call's start to its first frame.",
              MetricType::Histogram);
    out.Add(serving_.tally.first_frame_s.snapshot());
    out.Begin(
        "sending_lateness_seconds",
        "Lateness of sending frames to a client that plays them, beyond the lateness of sampling.",
        MetricType::Histogram);
    out.Add(serving_.tally.sending_lateness_s.snapshot());
  }

  // Each name is a permanent series, so their number is limited.
  void AddHolders(Families& out) const {
    constexpr size_t kMostHolders = 100;
    const std::vector<std::string> names = serving_.tokens.Names(kMostHolders);
    if (names.empty()) return;
    const auto add = [&](const char* name, const char* help, MetricType type, auto figure) {
      out.Begin(name, help, type);
      for (const std::string& holder : names) {
        out.Add(static_cast<double>(figure(holder)), {{"holder", holder}});
      }
    };
    const Tally& tally = serving_.tally;
    add("holder_streams", "Calls in progress of a token's holder, of the first 100.",
        MetricType::Gauge, [&](const std::string& holder) {
          Caller caller;
          caller.holder = holder;
          return serving_.calls.CountOf(caller.Name());
        });
    add("holder_calls_total", "Calls of a token's holder that danced or failed.",
        MetricType::Counter, [&](const std::string& holder) { return tally.SumOf(holder).served; });
    add("holder_refused_calls_total", "Refused calls of a token's holder.", MetricType::Counter,
        [&](const std::string& holder) { return tally.SumOf(holder).refused; });
  }

  void AddModels(const std::map<std::string, Models::Figures>& models, Families& out) const {
    out.Begin("model_info", "1 for each model and device.", MetricType::Gauge);
    for (const Models::Use& model : serving_.models.served()) {
      std::vector<std::string> devices = model->devices();
      std::ranges::sort(devices);
      devices.erase(std::unique(devices.begin(), devices.end()), devices.end());
      for (const std::string& device : devices) {
        out.Add(1, {{"model", model->model().name},
                    {"fingerprint", model->model().fingerprint},
                    {"device", device},
                    {"version", CHOREO_VERSION}});
      }
    }
    out.Begin("load", "Share of the cores' and engines' time that calls in progress may need.",
              MetricType::Gauge);
    std::map<std::string, double> loads = serving_.frames.loads();
    for (const auto& [model, figures] : models) out.Add(loads[model], {{"model", model}});
    struct Figure {
      const char* name;
      const char* help;
      MetricType type;
      double (*of)(const SampleQueue::Stats&);
    };
    using Stats = SampleQueue::Stats;
    static constexpr Figure kFigures[] = {
        {"workers", "Workers, which sample transitions in turns.", MetricType::Gauge,
         [](const Stats& stats) { return double(stats.workers); }},
        {"transitions_active", "Transitions in progress.", MetricType::Gauge,
         [](const Stats& stats) { return double(stats.active); }},
        {"transitions_waiting", "Transitions that wait for a worker.", MetricType::Gauge,
         [](const Stats& stats) { return double(stats.waiting); }},
        {"engine_failures", "Consecutive failures of an engine.", MetricType::Gauge,
         [](const Stats& stats) { return double(stats.failures); }},
        {"frames_total", "Frames made.", MetricType::Counter,
         [](const Stats& stats) { return double(stats.frames); }},
        {"transitions_total", "Transitions made.", MetricType::Counter,
         [](const Stats& stats) { return double(stats.transitions); }},
    };
    for (const Figure& figure : kFigures) {
      out.Begin(figure.name, figure.help, figure.type);
      for (const auto& [model, figures] : models) {
        out.Add(figure.of(figures.stats), {{"model", model}});
      }
    }
  }

  void AddReloads(Families& out) const {
    const Reloads::States states = serving_.reloads.states();
    out.Begin("last_reload_successful", "0 if the last reload failed, wholly or in part, else 1.",
              MetricType::Gauge);
    for (size_t i = 0; i < states.size(); ++i)
      out.Add(states[i].good ? 1 : 0, {{"of", Reloads::kNames[i]}});
    out.Begin("last_reload_success_timestamp_seconds",
              "Time of the last complete reload, seconds since 1970.", MetricType::Gauge);
    for (size_t i = 0; i < states.size(); ++i)
      out.Add(states[i].succeeded_at, {{"of", Reloads::kNames[i]}});
    const double expires = serving_.reloads.certificate_expires;
    if (expires == 0) return;
    out.Begin("certificate_expiry_timestamp_seconds",
              "Time when the certificate in use, or one of its chain, expires, seconds since 1970.",
              MetricType::Gauge);
    out.Add(expires);
    if (const double of_clients = serving_.reloads.client_ca_expires; of_clients > 0) {
      out.Begin("client_ca_expiry_timestamp_seconds",
                "Time when the last certificate of --tls-client-ca expires, seconds since 1970.",
                MetricType::Gauge);
      out.Add(of_clients);
    }
    out.Begin("tls_handshake_failures_total", "TLS handshakes that failed, by reason.",
              MetricType::Counter);
    const HandshakeFaults faults = CountedHandshakeFaults();
    for (size_t i = 0; i < faults.size(); ++i)
      out.Add(static_cast<double>(faults[i]), {{"reason", kHandshakeFaults[i]}});
  }

  void AddHistograms(const std::map<std::string, Models::Figures>& models, Families& out) const {
    using Histograms = SampleQueue::Histograms;
    struct Figure {
      const char* name;
      const char* help;
      Histogram::Snapshot Histograms::*of;
    };
    static constexpr Figure kFigures[] = {
        {"slice_seconds", "Time of one slice of a transition, for which all else waits.",
         &Histograms::slice_s},
        {"transition_seconds", "Time of a transition, all of its slices.",
         &Histograms::transition_s},
        {"lateness_seconds", "Lateness of sampling a dance's transitions, 0 if in time.",
         &Histograms::lateness_s},
    };
    for (const Figure& figure : kFigures) {
      out.Begin(figure.name, figure.help, MetricType::Histogram);
      for (const auto& [model, figures] : models) {
        out.Add(figures.histograms.*figure.of, {{"model", model}});
      }
    }
    const auto add = [&](const char* name, const char* help, auto quality) {
      out.Begin(name, help, MetricType::Histogram);
      for (const auto& [model, figures] : models)
        out.Add((serving_.tally.QualityOf(model).*quality).snapshot(), {{"model", model}});
    };
    add("steered_metres", "How far the way to a key moves a joint off the model's motion, at most.",
        &Tally::Quality::steered_m);
    add("support_ratio", "Share of a dance's frames in which something supports the body.",
        &Tally::Quality::support);
  }

  // Prometheus clients in all languages use these names.
  static void AddProcess(Families& out) {
    const pid_t self = getpid();
    // Computed once, because clocks drift and each change of this value raises an alert.
    static const double start = StartSeconds(self);
    rlimit descriptors{};
    getrlimit(RLIMIT_NOFILE, &descriptors);
    out.SetPrefix("process_");
    out.Begin("cpu_seconds_total", "CPU time used.", MetricType::Counter);
    out.Add(CpuSeconds(self));
    const std::tuple<const char*, const char*, double> gauges[] = {
        {"resident_memory_bytes", "Resident memory.", double(ResidentBytes(self))},
        {"virtual_memory_bytes", "Virtual memory.", double(VirtualBytes(self))},
        {"open_fds", "Open file descriptors.", double(Descriptors(self))},
        {"max_fds", "Most file descriptors that may be open.", double(descriptors.rlim_cur)},
        {"threads", "Threads.", double(Threads(self))},
        {"start_time_seconds", "Start time of the process, seconds since 1970.", start},
    };
    for (const auto& [name, help, value] : gauges) {
      out.Begin(name, help, MetricType::Gauge);
      out.Add(value);
    }
  }

  const Serving& serving_;
};

}  // namespace

std::string FiguresOf(const Serving& serving) {
  return prometheus::TextSerializer().Serialize(Figures(serving).Collect());
}

}  // namespace choreo
