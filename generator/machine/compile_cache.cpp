// SPDX-License-Identifier: GPL-2.0-or-later
/// Least recently used programs go first; use is remembered in the time of modification.
#include "machine/compile_cache.hpp"

#include "machine/write_file.hpp"
#include "text/content_hash.hpp"
#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <unistd.h>
#include <vector>

namespace lagen {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_programs = 200;
constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 30U;
constexpr std::chrono::hours oldest_build{24};

struct Program {
    fs::file_time_type used;
    std::uintmax_t size = 0;
    fs::path path;
};

/// A program, the record of a run, or a precompiled header.
bool is_key(std::string_view name)
{
    for (const std::string_view ending : {".run", ".so", ".gch", ".hpp"})
        if (name.ends_with(ending)) name.remove_suffix(ending.size());
    return name.size() == 32 && name.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// The last line of a file with this content.
std::string seal_of(std::string_view content)
{
    return fmt::format("\n# whole: {}\n", ContentHash().add(content).hex32());
}

/// True where `content` ends with the seal of the rest.
bool is_sealed(std::string_view content)
{
    static const std::size_t length = seal_of("").size();
    return content.size() > length &&
           content.substr(content.size() - length) == seal_of(content.substr(0, content.size() - length));
}

/// The content of a file of the cache, which counts as used just now; nothing where it is not whole.
std::optional<std::string> sealed_content(const std::string& file)
try {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) return std::nullopt;
    std::string content = content_of_file(file);
    if (!is_sealed(content)) return std::nullopt;
    fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
    return content;
} catch (const MachineError&) {
    return std::nullopt; // it cannot be read
}

/// Makes room for a file of that name: a folder is not replaced by renaming.
void remove_folder(const std::string& name)
{
    std::error_code ignored;
    if (fs::is_directory(fs::symlink_status(name, ignored))) fs::remove_all(name, ignored);
}

} // namespace

bool use_cached(const std::string& program)
{
    return ::access(program.c_str(), X_OK) == 0 && sealed_content(program);
}

std::optional<std::string> kept_text(const std::string& file)
{
    std::optional<std::string> content = sealed_content(file);
    if (content) content->resize(content->size() - seal_of("").size());
    return content;
}

void keep_text(const std::string& file, const std::string& text)
try {
    remove_folder(file);
    write_file(file, text + seal_of(text));
    trim_cache(fs::path(file).parent_path().string());
} catch (const MachineError&) {
    // The next one finds nothing, and makes it again.
}

void keep_program(const std::string& made, const std::string& kept)
{
    std::error_code error;
    if (!fs::exists(made, error)) refuse_writing(kept, ENOENT);
    std::ofstream file(made, std::ios::binary | std::ios::app);
    file << seal_of(content_of_file(made)) << std::flush;
    if (!file) refuse_writing(kept, errno);
    file.close();
    remove_folder(kept);
    fs::rename(made, kept, error);
    if (error) refuse_writing(kept, error.value());
}

void trim_cache(const std::string& folder)
{
    std::error_code error;
    std::vector<Program> programs;
    const fs::file_time_type now = fs::file_time_type::clock::now();
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        std::error_code ignored;
        const std::string name = entry->path().filename().string();
        const fs::file_time_type used = entry->last_write_time(ignored);
        if (ignored) continue;
        if (is_key(name) && entry->is_regular_file(ignored))
            programs.push_back({used, entry->file_size(ignored), entry->path()});
        if (name.starts_with("build-") && now - used > oldest_build) fs::remove_all(entry->path(), ignored);
    }
    std::sort(programs.begin(), programs.end(),
              [](const Program& a, const Program& b) { return a.used != b.used ? a.used > b.used : a.path < b.path; });
    std::uintmax_t bytes = 0;
    for (std::size_t k = 0; k < programs.size(); ++k) {
        bytes += programs[k].size;
        if (k < most_programs && bytes <= most_bytes) continue;
        std::error_code ignored;
        fs::remove(programs[k].path, ignored);
    }
}

} // namespace lagen
