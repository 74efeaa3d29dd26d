// SPDX-License-Identifier: GPL-2.0-or-later
/// Least recently used programs go first; use is remembered in the time of modification.
#include "commands/machine/compile_cache.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string_view>
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

/// A program, or the record of a run.
bool is_key(std::string name)
{
    if (name.ends_with(".run")) name.resize(name.size() - 4);
    return name.size() == 32 && name.find_first_not_of("0123456789abcdef") == std::string::npos;
}

} // namespace

bool use_cached(const std::string& program)
{
    std::error_code ignored;
    if (!fs::is_regular_file(program, ignored) || ::access(program.c_str(), X_OK) != 0) return false;
    fs::last_write_time(program, fs::file_time_type::clock::now(), ignored);
    return true;
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
