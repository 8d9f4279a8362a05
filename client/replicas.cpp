#include "client/replicas.h"

#include <arpa/inet.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/security/tls_certificate_provider.h>
#include <grpcpp/security/tls_certificate_verifier.h>
#include <grpcpp/security/tls_credentials_options.h>
#include <grpcpp/support/channel_arguments.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "model/core/rounded.h"
#include "network/address.h"
#include "network/pem.h"
#include "network/protocol.h"

namespace choreo::client {
namespace {

constexpr double kMaxBackoffSeconds = 2;    // seconds
constexpr size_t kMaxTokenBytes = 4 << 10;  // gRPC's headers have 8 KiB in all

/// Calls take turns at all addresses of a name. kTurnsAtServing skips those that report that they
/// do not serve.
constexpr const char* kTurnsAtServing = R"({
  "loadBalancingConfig": [{"round_robin": {}}],
  "healthCheckConfig": {"serviceName": "choreo.v1.Choreography"}
})";
constexpr const char* kTurns = R"({"loadBalancingConfig": [{"round_robin": {}}]})";

/// Credentials for servers with any certificate.
std::shared_ptr<grpc::ChannelCredentials> Unverified(const grpc::SslCredentialsOptions& own) {
  namespace tls = grpc::experimental;
  tls::TlsChannelCredentialsOptions options;
  options.set_verify_server_certs(false);
  options.set_check_call_host(false);
  options.set_certificate_verifier(std::make_shared<tls::NoOpCertificateVerifier>());
  if (!own.pem_private_key.empty()) {
    options.set_certificate_provider(std::make_shared<tls::StaticDataCertificateProvider>(
        std::vector{tls::IdentityKeyCertPair{own.pem_private_key, own.pem_cert_chain}}));
    options.watch_identity_key_cert_pairs();
  }
  return tls::TlsCredentials(options);
}

std::shared_ptr<grpc::ChannelCredentials> Credentials(const Options& options) {
  if (options.client_certificate.empty() != options.client_key.empty()) {
    throw InvalidArgument(options.client_key.empty() ? "client_key" : "client_certificate",
                          "missing; a certificate and its key go together");
  }
  if (!options.tls) {
    for (const auto& [field, value] : {std::pair{"ca_certificate", options.ca_certificate.string()},
                                       {"client_certificate", options.client_certificate.string()},
                                       {"server_name", options.server_name}}) {
      if (!value.empty()) throw InvalidArgument(field, "\"" + value + "\" needs TLS, which is off");
    }
    return grpc::InsecureChannelCredentials();
  }
  grpc::SslCredentialsOptions files;
  if (!options.ca_certificate.empty() && !options.any_certificate) {
    files.pem_root_certs = ReadCertificates("ca_certificate", options.ca_certificate);
  }
  if (!options.client_key.empty()) {
    KeyPair own = ReadKeyPair("client_certificate", options.client_certificate, "client_key",
                              options.client_key);
    files.pem_private_key = std::move(own.key);
    files.pem_cert_chain = std::move(own.certificates);
  }
  return options.any_certificate ? Unverified(files) : grpc::SslCredentials(files);
}

/// Whether traffic to this address stays on this machine. A host name that merely begins like an
/// IP address is a name.
bool IsOfThisMachine(const std::string& address) {
  if (address.starts_with("unix:")) return true;
  const std::string host = SplitAddress(address).host;
  in_addr four;
  if (inet_pton(AF_INET, host.c_str(), &four) == 1) return ntohl(four.s_addr) >> 24 == 127;
  return host == "localhost" || host == "[::1]";
}

