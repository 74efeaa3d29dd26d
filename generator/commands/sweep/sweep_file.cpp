// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/sweep/sweep_file.hpp"

#include "commands/machine/write_file.hpp"
#include "commands/sweep/sweep_rows.hpp"
#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lagen {

namespace {

constexpr const char* identity_line = "what `lagen sweep` writes\n";

std::string identity_file(const std::string& path)
{
    return path + ".sweep";
}

std::string text_of(const SweepIdentity& identity)
{
    return fmt::format("{}key={}\nbuild={}\ncommand={}\nrows={}\nshard={}\n{}", identity_line, identity.key,
                       identity.build, identity.command, identity.rows, identity.shard.text(),
                       identity.complete ? "complete=yes\n" : "");
}

bool exists(const std::string& path)
{
    return ::access(path.c_str(), F_OK) == 0;
}

/// Throws where the rows of `file` are not those of `identity`.
void require_same(const std::string& file, const std::optional<SweepIdentity>& found, const SweepIdentity& identity)
{
    const char* hint = "--resume goes on with the same model, options and lagen; without it the sweep begins anew";
    if (!found) throw UsageError(fmt::format("nothing says of which sweep '{}' is", file), hint);
    std::string why;
    if (found->key != identity.key)
        why = found->command == identity.command ? "the model has changed" : found->command;
    else if (found->shard != identity.shard)
        why = fmt::format("part {}", found->shard.text());
    else if (found->build != identity.build)
        why = found->build;
    else
        return;
    throw UsageError(fmt::format("'{}' is of another sweep: {}", file, why), hint);
}

} // namespace

int open_locked(const std::string& path, bool waits)
{
    while (true) {
        const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (file < 0) return -1;
        int locked = 0;
        while ((locked = ::flock(file, waits ? LOCK_EX : LOCK_EX | LOCK_NB)) != 0 && errno == EINTR) {
        }
        if (locked != 0 && (waits || errno == EWOULDBLOCK)) {
            const int error = errno;
            ::close(file);
            errno = error;
            return -1;
        }
        struct stat held {
        }, named{};
        // Its last holder may have given it another name, or none, before it let go of it.
        if (::fstat(file, &held) == 0 && ::stat(path.c_str(), &named) == 0 && held.st_ino == named.st_ino &&
            held.st_dev == named.st_dev)
            return file;
        ::close(file);
    }
}

bool put_in_place(int file, const std::string& partial, const std::string& path)
{
    return (::fsync(file) == 0 || errno == EINVAL) && ::rename(partial.c_str(), path.c_str()) == 0;
}

void write_identity(const std::string& path, const SweepIdentity& identity)
{
    write_file(identity_file(path), text_of(identity));
}

bool is_finished(const std::string& path, const SweepIdentity& identity)
{
    if (!exists(path)) return false;
    const std::optional<SweepIdentity> found = find_identity(path);
    require_same(path, found, identity);
    return found->complete;
}

std::optional<SweepIdentity> find_identity(const std::string& path)
{
    if (::access(identity_file(path).c_str(), R_OK) != 0) return std::nullopt;
    const std::string text = content_of_file(identity_file(path));
    if (!text.starts_with(identity_line)) return std::nullopt;
    SweepIdentity identity;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("key=")) identity.key = line.substr(4);
        if (line.starts_with("build=")) identity.build = line.substr(6);
        if (line.starts_with("command=")) identity.command = line.substr(8);
        if (line.starts_with("rows=")) identity.rows = read_whole(line.substr(5)).value_or(0);
        if (line.starts_with("shard=")) identity.shard = read_shard(line.substr(6));
        if (line == "complete=yes") identity.complete = true;
    }
    return identity;
}

SweepFile::SweepFile(std::string path, const SweepIdentity& identity)
    : path_(std::move(path)), partial_(path_ + ".partial"), identity_(identity)
{
}

