// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/process.hpp"

#include "commands/temporary_folder.hpp"
#include "diagnostic.hpp"

#include <fmt/core.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace lagen {

namespace {

volatile std::sig_atomic_t interrupts = 0;
volatile pid_t running_child = 0;

extern "C" void on_interrupt_of_child(int)
{
    interrupts = interrupts + 1;
    // The whole group: a compiler driver's own children too.
    if (running_child > 0) ::kill(-running_child, interrupts > 1 ? SIGKILL : SIGINT);
}

/// Interrupts, also those that were held back before, go to the child while this lives; a second one kills it.
class InterruptsForwarded {
  public:
    InterruptsForwarded()
    {
        interrupts = 0;
        struct sigaction action {};
        action.sa_handler = on_interrupt_of_child;
        sigaction(SIGINT, &action, &before_int_);
        sigaction(SIGTERM, &action, &before_term_);
        sigaction(SIGHUP, &action, &before_hup_);
        const sigset_t signals = interrupt_signals();
        sigprocmask(SIG_UNBLOCK, &signals, &before_mask_);
    }
    ~InterruptsForwarded()
    {
        running_child = 0;
        sigprocmask(SIG_SETMASK, &before_mask_, nullptr);
        sigaction(SIGINT, &before_int_, nullptr);
        sigaction(SIGTERM, &before_term_, nullptr);
        sigaction(SIGHUP, &before_hup_, nullptr);
    }
    InterruptsForwarded(const InterruptsForwarded&) = delete;
    InterruptsForwarded& operator=(const InterruptsForwarded&) = delete;

  private:
    struct sigaction before_int_ {};
    struct sigaction before_term_ {};
    struct sigaction before_hup_ {};
    sigset_t before_mask_{};
};

struct Pipe {
    std::array<int, 2> ends{-1, -1};
    Pipe()
    {
        if (::pipe2(ends.data(), O_CLOEXEC) != 0)
            throw MachineError(fmt::format("error: cannot make a pipe: {}", std::strerror(errno)));
    }
    ~Pipe()
    {
        close_end(0);
        close_end(1);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    void close_end(std::size_t end)
    {
        if (ends[end] >= 0) ::close(ends[end]);
        ends[end] = -1;
    }
};

/// The streams of a child; `input` where it is given any.
struct Streams {
    std::optional<Pipe> input;
    Pipe output, error;
};

pid_t spawn(const std::string& program, const std::vector<std::string>& arguments, const Streams& streams, int& failure)
{
    std::vector<char*> pointers;
    for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    if (streams.input)
        posix_spawn_file_actions_adddup2(&actions, streams.input->ends[0], STDIN_FILENO);
    else
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, streams.output.ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, streams.error.ends[1], STDERR_FILENO);
    // Its own process group: ctrl-C on the terminal reaches lagen alone, which passes it on once.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    sigset_t nothing;
    sigemptyset(&nothing);
    posix_spawnattr_setsigmask(&attributes, &nothing);
    sigset_t defaults = interrupt_signals();
    sigaddset(&defaults, SIGPIPE);
    sigaddset(&defaults, SIGXFSZ);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    pid_t child = 0;
    failure = ::posix_spawn(&child, program.c_str(), &actions, &attributes, pointers.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return child;
}

/// What is written to a child: asked for where it can be written.
class Feed {
  public:
    Feed(std::optional<Pipe>& pipe, const std::function<std::string()>& source) : pipe_(pipe), source_(source) {}

    /// -1 where there is nothing more to write: poll looks away.
    [[nodiscard]] int file() const { return pipe_ ? pipe_->ends[1] : -1; }

    void write()
    {
        if (text_.empty()) text_ = source_();
        if (text_.empty()) return pipe_->close_end(1);
        const ssize_t count = ::write(file(), text_.data(), text_.size());
        if (count > 0) text_.erase(0, static_cast<std::size_t>(count));
        // A child that reads no more says why on its own streams.
        if (count < 0 && errno != EAGAIN && errno != EINTR) pipe_->close_end(1);
    }

