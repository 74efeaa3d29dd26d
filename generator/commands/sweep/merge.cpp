// SPDX-License-Identifier: GPL-2.0-or-later
/// Row k of the whole is row k / n of part k mod n, so that one line of each part is held at a time.
#include "commands/line/options.hpp"
#include "commands/sweep/sweep_file.hpp"
#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace lagen {

namespace {

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

void merge_sweep(const std::vector<std::string>& parts, const std::string& path)
{
    std::error_code ignored;
    for (const std::string& part : parts)
        if (part == path || std::filesystem::equivalent(part, path, ignored))
            throw UsageError(fmt::format("'{}' is a part, and cannot be --output as well", part));
    SweepIdentity whole;
    const std::vector<std::string> sorted = sorted_parts(parts, whole);
    std::vector<std::ifstream> files;
    std::string heading;
    for (const std::string& part : sorted) {
        files.emplace_back(part, std::ios::binary);
        if (!files.back()) refuse_reading(part, errno);
        heading = line_of(files.back(), part, heading.empty() ? "index," : heading.substr(0, heading.size() - 1));
    }
    MergedFile merged(path);
    merged.write(heading);
    for (std::uint64_t row = 0; row < whole.rows; ++row) {
        const std::size_t part = static_cast<std::size_t>(row % sorted.size());
        merged.write(line_of(files[part], sorted[part], std::to_string(row) + ","));
    }
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