// Refuses addresses that gRPC would misread as a host name, or with another port.
void CheckAddress(const std::string& address) {
  if (address.empty()) throw InvalidArgument("addresses", "one of them is empty");
  if (address.starts_with("http:") || address.starts_with("https:")) {
    throw InvalidArgument("addresses", address + " is a URL; use HOST:PORT");
  }
  for (const char* scheme : {"unix:", "unix-abstract:", "xds:"}) {
    if (address.starts_with(scheme)) return;
  }
  const std::string port = SplitAddress(address).port;
  if (!IsNumber(port)) throw InvalidArgument("addresses", address + " has no port; use HOST:PORT");
  if (ParsePort(port).value_or(0) < 1) {
    throw InvalidArgument("addresses", address + ": port " + port + " is not in [1, " +
                                           std::to_string(kMaxPort) + "]");
  }
}

void CheckToken(const Options& options) {
  if (options.token_file.empty()) return;
  if (options.any_certificate)
    throw InvalidArgument("token_file",
                          "a token is not sent to a server whose certificate is not checked");
  if (options.tls) return;
  for (const std::string& address : options.addresses) {
    if (IsOfThisMachine(address)) continue;
    throw InvalidArgument("token_file", "a token is sent to " + address + " only over TLS");
  }
}

void CheckNotNegative(const char* field, double value) {
  if (!(value >= 0) || !std::isfinite(value)) {
    std::ostringstream message;
    message << value << " is not a finite number >= 0";
    throw InvalidArgument(field, message.str());
  }
}

}  // namespace

Replicas::Replicas(Options options) : options_(std::move(options)) {
  if (options_.addresses.empty()) throw InvalidArgument("addresses", "none is given");
  CheckNotNegative("connect_timeout_s", options_.connect_timeout_s);
  CheckNotNegative("deadline_s", options_.deadline_s);
  CheckNotNegative("first_backoff_s", options_.first_backoff_s);
  CheckNotNegative("retry_s", options_.retry_s);
  CheckNotNegative("silence_s", options_.silence_s);

  if (options_.silence_s > 0 && options_.silence_s < kMinSilence) {
    throw InvalidArgument("silence_s", "neither 0 nor at least " + Rounded(kMinSilence) + " s");
  }

  const auto credentials = Credentials(options_);
  CheckToken(options_);
  grpc::ChannelArguments arguments;
  if (!options_.server_name.empty()) arguments.SetSslTargetNameOverride(options_.server_name);
  arguments.SetMaxReceiveMessageSize(-1);
  // Despite its name, gRPC also uses this as the time limit for one attempt to connect.
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS,
                   static_cast<int>(options_.connect_timeout_s * 1000));
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 1000);
  if (options_.silence_s > 0) {
    // Half of the time passes before a ping, the other half is for its answer.
    const auto half = static_cast<int>(std::min(options_.silence_s, 1e6) * 500);
    arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, half);
    arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, half);
    arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);  // any number
  }
  // Health checks must reach servers that do not serve, too.
  grpc::ChannelArguments balanced = arguments;
  balanced.SetServiceConfigJSON(options_.even_draining ? kTurns : kTurnsAtServing);
  for (const std::string& address : options_.addresses) {
    CheckAddress(address);
    const auto channel = grpc::CreateCustomChannel(address, credentials, balanced);
    servers_.push_back({address, channel, v1::Choreography::NewStub(channel),
                        grpc::health::v1::Health::NewStub(
                            grpc::CreateCustomChannel(address, credentials, arguments))});
  }
}

void Replicas::Prepare(grpc::ClientContext* context) const {
  if (options_.token_file.empty()) return;
  std::string token = ReadSmallFile("token_file", options_.token_file, kMaxTokenBytes);
  while (!token.empty() && std::isspace(static_cast<unsigned char>(token.back()))) {
    token.pop_back();
  }
  // gRPC aborts the process for a header with other characters.
  const bool visible =
      std::all_of(token.begin(), token.end(), [](char c) { return c > ' ' && c < '\x7f'; });
  if (token.empty() || !visible) {
    throw InvalidArgument("token_file", options_.token_file.string() +
                                            " is not one line of visible ASCII characters");
  }
  context->AddMetadata("authorization", "Bearer " + token);
}

