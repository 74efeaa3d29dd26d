// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/sweep/sweep_file.hpp"

#include "commands/line/options.hpp"
#include "commands/sweep/sweep_rows.hpp"
#include "machine/write_file.hpp"
#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <thread>
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

/// A variable of the environment that holds a whole number; nothing where it is not set.
std::optional<std::uint64_t> variable(const char* name)
{
    const char* text = std::getenv(name);
    if (text == nullptr || *text == '\0') return std::nullopt;
    const std::optional<std::uint64_t> value = read_whole(text);
    if (value) return value;
    throw UsageError(fmt::format("{} is '{}', where a whole number is required", name, text),
                     "--shard k/n says which rows are computed");
}

/// Of one launcher; nothing where its variables are not set.
std::optional<Shard> shard_of(const char* rank, const char* size)
{
    const std::optional<std::uint64_t> index = variable(rank), count = variable(size);
    if (!index || !count) return std::nullopt;
    if (*index < *count) return Shard{*index, *count};
    throw UsageError(fmt::format("{} is {} and {} is {}, which is no part of a sweep", rank, *index, size, *count),
                     "--shard k/n says which rows are computed");
}

/// Tasks of an array are numbered by its indices, which may begin anywhere and have a step, but no gaps.
Shard array_shard()
{
    const std::optional<std::uint64_t> task = variable("SLURM_ARRAY_TASK_ID"),
                                       count = variable("SLURM_ARRAY_TASK_COUNT");
    if (!task || !count) return {};
    const std::uint64_t least = variable("SLURM_ARRAY_TASK_MIN").value_or(0);
    const std::uint64_t step = std::max<std::uint64_t>(variable("SLURM_ARRAY_TASK_STEP").value_or(1), 1);
    const std::uint64_t most = variable("SLURM_ARRAY_TASK_MAX").value_or(least + (*count - 1) * step);
    if (*task >= least && (*task - least) % step == 0 && (*task - least) / step < *count &&
        most == least + (*count - 1) * step)
        return {(*task - least) / step, *count};
    throw UsageError(
        fmt::format("task {} of a Slurm array of {} from {} to {} cannot be numbered", *task, *count, least, most),
        fmt::format("give the array indices without gaps (--array=0-{}), or --shard k/n", *count - 1));
}

// Row k of the whole is row k / n of part k mod n, so that one line of each part is held at a time.

/// The parts in the order of their shards.
std::vector<std::string> sorted_parts(const std::vector<std::string>& parts, SweepIdentity& whole)
{
    std::vector<std::string> sorted;
    for (const std::string& part : parts) {
        const std::optional<SweepIdentity> found = find_identity(part);
        if (!found || !found->complete)
            throw UsageError(fmt::format("'{0}' is no complete part of a sweep: '{0}.sweep' does not say so", part));
        if (sorted.empty()) {
            whole = *found;
            sorted.resize(whole.shard.count);
        }
        if (found->key != whole.key || found->rows != whole.rows || found->shard.count != whole.shard.count)
            throw UsageError(fmt::format("'{}' and '{}' are not parts of the same sweep", parts[0], part));
        if (found->build != whole.build)
            throw UsageError(fmt::format("two builds have made these parts:\n  '{}': {}\n  '{}': {}", parts[0],
                                         whole.build, part, found->build),
                             "make all parts with one of them");
        std::string& place = sorted[found->shard.index];
        if (!place.empty())
            throw UsageError(fmt::format("part {} is given twice, by '{}' and '{}'", found->shard.text(), place, part));
        place = part;
    }
    for (std::size_t k = 0; k < sorted.size(); ++k)
        if (sorted[k].empty()) throw UsageError(fmt::format("part {}/{} is missing", k, sorted.size()));
    return sorted;
}

/// The next line of `file` with its end; it must begin with `begin`.
std::string line_of(std::ifstream& file, const std::string& part, const std::string& begin)
{
    std::string line;
    if (!std::getline(file, line) || !line.starts_with(begin) || !line.ends_with('\r'))
        throw UsageError(fmt::format("'{}' has no line that begins with '{}' where it must stand", part, begin));
    return line + '\n';
}

/// Gives the heading and the rows of the whole, whose parts are sorted, one after the other to `take`.
void each_line(const std::vector<std::string>& parts, std::uint64_t rows,
               const std::function<void(const std::string& line)>& take)
{
    std::vector<std::ifstream> files;
    std::string heading;
    for (const std::string& part : parts) {
        files.emplace_back(part, std::ios::binary);
        if (!files.back()) refuse_reading(part, errno);
        heading = line_of(files.back(), part, heading.empty() ? "index," : heading.substr(0, heading.size() - 1));
    }
    take(heading);
    for (std::uint64_t row = 0; row < rows; ++row) {
        const std::size_t part = static_cast<std::size_t>(row % parts.size());
        take(line_of(files[part], parts[part], std::to_string(row) + ","));
    }
}

