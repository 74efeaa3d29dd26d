// SPDX-License-Identifier: GPL-2.0-or-later
#include "machine/write_file.hpp"

#include "machine/activity_watch.hpp"
#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace lagen {

namespace {

/// Signals wait while a temporary exists.
class SignalsHeld {
  public:
    SignalsHeld()
    {
        sigset_t all;
        sigfillset(&all);
        sigprocmask(SIG_BLOCK, &all, &before_);
    }
    ~SignalsHeld() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
    SignalsHeld(const SignalsHeld&) = delete;
    SignalsHeld& operator=(const SignalsHeld&) = delete;

  private:
    sigset_t before_{};
};

/// Everything or an errno.
int write_all(int file, std::string_view content)
{
    while (!content.empty()) {
        const ssize_t written = ::write(file, content.data(), content.size());
        if (written < 0) {
            if (errno == EINTR) continue;
            return errno;
        }
        content.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

/// A link keeps being a link: the file behind it is what gets replaced.
std::filesystem::path target_of(const std::string& path)
{
    std::error_code error;
    std::filesystem::path resolved = std::filesystem::weakly_canonical(path, error);
    return error ? std::filesystem::path(path) : resolved;
}

void write_directly(const std::string& path, std::string_view content)
{
    const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0) refuse_writing(path, errno);
    int error = write_all(file, content);
    if (::close(file) != 0 && error == 0) error = errno;
    if (error != 0 && error != EPIPE) refuse_writing(path, error);
}

} // namespace

void refuse_writing(const std::string& path, int error, const std::string& hint)
{
    throw MachineError(fmt::format("cannot write '{}': {}", path, std::strerror(error)), hint);
}

void refuse_reading(const std::string& path, int error)
{
    throw MachineError(fmt::format("cannot read '{}': {}", path, std::strerror(error)));
}

void write_file(const std::string& path, std::string_view content)
{
    if (path == "-") return write_standard_output(content);
    struct stat status {};
    const bool exists = ::stat(path.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) refuse_writing(path, EISDIR);
    if (exists && !S_ISREG(status.st_mode)) return write_directly(path, content);

    const std::string target = target_of(path).string();
    const SignalsHeld held;
    std::string temporary = target + ".XXXXXX";
    const int file = ::mkstemp(temporary.data());
    if (file < 0) refuse_writing(path, errno);
    const mode_t mask = ::umask(0);
    ::umask(mask);
    int error = ::fchmod(file, exists ? (status.st_mode & 07777U) : (0666U & ~mask)) == 0 ? 0 : errno;
    if (error == 0) error = write_all(file, content);
    if (error == 0 && ::fsync(file) != 0 && errno != EINVAL) error = errno;
    if (::close(file) != 0 && error == 0) error = errno;
    if (error == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
    if (error != 0) {
        ::unlink(temporary.c_str());
        refuse_writing(path, error);
    }
}

void require_writable(const std::string& path)
{
    if (path == "-") return;
    struct stat status {};
    const bool exists = ::stat(path.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) refuse_writing(path, EISDIR);
    if (exists && !S_ISREG(status.st_mode)) return;
    const std::filesystem::path folder = target_of(path).parent_path();
    // The dot tells a file in the place of the folder from one without permission.
    if (::access((folder / ".").c_str(), W_OK | X_OK) != 0) refuse_writing(path, errno);
}

void write_standard_output(std::string_view content)
{
    wipe_activity_line();
    const int error = write_all(STDOUT_FILENO, content);
    if (error != 0 && error != EPIPE)
        throw MachineError(fmt::format("cannot write to standard output: {}", std::strerror(error)));
}

void write_standard_error(std::string_view text)
{
    wipe_activity_line();
    (void)write_all(STDERR_FILENO, text);
}

void warn(const std::string& text, const std::string& hint)
{
    write_standard_error(with_hint("warning: " + text, hint) + "\n");
}

void warn(const std::vector<std::string>& texts)
{
    for (const std::string& text : texts) warn(text);
}

std::string content_of_file(const std::string& path)
{
    std::FILE* file = std::fopen(path.c_str(), "rb");
    if (file == nullptr) refuse_reading(path, errno);
    std::string content;
    char buffer[65536];
    for (std::size_t count = 0; (count = std::fread(buffer, 1, sizeof buffer, file)) > 0;)
        content.append(buffer, count);
    const bool failed = std::ferror(file) != 0;
    const int error = errno;
    std::fclose(file);
    if (failed) refuse_reading(path, error);
    return content;
}

} // namespace lagen