// The other constructor has made the object: what is thrown here lets go of the file.
SweepFile::SweepFile(std::string path, const SweepIdentity& identity, const std::string& heading, bool resume)
    : SweepFile(std::move(path), identity)
{
    struct stat status {};
    if (::stat(path_.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
        errno = S_ISDIR(status.st_mode) ? EISDIR : EINVAL;
        refuse_writing(path_, errno);
    }
    file_ = open_locked(partial_, false);
    if (file_ < 0 && errno == EWOULDBLOCK) throw UsageError(fmt::format("another sweep is writing '{}'", partial_));
    if (file_ < 0) refuse_writing(partial_, errno);
    start(heading, resume);
}

void SweepFile::start(const std::string& heading, bool resume)
{
    struct stat status {};
    const bool is_partial = ::fstat(file_, &status) == 0 && status.st_size > 0;
    if (!resume) return begin(heading);
    if (is_partial) {
        require_same(partial_, find_identity(path_), identity_);
        return go_on(heading);
    }
    if (!is_finished(path_, identity_)) return begin(heading);
    let_go();
    rows_ = identity_.shard.size(identity_.rows);
}

/// An empty file is no part of a table.
void SweepFile::let_go()
{
    if (file_ < 0) return;
    struct stat status {};
    if (::fstat(file_, &status) == 0 && status.st_size == 0) ::unlink(partial_.c_str());
    ::close(file_);
    file_ = -1;
}

SweepFile::~SweepFile()
{
    let_go();
}

void SweepFile::begin(const std::string& heading)
{
    if (::ftruncate(file_, 0) != 0 || ::lseek(file_, 0, SEEK_SET) != 0) refuse_writing(partial_, errno);
    write_identity(path_, identity_);
    write(heading);
}

/// The index at the beginning of a row and the status at its end.
void SweepFile::see(std::string_view row)
{
    const std::uint64_t index = identity_.shard.index + rows_ * identity_.shard.count;
    if (!row.starts_with(std::to_string(index) + ","))
        throw UsageError(fmt::format("'{}' does not hold row {} where it must stand", partial_, index),
                         "without --resume the sweep begins anew");
    ++rows_;
    ++statuses_[std::string(row.substr(row.rfind(',') + 1))];
}

void SweepFile::go_on(const std::string& heading)
{
    std::string text;
    std::array<char, 65536> buffer;
    off_t whole = 0;
    bool headed = false;
    ssize_t count = 0;
    while ((count = ::read(file_, buffer.data(), buffer.size())) > 0) {
        text.append(buffer.data(), static_cast<std::size_t>(count));
        std::size_t begin = 0;
        for (std::size_t end = 0; (end = text.find("\r\n", begin)) != std::string::npos; begin = end + 2) {
            const std::string_view line = std::string_view(text).substr(begin, end - begin);
            if (headed) see(line);
            headed = headed || std::string(line) + "\r\n" == heading;
            if (!headed) break;
        }
        whole += static_cast<off_t>(begin);
        text.erase(0, begin);
    }
    if (count < 0) refuse_writing(partial_, errno);
    if (!headed) return begin(heading);
    if (::ftruncate(file_, whole) != 0 || ::lseek(file_, whole, SEEK_SET) != whole) refuse_writing(partial_, errno);
}

void SweepFile::write(std::string_view lines)
{
    while (!lines.empty()) {
        const ssize_t count = ::write(file_, lines.data(), lines.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0)
            refuse_writing(partial_, errno, fmt::format("{} rows stay in it; --resume goes on with them", rows_));
        lines.remove_prefix(static_cast<std::size_t>(count));
    }
}

void SweepFile::append(std::string_view lines)
{
    write(lines);
    for (std::size_t begin = 0, end = 0; (end = lines.find("\r\n", begin)) != std::string_view::npos; begin = end + 2)
        see(lines.substr(begin, end - begin));
}

void SweepFile::complete()
{
    if (file_ < 0) return;
    if (!put_in_place(file_, partial_, path_)) refuse_writing(path_, errno);
    ::close(file_);
    file_ = -1;
    identity_.complete = true;
    write_identity(path_, identity_);
}

} // namespace lagen
