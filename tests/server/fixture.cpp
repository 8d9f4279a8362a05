#include "tests/server/fixture.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "google/rpc/status.pb.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/support/eventually.h"

namespace choreo {

using std::chrono::milliseconds;

namespace {

// Other tests and scripts set these. choreod would warn of them or take them as settings.
[[maybe_unused]] const bool kVariablesAreUnset = [] {
  std::vector<std::string> ours;
  for (char** at = environ; *at != nullptr; ++at) {
    const std::string entry = *at;
    if (entry.starts_with("CHOREO_")) ours.push_back(entry.substr(0, entry.find('=')));
  }
  for (const std::string& variable : ours) unsetenv(variable.c_str());
  return true;
}();

}  // namespace

ProbedSampler::ProbedSampler(std::string name, std::shared_ptr<EngineProbe> probe)
    : probe_(std::move(probe)) {
  model_.name = std::move(name);
}

void ProbedSampler::OnFrame(const TransitionSpec& /*spec*/, Plan* /*plan*/) {
  probe_->Pass();
  ++probe_->frames;
}

Answer::Joined Answer::Join(uint32_t candidate) const {
  Joined joined;
  for (const v1::Frames& message : frames) {
    if (message.candidate() != candidate) continue;
    if (joined.count == 0) joined.first_frame = message.first_frame();
    EXPECT_EQ(message.first_frame(), joined.first_frame + joined.count);
    EXPECT_EQ(message.root_positions_size(), 3 * message.count());
    EXPECT_EQ(message.contacts_size(), 4 * message.count());
    joined.count += message.count();
    auto append = [](const auto& from, std::vector<float>& to) {
      to.insert(to.end(), from.begin(), from.end());
    };
    append(message.root_positions(), joined.root_positions);
    append(message.rotations(), joined.rotations);
    append(message.contacts(), joined.contacts);
  }
  return joined;
}

std::vector<std::string> Answer::ReachedKeys() const {
  std::vector<std::string> ids;
  for (const v1::Event& event : events) {
    if (event.has_keyframe_reached()) ids.push_back(event.keyframe_reached().id());
  }
  return ids;
}

void Answer::Add(const v1::StreamDanceResponse& response) {
  EXPECT_FALSE(summary) << "something comes after the summary";
  if (response.has_header()) {
    EXPECT_FALSE(header) << "a second header";
    EXPECT_TRUE(frames.empty() && events.empty()) << "the header is not first";
    header = response.header();
  }
  if (response.has_frames()) frames.push_back(response.frames());
  if (response.has_event()) events.push_back(response.event());
  if (response.has_continuation()) continuations.push_back(response.continuation());
  if (response.has_summary()) summary = response.summary();
}

void Answer::Add(const v1::GenerateTransitionResponse& response) {
  EXPECT_FALSE(transition_summary) << "something comes after the summary";
  if (response.has_header()) header = response.header();
  if (response.has_frames()) frames.push_back(response.frames());
  if (response.has_event()) events.push_back(response.event());
  if (response.has_summary()) transition_summary = response.summary();
}

DanceClient::DanceClient(v1::Choreography::Stub& stub, std::optional<milliseconds> deadline,
                         const std::map<std::string, std::string>& headers) {
  for (const auto& [name, value] : headers) context.AddMetadata(name, value);
  if (deadline) context.set_deadline(std::chrono::system_clock::now() + *deadline);
  stream_ = stub.StreamDance(&context);
}

DanceClient::~DanceClient() {
  if (finished_) return;
  Cancel();
}

void DanceClient::HalfClose() {
  half_closed_ = true;
  stream_->WritesDone();
}

const Answer& DanceClient::Cancel() {
  half_closed_ = true;
  context.TryCancel();
  return Finish();
}

bool DanceClient::Send(const v1::DanceConfig& config) {
  v1::StreamDanceRequest request;
  *request.mutable_config() = config;
  return Send(request);
}

bool DanceClient::SendKeyframe(const v1::Keyframe& keyframe) {
  v1::StreamDanceRequest request;
  *request.mutable_keyframe() = keyframe;
  return Send(request);
}

bool DanceClient::SendAudio(const std::string& bytes, int64_t first_sample) {
  v1::StreamDanceRequest request;
  request.mutable_audio()->set_data(bytes);
  request.mutable_audio()->set_first_sample(first_sample);
  return Send(request);
}

bool DanceClient::SendKeyframesComplete() {
  v1::StreamDanceRequest request;
  request.mutable_keyframes_complete();
  return Send(request);
}

bool DanceClient::SendEndOfAudio() {
  v1::StreamDanceRequest request;
  request.mutable_end_of_audio();
  return Send(request);
}

bool DanceClient::SendGenerateUntil(int64_t frame) {
  v1::StreamDanceRequest request;
  request.mutable_generate_until()->set_frame(frame);
  return Send(request);
}

bool DanceClient::ReadOne() {
  v1::StreamDanceResponse response;
  if (!stream_->Read(&response)) return false;
  answer_.Add(response);
  frames_ += response.frames().count();
  return true;
}

bool DanceClient::ReadHeader() {
  while (!answer_.header) {
    if (!ReadOne()) return false;
  }
  return true;
}

bool DanceClient::ReadFrames(int64_t count) {
  while (frames_ < count) {
    if (!ReadOne()) return false;
  }
  return true;
}

const Answer& DanceClient::Finish() {
  if (finished_) return answer_;
  if (!half_closed_) HalfClose();
  while (ReadOne()) {
  }
  answer_.status = stream_->Finish();
  finished_ = true;
  return answer_;
}

ServerTest::~ServerTest() { probe->Open(); }

void ServerTest::Start(int workers, std::function<void(ServerConfig&)> change,
                       const std::vector<std::string>& names) {
  ServerConfig config;
  config.listen = "127.0.0.1:0";
  config.max_load = 2;  // however slow the machine is
  if (change) change(config);
  std::vector<Server::Samplers> models;
  for (const std::string& name : names) {
    Server::Samplers& samplers = models.emplace_back();
    for (int i = 0; i < workers; ++i)
      samplers.push_back(std::make_unique<ProbedSampler>(name, probe));
  }
  Connect(std::make_unique<Server>(config, std::move(models), clock));
}

void ServerTest::StartWith(std::unique_ptr<Sampler> sampler) {
  ServerConfig config;
  config.listen = "127.0.0.1:0";
  std::vector<Server::Samplers> models(1);
  models[0].push_back(std::move(sampler));
  Connect(std::make_unique<Server>(config, std::move(models), clock));
}

void ServerTest::Connect(std::unique_ptr<Server> started) {
  server = std::move(started);
  channel = grpc::CreateChannel("127.0.0.1:" + std::to_string(server->port()),
                                grpc::InsecureChannelCredentials());
  stub_ = v1::Choreography::NewStub(channel);
}

v1::Choreography::Stub& ServerTest::stub() { return *stub_; }

v1::DanceConfig ServerTest::Config(uint64_t seed) {
  v1::DanceConfig config;
  config.set_seed(seed);
  return config;
}

v1::Pose ServerTest::KeyPose(double x, double z, float elbow) {
  const Skeleton& skeleton = Skeleton::Smpl24();
  Pose rest = RestPose(skeleton);
  rest.rotations(1, skeleton.left_elbow) = elbow;
  v1::Pose pose;
  pose.mutable_root_position()->set_x(x);
  pose.mutable_root_position()->set_y(rest.root_position.y());
  pose.mutable_root_position()->set_z(z);
  for (const double value : rest.rotations.reshaped()) {
    pose.add_rotations(static_cast<float>(value));
  }
  return pose;
}

v1::Keyframe ServerTest::Key(const std::string& id, int64_t frame, double x, double z,
                             float elbow) {
  v1::Keyframe key;
  key.set_id(id);
  key.set_frame(frame);
  *key.mutable_pose() = KeyPose(x, z, elbow);
  return key;
}

Answer ServerTest::Dance(const std::vector<v1::StreamDanceRequest>& requests) {
  DanceClient client(stub());
  for (const auto& request : requests) {
    if (!client.Send(request)) break;
  }
  return client.Finish();
}

Answer ServerTest::Generate(const v1::GenerateTransitionRequest& request) {
  grpc::ClientContext context;
  const auto reader = stub().GenerateTransition(&context, request);
  Answer answer;
  v1::GenerateTransitionResponse response;
  while (reader->Read(&response)) answer.Add(response);
  answer.status = reader->Finish();
  return answer;
}

Answer ServerTest::DanceToAKey() {
  DanceClient client(stub());
  client.Send(Config());
  client.SendKeyframe(Key("a", 20));
  return client.Finish();
}

std::unique_ptr<DanceClient> ServerTest::OpenEndedDance(
    std::optional<std::chrono::milliseconds> deadline) {
  auto client = std::make_unique<DanceClient>(stub(), deadline);
  v1::DanceConfig config = Config();
  *config.mutable_audio_format() = MusicFormat();
  client->Send(config);
  client->SendKeyframesComplete();
  client->SendAudio(Music(1), 0);
  return client;
}

std::string ServerTest::Music(double seconds) {
  constexpr double kRate = 22'050;
  const auto count = static_cast<size_t>(seconds * kRate);
  std::string bytes(2 * count, '\0');
  for (size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / kRate;
    const double since_beat = std::fmod(t, 0.5);
    const double tone = 220 * std::exp2(std::floor(std::fmod(t, 4) * 2) / 12);
    const double value =
        0.5 * std::exp(-8 * since_beat) * std::sin(2 * std::numbers::pi * tone * t);
    const auto sample = static_cast<int16_t>(std::lround(32'000 * value));
    bytes[2 * i] = static_cast<char>(sample & 0xFF);
    bytes[2 * i + 1] = static_cast<char>((sample >> 8) & 0xFF);
  }
  return bytes;
}

std::string ServerTest::Wav(const std::string& samples, int bytes_per_sample) {
  const auto number = [](size_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xFF);
    return text;
  };
  const auto width = static_cast<size_t>(bytes_per_sample);
  return "RIFF" + number(36 + samples.size(), 4) + "WAVEfmt " + number(16, 4) +
         number(width == 4 ? 3 : 1, 2) + number(1, 2) + number(22'050, 4) +
         number(22'050 * width, 4) + number(width, 2) + number(8 * width, 2) + "data" +
         number(samples.size(), 4) + samples;
}

v1::AudioFormat ServerTest::MusicFormat() {
  v1::AudioFormat format;
  format.set_encoding(v1::AUDIO_ENCODING_PCM_S16LE);
  format.set_sample_rate(22'050);
  format.set_channels(1);
  return format;
}

void ServerTest::ExpectIdle() {
  ExpectEventually([this] { return server->calls() == 0 && server->transitions() == 0; },
                   "calls and transitions return");
}

void ExpectEventually(const std::function<bool()>& condition, const std::string& what,
                      std::chrono::seconds limit) {
  EXPECT_TRUE(Eventually(condition, limit)) << "never came about: " << what;
}

Details DetailsOf(const grpc::Status& status) {
  google::rpc::Status message;
  EXPECT_TRUE(message.ParseFromString(status.error_details()));
  EXPECT_EQ(message.code(), status.error_code());
  EXPECT_EQ(message.message(), status.error_message());
  Details details;
  for (const auto& any : message.details()) {
    if (any.Is<google::rpc::BadRequest>()) any.UnpackTo(&details.bad_request.emplace());
    if (any.Is<google::rpc::ErrorInfo>()) any.UnpackTo(&details.error_info.emplace());
    if (any.Is<google::rpc::RetryInfo>()) any.UnpackTo(&details.retry_info.emplace());
  }
  return details;
}

}  // namespace choreo
