// SPDX-License-Identifier: GPL-2.0-or-later
#include "machine/process.hpp"

#include "machine/temporary_folder.hpp"
#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <optional>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace lagen {

namespace {

constexpr std::size_t most_children = 16;
volatile std::sig_atomic_t interrupts = 0;
volatile pid_t running_children[most_children];

extern "C" void on_interrupt_of_child(int)
{
    interrupts = interrupts + 1;
    // The whole group: a compiler driver's own children too.
    for (const volatile pid_t& child : running_children)
        if (child > 0) ::kill(-child, interrupts > 1 ? SIGKILL : SIGINT);
}

/// Interrupts, also those that were held back before, go to the children while this lives; a second one kills them.
class InterruptsForwarded {
  public:
    InterruptsForwarded() : answered_((interrupts = 0, on_interrupt_of_child)) {}
    ~InterruptsForwarded()
    {
        for (volatile pid_t& child : running_children) child = 0;
    }
    InterruptsForwarded(const InterruptsForwarded&) = delete;
    InterruptsForwarded& operator=(const InterruptsForwarded&) = delete;

  private:
    InterruptsAnswered answered_;
};

struct Pipe {
    std::array<int, 2> ends{-1, -1};
    Pipe()
    {
        if (::pipe2(ends.data(), O_CLOEXEC) != 0)
            throw MachineError(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
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

using Sink = std::function<void(const char*, std::size_t)>;

using Source = std::function<std::string()>;

/// A program with its place among the running ones: waited for, and killed first where its end is not seen.
struct Child {
    Streams streams;
    pid_t process = 0;
    std::size_t place = 0;
    std::size_t command = 0; ///< its place among the commands
    std::string unwritten;   ///< of its input

    Child() = default;
    ~Child()
    {
        if (process == 0) return;
        ::kill(-process, SIGKILL);
        (void)wait();
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    [[nodiscard]] bool is_silent() const { return streams.output.ends[0] < 0 && streams.error.ends[0] < 0; }

    int wait()
    {
        int status = 0;
        while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
        }
        running_children[place] = 0;
        process = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
};

/// Nothing where it could not be started; `result` says why.
std::unique_ptr<Child> start_child(const std::vector<std::string>& arguments, bool is_fed, ProcessResult& result)
{
    const std::string program = find_program(arguments.at(0));
    auto child = std::make_unique<Child>();
    Streams& streams = child->streams;
    if (is_fed) streams.input.emplace();
    int failure = 0;
    pid_t process = 0;
    if (!program.empty()) process = spawn(program, arguments, streams, failure);
    streams.output.close_end(1);
    streams.error.close_end(1);
    if (is_fed) {
        streams.input->close_end(0);
        ::fcntl(streams.input->ends[1], F_SETFL, O_NONBLOCK);
    }
    if (!program.empty() && failure == 0) {
        child->process = process;
        return child;
    }
    result.started = false;
    result.error = program.empty() ? "not found" : std::strerror(failure);
    return nullptr;
}

/// One piece of what came through a pipe; closes it at its end.
void read_piece(Pipe& pipe, const Sink& take)
{
    static std::array<char, 65536> buffer;
    const ssize_t count = ::read(pipe.ends[0], buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) return;
    if (count <= 0)
        pipe.close_end(0);
    else
        take(buffer.data(), static_cast<std::size_t>(count));
}

/// Writes what a child can take; its input ends where `source` has no more, or the child reads no more.
void write_piece(Child& child, const Source& source)
{
    Pipe& pipe = *child.streams.input;
    if (child.unwritten.empty()) child.unwritten = source();
    if (child.unwritten.empty()) return pipe.close_end(1);
    const ssize_t count = ::write(pipe.ends[1], child.unwritten.data(), child.unwritten.size());
    if (count > 0) child.unwritten.erase(0, static_cast<std::size_t>(count));
    // A child that reads no more says why on its own streams.
    if (count < 0 && errno != EAGAIN && errno != EINTR) pipe.close_end(1);
}

/// Waits until one of them has written something or can be written to, and serves it.
void serve(const std::vector<std::unique_ptr<Child>>& children, std::vector<ProcessResult>& results, const Sink& sink,
           const Source& source)
{
    std::vector<pollfd> waiting;
    for (const auto& child : children) {
        const Streams& streams = child->streams;
        for (const Pipe* pipe : {&streams.output, &streams.error}) waiting.push_back({pipe->ends[0], POLLIN, 0});
        waiting.push_back({streams.input ? streams.input->ends[1] : -1, POLLOUT, 0}); // -1: poll looks away
    }
    if (::poll(waiting.data(), waiting.size(), -1) < 0) {
        if (errno == EINTR) return;
        throw MachineError(fmt::format("cannot wait for a child process: {}", std::strerror(errno)));
    }
    for (std::size_t k = 0; k < children.size(); ++k) {
        ProcessResult& result = results[children[k]->command];
        const auto keep = [](std::string& text) {
            return [&text](const char* bytes, std::size_t count) { text.append(bytes, count); };
        };
        Streams& streams = children[k]->streams;
        if (waiting[3 * k].revents != 0) read_piece(streams.output, sink ? sink : keep(result.output));
        if (waiting[3 * k + 1].revents != 0) read_piece(streams.error, keep(result.error));
        if (waiting[3 * k + 2].revents != 0) write_piece(*children[k], source);
    }
}

std::size_t free_place()
{
    std::size_t place = 0;
    while (running_children[place] > 0) ++place;
    return place;
}

/// `source` feeds the only one of them, or none.
std::vector<ProcessResult> run_all(const std::vector<std::vector<std::string>>& commands, std::size_t at_once,
                                   const Sink& sink, const Source& source)
{
    std::vector<ProcessResult> results(commands.size());
    std::vector<std::unique_ptr<Child>> children;
    const InterruptsForwarded forwarded;
    at_once = std::clamp<std::size_t>(at_once, 1, most_children);
    for (std::size_t next = 0; next < commands.size() || !children.empty();) {
        const bool more = next < commands.size() && (interrupts == 0 || next == 0);
        if (more && children.size() < at_once) {
            if (auto child = start_child(commands[next], static_cast<bool>(source), results[next])) {
                child->command = next;
                child->place = free_place();
                running_children[child->place] = child->process;
                if (interrupts > 0) ::kill(-child->process, SIGINT);
                children.push_back(std::move(child));
            }
            ++next;
            continue;
        }
        if (children.empty()) break;
        serve(children, results, sink, source);
        std::erase_if(children, [&](const std::unique_ptr<Child>& child) {
            if (child->is_silent()) results[child->command].exit_code = child->wait();
            return child->is_silent();
        });
    }
    for (ProcessResult& result : results) result.interrupted = interrupts > 0;
    return results;
}

} // namespace

ProcessResult run_process(const std::vector<std::string>& arguments, const Sink& sink, const Source& source)
{
    return std::move(run_all({arguments}, 1, sink, source)[0]);
}

std::vector<ProcessResult> run_processes(const std::vector<std::vector<std::string>>& commands, std::size_t at_once)
{
    return run_all(commands, at_once, {}, {});
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
