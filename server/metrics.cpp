#include "server/metrics.h"

#include <poll.h>
#include <prometheus/client_metric.h>
#include <prometheus/collectable.h>
#include <prometheus/metric_family.h>
#include <prometheus/metric_type.h>
#include <prometheus/text_serializer.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <string_view>
#include <vector>

#include "model/core/error.h"
#include "server/listener.h"
#include "server/status.h"

namespace choreo {
namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;
using prometheus::MetricType;
using Labels = std::vector<ClientMetric::Label>;

/// Those who ask are answered one after the other: there is one Prometheus, maybe two. (The
/// library's own HTTP server cannot run beside LibTorch: its threads' stacks are smaller than what
/// LibTorch wants of each thread.)
constexpr int kPatienceMs = 1'000;
constexpr size_t kMostRequestBytes = 8 << 10;

/// The families of one look, in order.
class Families {
 public:
  /// Begins a family, which the next calls of Add belong to.
  void Begin(const char* name, const char* help, MetricType type) {
    families_.push_back(
        {.name = std::string("choreo_") + name, .help = help, .type = type, .metric = {}});
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

  std::vector<MetricFamily> families_;
};

class Figures final : public prometheus::Collectable {
 public:
  explicit Figures(const Serving& serving) : serving_(serving) {}

  std::vector<MetricFamily> Collect() const override {
    Families out;
    AddCalls(out);
    const std::map<std::string, Models::Figures> models = serving_.models.figures();
    AddModels(models, out);
    AddHistograms(models, out);
    return out.Take();
  }