Replicas::Server Replicas::current() const {
  const std::lock_guard lock(mutex_);
  return servers_[current_];
}

bool Replicas::Leave(const Server& failed) {
  const std::lock_guard lock(mutex_);
  if (servers_[current_].stub == failed.stub) current_ = (current_ + 1) % servers_.size();
  return servers_.size() > 1;
}

void Replicas::TellOfRetry(const Server& failed, const grpc::Status& status) const {
  if (options_.retried) options_.retried(failed.address, ToError(status, failed.address, options_));
}

void Replicas::Wait(std::chrono::duration<double> time, const std::function<bool()>& stop) const {
  constexpr std::chrono::milliseconds kPiece{20};
  using Clock = std::chrono::system_clock;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(time);
  const std::shared_ptr<grpc::Channel> channel = current().channel;
  // Waits inside gRPC instead of sleeping. While a thread waits in it, gRPC makes connections and
  // reads answers to pings. Otherwise gRPC polls only every 5 s and considers a restored link
  // silent.
  for (auto now = Clock::now(); now < end && !stop(); now = Clock::now())
    channel->WaitForStateChange(channel->GetState(true), std::min(end, now + kPiece));
}

Patience::Patience(const Options& options)
    : retry_s_(options.retry_s),
      first_backoff_s_(options.first_backoff_s),
      before_retry_(options.before_retry),
      servers_(options.addresses.size()),
      jitter_(std::random_device{}()) {
  if (options.deadline_s > 0) {
    deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                   std::chrono::duration<double>(options.deadline_s));
  }
}

void Patience::Reset() {
  failures_ = 0;
  refusals_ = 0;
  verdict_ = grpc::Status();
  away_.clear();
}

std::string Patience::VerdictOf() const {
  if (!IsAway(verdict_)) return verdict_of_;
  std::string all;
  for (const std::string& address : away_) all += (all.empty() ? "" : ", ") + address;
  return all;
}

std::optional<std::chrono::duration<double>> Patience::Next(
    const grpc::Status& failed, const std::string& address, bool elsewhere,
    std::chrono::steady_clock::time_point now) {
  const RetryAdvice advice = AdviceFor(failed);
  if (failures_ == 0) failing_since_ = now;
  // A lone server that was stopping has stopped.
  const bool stopped = servers_ == 1 && IsAway(failed) && AdviceFor(verdict_).leaving;
  if (!stopped && (!advice.here || verdict_.ok() || AdviceFor(verdict_).here)) {
    verdict_ = failed;
    verdict_of_ = address;
  }
  if (IsAway(failed) && std::ranges::find(away_, address) == away_.end()) away_.push_back(address);
  // Counts refusals until all replicas have refused.
  refusals_ = advice.here ? 0 : refusals_ + 1;
  const bool useful = advice.here || (advice.elsewhere && refusals_ < servers_);
  const double left = retry_s_ - std::chrono::duration<double>(now - failing_since_).count();
  // A server's retry delay applies only to that server.
  const double asked = elsewhere ? 0 : advice.wait_s;
  if (!useful || left <= 0 || asked > left) return std::nullopt;
  const double doubled = std::min(kMaxBackoffSeconds, first_backoff_s_ * std::exp2(failures_));
  // A server that stops leaves its dances to the others: each of them is asked once without a wait.
  const bool at_once = elsewhere && advice.leaving && failures_ + 1 < static_cast<int>(servers_);
  ++failures_;
  // Clients that lost the same server should not all come back at once.
  const double spread = std::uniform_real_distribution<double>(0.5, 1.0)(jitter_);
  const std::chrono::duration<double> wait(
      at_once ? 0 : std::max(asked, std::min(left, doubled * spread)));
  if (deadline_ && Clock::now() + std::chrono::duration_cast<Clock::duration>(wait) >= *deadline_) {
    return std::nullopt;
  }
  if (before_retry_) before_retry_();
  return wait;
}

}  // namespace choreo::client