  private:
    std::optional<Pipe>& pipe_;
    const std::function<std::string()>& source_;
    std::string text_;
};

/// Serves the pipes until both of the child's outputs are closed.
void serve(Streams& streams, ProcessResult& result, const std::function<void(const char*, std::size_t)>& sink,
           const std::function<std::string()>& source)
{
    std::array<char, 65536> buffer;
    Feed feed(streams.input, source);
    while (streams.output.ends[0] >= 0 || streams.error.ends[0] >= 0) {
        std::array<pollfd, 3> waiting{pollfd{streams.output.ends[0], POLLIN, 0},
                                      pollfd{streams.error.ends[0], POLLIN, 0}, pollfd{feed.file(), POLLOUT, 0}};
        if (::poll(waiting.data(), waiting.size(), -1) < 0) {
            if (errno == EINTR) continue;
            throw MachineError(fmt::format("error: cannot wait for a child process: {}", std::strerror(errno)));
        }
        if (waiting[2].revents != 0) feed.write();
        for (std::size_t k = 0; k < 2; ++k) {
            if (waiting[k].revents == 0) continue;
            const ssize_t count = ::read(waiting[k].fd, buffer.data(), buffer.size());
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) {
                (k == 0 ? streams.output : streams.error).close_end(0);
            } else if (k == 0 && sink) {
                sink(buffer.data(), static_cast<std::size_t>(count));
            } else {
                (k == 0 ? result.output : result.error).append(buffer.data(), static_cast<std::size_t>(count));
            }
        }
    }
}

/// A child that is waited for, and killed first where its end is not seen.
class Child {
  public:
    explicit Child(pid_t process) : process_(process) { running_child = process; }
    ~Child()
    {
        if (process_ == 0) return;
        ::kill(-process_, SIGKILL);
        (void)wait();
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    int wait()
    {
        int status = 0;
        while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
        process_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

  private:
    pid_t process_;
};

} // namespace

ProcessResult run_process(const std::vector<std::string>& arguments,
                          const std::function<void(const char*, std::size_t)>& sink,
                          const std::function<std::string()>& source)
{
    ProcessResult result;
    const std::string program = find_program(arguments.at(0));
    if (program.empty()) {
        result.started = false;
        result.error = "not found";
        return result;
    }
    Streams streams;
    if (source) streams.input.emplace();
    const InterruptsForwarded forwarded;
    int failure = 0;
    const pid_t process = spawn(program, arguments, streams, failure);
    if (failure != 0) {
        result.started = false;
        result.error = std::strerror(failure);
        return result;
    }
    Child child(process);
    if (interrupts > 0) ::kill(-process, SIGINT);
    streams.output.close_end(1);
    streams.error.close_end(1);
    if (source) {
        streams.input->close_end(0);
        ::fcntl(streams.input->ends[1], F_SETFL, O_NONBLOCK);
    }
    serve(streams, result, sink, source);
    result.exit_code = child.wait();
    result.interrupted = interrupts > 0;
    return result;
}

std::string find_program(const std::string& name)
{
    if (name.empty()) return "";
    if (name.find('/') != std::string::npos) return ::access(name.c_str(), X_OK) == 0 ? name : "";
    const char* path = std::getenv("PATH");
    const std::string folders = path == nullptr ? "/usr/local/bin:/usr/bin:/bin" : path;
    for (std::size_t begin = 0; begin <= folders.size();) {
        const std::size_t end = std::min(folders.find(':', begin), folders.size());
        const std::string folder = end > begin ? folders.substr(begin, end - begin) : ".";
        const std::string candidate = folder + "/" + name;
        if (::access(candidate.c_str(), X_OK) == 0) return candidate;
        begin = end + 1;
    }
    return "";
}

} // namespace lagen