 private:
  void AddCalls(Families& out) const {
    out.Begin("calls_total", "Calls that are over, by method and status.", MetricType::Counter);
    // All of them from the start: a rate sees no step where a series begins.
    const Tally::Calls counted = serving_.tally.calls();
    for (const char* method : {"StreamDance", "GenerateTransition", Tally::kInfoMethod}) {
      for (int code = 0; code <= grpc::StatusCode::UNAUTHENTICATED; ++code) {
        const auto status = static_cast<grpc::StatusCode>(code);
        const auto found = counted.find({method, status});
        out.Add(found == counted.end() ? 0 : static_cast<double>(found->second),
                {{"method", method}, {"status", NameOf(status)}});
      }
    }
    const CallRegistry& calls = serving_.calls;
    out.Begin("streams", "Calls in progress.", MetricType::Gauge);
    out.Add(calls.count());
    out.Begin("streams_limit", "Calls that may be in progress.", MetricType::Gauge);
    out.Add(calls.limits().calls);
    double load = 0;
    for (const auto& [model, share] : serving_.frames.loads()) load += share;
    out.Begin("utilisation",
              "The larger of streams / limit and of all load / --max-load; at 1 calls are refused.",
              MetricType::Gauge);
    out.Add(std::max(load / serving_.frames.shares().of_all,
                     static_cast<double>(calls.count()) / calls.limits().calls));
    out.Begin("sent_frames_total", "Frames that calls got which are over.", MetricType::Counter);
    out.Add(static_cast<double>(serving_.tally.frames));
    out.Begin("first_frame_seconds", "From a call's begin to its first frame.",
              MetricType::Histogram);
    out.Add(serving_.tally.first_frame_s.snapshot());
    out.Begin("key_error_metres", "How far the model's own frames were off their keys.",
              MetricType::Histogram);
    out.Add(serving_.tally.key_error_m.snapshot());
    out.Begin("support_ratio", "Share of a dance's frames in which something bears the body.",
              MetricType::Histogram);
    out.Add(serving_.tally.support.snapshot());
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
    out.Begin("load", "Share of the engines' time that is promised to calls in progress.",
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
        {"workers", "Workers that make transitions.", MetricType::Gauge,
         [](const Stats& stats) { return double(stats.workers); }},
        {"transitions_active", "Transitions that a worker has begun.", MetricType::Gauge,
         [](const Stats& stats) { return double(stats.active); }},
        {"transitions_waiting", "Transitions that no worker has begun.", MetricType::Gauge,
         [](const Stats& stats) { return double(stats.waiting); }},
        {"engine_failures", "How often an engine has failed in a row.", MetricType::Gauge,
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

  static void AddHistograms(const std::map<std::string, Models::Figures>& models, Families& out) {
    using Histograms = SampleQueue::Histograms;
    struct Figure {
      const char* name;
      const char* help;
      Histogram::Snapshot Histograms::*of;
    };
    static constexpr Figure kFigures[] = {
        {"slice_seconds", "Time of a slice of a transition, for which all else waits.",
         &Histograms::slice_s},
        {"transition_seconds", "Time of a transition, all of its slices.",
         &Histograms::transition_s},
        {"lateness_seconds", "How late transitions of dances were made, 0 for those in time.",
         &Histograms::lateness_s},
    };
    for (const Figure& figure : kFigures) {
      out.Begin(figure.name, figure.help, MetricType::Histogram);
      for (const auto& [model, figures] : models) {
        out.Add(figures.histograms.*figure.of, {{"model", model}});
      }
    }
  }

  const Serving& serving_;
};

/// Of all that one connection sends, or takes: who drips holds up nobody, and no stop, for longer.
class Deadline {
 public:
  int left_ms() const {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        until_ - std::chrono::steady_clock::now());
    return std::max(0, static_cast<int>(left.count()));
  }

 private:
  const std::chrono::steady_clock::time_point until_ =
      std::chrono::steady_clock::now() + std::chrono::milliseconds(kPatienceMs);
};

/// What somebody asks over HTTP; empty where it does not come in time, or is too long.
std::string ReadRequest(int connection) {
  const Deadline deadline;
  std::string request;
  while (request.find("\r\n\r\n") == std::string::npos) {
    pollfd waited{.fd = connection, .events = POLLIN, .revents = 0};
    char bytes[1024];
    if (request.size() > kMostRequestBytes || poll(&waited, 1, deadline.left_ms()) != 1) return "";
    const ssize_t count = recv(connection, bytes, sizeof bytes, 0);
    if (count <= 0) return "";
    request.append(bytes, static_cast<size_t>(count));
  }
  return request;
}

struct RequestLine {
  std::string_view method, path;  ///< without what follows a '?'
};

RequestLine ParseRequestLine(std::string_view request) {
  const std::string_view line = request.substr(0, request.find("\r\n"));
  const size_t space = std::min(line.find(' '), line.size());
  const std::string_view rest = line.substr(std::min(space + 1, line.size()));
  return {line.substr(0, space), rest.substr(0, rest.find_first_of("? "))};
}

void SendAll(int connection, std::string_view bytes) {
  const Deadline deadline;
  while (!bytes.empty()) {
    pollfd waited{.fd = connection, .events = POLLOUT, .revents = 0};
    if (poll(&waited, 1, deadline.left_ms()) != 1) return;
    const ssize_t count = send(connection, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count <= 0) return;
    bytes.remove_prefix(static_cast<size_t>(count));
  }
}

}  // namespace

struct MetricsEndpoint::Impl {
  Impl(const std::string& address, const Serving& serving)
      : figures(serving), listener(address, "--metrics") {
    listener.Start([this](int /*listening*/, int connection) {
      Answer(connection);
      close(connection);
    });
  }

  void Answer(int connection) const {
    const std::string request = ReadRequest(connection);
    if (request.empty()) return;
    const RequestLine line = ParseRequestLine(request);
    const bool asks = line.method == "GET" || line.method == "HEAD";
    const bool known = line.path == "/metrics";
    const char* status = !asks   ? "405 Method Not Allowed\r\nAllow: GET, HEAD"
                         : known ? "200 OK"
                                 : "404 Not Found";
    const std::string body = asks && known
                                 ? prometheus::TextSerializer().Serialize(figures.Collect())
                                 : "GET /metrics\n";
    SendAll(connection, std::string("HTTP/1.1 ") + status +
                            "\r\nContent-Type: text/plain; version=0.0.4\r\nContent-Length: " +
                            std::to_string(body.size()) + "\r\nConnection: close\r\n\r\n" +
                            (line.method == "HEAD" ? "" : body));
  }

  const Figures figures;
  Listener listener;  // last: its thread uses the figures
};

MetricsEndpoint::MetricsEndpoint(const std::string& address, const Serving& serving)
    : impl_(std::make_unique<Impl>(address, serving)) {}

MetricsEndpoint::~MetricsEndpoint() = default;

int MetricsEndpoint::port() const { return impl_->listener.port(); }

}  // namespace choreo
