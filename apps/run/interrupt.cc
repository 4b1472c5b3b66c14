// SPDX-License-Identifier: BSD-3-Clause
#include "apps/run/interrupt.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <mutex>
#include <thread>
#include <utility>

#include "apps/run/app.h"
#include "icpscape/io/output.h"

namespace icpscape {
namespace {

struct State {
  std::mutex mutex;
  pid_t child = 0;
  std::filesystem::path scratch;
  std::string advice = "it leaves nothing half-written";
};

// Never destroyed: a signal may come while the program ends.
State& TheState() {
  static auto* const state = new State;
  return *state;
}

// What ends an interrupted program. A thread waits for the signal, so that all of C++ may be used,
// which a signal handler may not.
[[noreturn]] void End(int signal) {
  State& state = TheState();
  // Both locks are kept: no other thread begins a file, a folder or a child from here on.
  state.mutex.lock();
  std::unique_lock<std::mutex> files = HoldOutputFiles();
  if (state.child > 0) {
    kill(state.child, SIGKILL);
    waitpid(state.child, nullptr, 0);
  }
  std::error_code error;
  if (!state.scratch.empty()) {
    std::filesystem::remove_all(state.scratch, error);
  }
  const std::string sentence = (isatty(STDERR_FILENO) != 0 ? "\r\033[K" : "") + AppName() +
                               ": interrupted by " + (signal == SIGINT ? "SIGINT" : "SIGTERM") +
                               " before it was done; " + state.advice + ".\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, sentence.data(), sentence.size());
  _exit(128 + signal);
}

}  // namespace

void EndOnSignals() {
  sigset_t awaited;
  sigemptyset(&awaited);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction action = {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_IGN) {
      sigaddset(&awaited, signal);
    }
  }
  TheState();
  // All later threads inherit this: the signals come to the one that waits for them.
  pthread_sigmask(SIG_BLOCK, &awaited, nullptr);
  std::thread([awaited] {
    int signal = 0;
    if (sigwait(&awaited, &signal) == 0) {
      End(signal);
    }
  }).detach();
}

void SetAdviceAfterInterrupt(const std::string& advice) {
  const std::lock_guard<std::mutex> lock(TheState().mutex);
  TheState().advice = advice;
}

ScratchFolder::ScratchFolder(std::filesystem::path path) : path_(std::move(path)) {
  const std::lock_guard<std::mutex> lock(TheState().mutex);
  std::filesystem::create_directories(path_);
  TheState().scratch = path_;
}

ScratchFolder::~ScratchFolder() {
  const std::lock_guard<std::mutex> lock(TheState().mutex);
  std::error_code error;
  std::filesystem::remove_all(path_, error);
  TheState().scratch.clear();
}

int WaitForChild(pid_t child) {
  State& state = TheState();
  {
    const std::lock_guard<std::mutex> lock(state.mutex);
    state.child = child;
  }
  siginfo_t info;
  waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT);
  // Under the lock: End must not kill another process that gets the number of a child that ended.
  const std::lock_guard<std::mutex> lock(state.mutex);
  int status = -1;
  waitpid(child, &status, 0);
  state.child = 0;
  return status;
}

}  // namespace icpscape
