#include "studio/server_supervisor.h"

#include <chrono>
#include <iostream>
#include <memory>

#include "client/authoring/local_server.h"
#include "model/core/error.h"

namespace choreo::studio {
namespace {

constexpr std::chrono::milliseconds kLook{200};
constexpr std::chrono::seconds kPause{1};  // between attempts to start a server that fails

}  // namespace

ServerSupervisor::ServerSupervisor(const std::filesystem::path& program) {
  std::exception_ptr failure;
  thread_ = std::thread([this, &program, &failure] { Supervise(program, &failure); });
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return started_; });
  }
  if (!failure) return;
  thread_.join();
  std::rethrow_exception(failure);
}

ServerSupervisor::~ServerSupervisor() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void ServerSupervisor::Supervise(const std::filesystem::path& program,
                                 std::exception_ptr* failure) {
  const std::filesystem::path path = program;
  std::unique_ptr<authoring::LocalServer> server;
  try {
    server = std::make_unique<authoring::LocalServer>(path);
    address_ = server->address();
    process_ = server->process();
  } catch (...) {
    *failure = std::current_exception();
  }
  std::unique_lock lock(mutex_);
  started_ = true;
  changed_.notify_all();
  if (!server) return;
  std::chrono::milliseconds wait = kLook;
  while (!changed_.wait_for(lock, wait, [this] { return stop_; })) {
    lock.unlock();
    wait = kLook;
    try {
      if (server) server->RequireRunning();
      if (!server) {
        server = std::make_unique<authoring::LocalServer>(path, address_);
        process_ = server->process();
      }
    } catch (const Error& error) {
      std::cerr << "choreo: " << error.what() << "; restarting it" << std::endl;
      if (!server) wait = kPause;
      server.reset();
    }
    lock.lock();
  }
}

}  // namespace choreo::studio