/// A file that is written under another name and gets its own at the end, when all of it is on the disk.
class MergedFile {
  public:
    explicit MergedFile(const std::string& path)
        : path_(path), partial_(path + ".partial"), file_(std::fopen(partial_.c_str(), "wb"))
    {
        check(file_ != nullptr);
    }
    ~MergedFile()
    {
        if (file_ != nullptr) std::fclose(file_);
        if (!complete_) ::unlink(partial_.c_str());
    }
    MergedFile(const MergedFile&) = delete;
    MergedFile& operator=(const MergedFile&) = delete;

    void write(const std::string& line) { check(std::fwrite(line.data(), 1, line.size(), file_) == line.size()); }
    void complete()
    {
        check(std::fflush(file_) == 0 && put_in_place(::fileno(file_), partial_, path_));
        complete_ = true;
    }

  private:
    void check(bool good) const
    {
        if (good) return;
        refuse_writing(path_, errno);
    }

    std::string path_, partial_;
    std::FILE* file_;
    bool complete_ = false;
};

/// FILE.lock, held while this lives and gone afterwards.
class RankLock {
  public:
    explicit RankLock(const std::string& path) : path_(path + ".lock"), file_(open_locked(path_, true)) {}
    ~RankLock()
    {
        if (file_ < 0) return;
        ::unlink(path_.c_str());
        ::close(file_);
    }
    RankLock(const RankLock&) = delete;
    RankLock& operator=(const RankLock&) = delete;

    [[nodiscard]] bool held() const { return file_ >= 0; }

  private:
    std::string path_;
    int file_;
};

/// What was written, and its name, outlast a crash of the machine.
void sync_folder_of(const std::string& path)
{
    const std::string folder = std::filesystem::path(path).parent_path().string();
    const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) return;
    (void)::fsync(file); // a file system that cannot do this does it by itself
    ::close(file);
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

Shard read_shard(const std::string& text)
{
    const std::size_t slash = std::min(text.find('/'), text.size());
    const std::optional<std::uint64_t> index = read_whole(text.substr(0, slash));
    const std::optional<std::uint64_t> count = read_whole(text.substr(std::min(slash + 1, text.size())));
    if (index && count && *index < *count) return {*index, *count};
    throw UsageError(fmt::format("--shard is '{}', where k/n with 0 <= k < n is required", text));
}

Shard launched_shard()
{
    std::optional<Shard> found;
    for (const auto& [rank, size] : {std::pair("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"),
                                     {"PMI_RANK", "PMI_SIZE"},
                                     {"SLURM_PROCID", "SLURM_NTASKS"}})
        if (!found) found = shard_of(rank, size);
    const Shard inner = found.value_or(Shard{}), outer = array_shard();
    return {outer.index * inner.count + inner.index, outer.count * inner.count};
}

std::size_t launched_threads()
{
    if (const std::optional<std::uint64_t> cpus = variable("SLURM_CPUS_PER_TASK"); cpus && *cpus > 0)
        return static_cast<std::size_t>(*cpus);
    const std::size_t cores = std::max(std::thread::hardware_concurrency(), 1U);
    const std::uint64_t processes = std::max<std::uint64_t>(variable("OMPI_COMM_WORLD_LOCAL_SIZE").value_or(1), 1);
    return std::max<std::size_t>(cores / static_cast<std::size_t>(processes), 1);
}

void merge_sweep(const std::vector<std::string>& parts, const std::string& path)
{
    std::error_code ignored;
    for (const std::string& part : parts)
        if (part == path || std::filesystem::equivalent(part, path, ignored))
            throw UsageError(fmt::format("'{}' is a part, and cannot be --output as well", part));
    SweepIdentity whole;
    const std::vector<std::string> sorted = sorted_parts(parts, whole);
    each_line(sorted, whole.rows, [](const std::string&) {}); // nothing is written before all is read
    MergedFile merged(path);
    each_line(sorted, whole.rows, [&](const std::string& line) { merged.write(line); });
    merged.complete();
    whole.shard = {};
    write_identity(path, whole);
}

std::string rank_file(const std::string& path, const Shard& shard)
{
    return fmt::format("{}.{}-of-{}", path, shard.index, shard.count);
}

bool merge_ranks(const std::string& path, const SweepIdentity& identity)
{
    // Of ranks that end at once the first one merges; the others find that their parts are gone.
    const RankLock lock(path);
    if (!lock.held()) return false;
    std::vector<std::string> parts;
    for (std::uint64_t k = 0; k < identity.shard.count; ++k) {
        parts.push_back(rank_file(path, {k, identity.shard.count}));
        const std::optional<SweepIdentity> found = find_identity(parts.back());
        if (!found || !found->complete || found->key != identity.key || found->rows != identity.rows) return false;
    }
    merge_sweep(parts, path);
    sync_folder_of(path);
    for (const std::string& part : parts)
        for (const std::string& name : {part, part + ".sweep"}) ::unlink(name.c_str());
    return true;
}

} // namespace lagen
