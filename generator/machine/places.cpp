// SPDX-License-Identifier: GPL-2.0-or-later
#include "machine/places.hpp"

#include "machine/temporary_folder.hpp"
#include "machine/write_file.hpp"
#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <map>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

namespace lagen {

namespace {

namespace fs = std::filesystem;

std::string environment(const char* name)
{
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}

/// The folder of this executable's installation: PREFIX of PREFIX/bin/lagen.
fs::path prefix()
{
    std::error_code error;
    const fs::path executable = fs::read_symlink("/proc/self/exe", error);
    return error ? fs::path() : executable.parent_path().parent_path();
}

/// The first of these folders that has `file` in it, or "".
std::string first_with(const std::vector<fs::path>& folders, const char* file)
{
    std::error_code ignored;
    for (const fs::path& folder : folders)
        if (!folder.empty() && fs::exists(folder / file, ignored)) return folder.string();
    return "";
}

/// Why programs can be neither made in `folder`, which is made, nor run from there; "" where they can.
std::string look_for_obstacle(const fs::path& folder)
{
    constexpr off_t room = 4 << 20; // bytes, of a program and what it is made from
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return error.message();
    const InterruptsHeld held;
    std::string probe = (folder / "build-XXXXXX").string();
    const int file = ::mkstemp(probe.data());
    if (file < 0) return std::strerror(errno);
    ::unlink(probe.c_str());
    const int failure = ::posix_fallocate(file, 0, room);
    struct statvfs system {};
    const bool executes = ::fstatvfs(file, &system) != 0 || (system.f_flag & ST_NOEXEC) == 0;
    ::close(file);
    if (failure == ENOSPC || failure == EDQUOT) return std::strerror(failure);
    return executes ? "" : "no program can be run from there (noexec)";
}

/// The same, looked for once.
const std::string& obstacle_in(const fs::path& folder)
{
    static std::map<std::string, std::string> known;
    const auto [found, is_new] = known.try_emplace(folder.string());
    if (is_new) found->second = look_for_obstacle(folder);
    return found->second;
}

/// The first of the folders that are named for it.
fs::path wanted_cache()
{
    if (const std::string own = environment("LAGEN_CACHE"); !own.empty()) return own;
    if (const std::string xdg = environment("XDG_CACHE_HOME"); !xdg.empty()) return fs::path(xdg) / "lagen";
    if (const std::string home = environment("HOME"); !home.empty()) return fs::path(home) / ".cache" / "lagen";
    return {};
}

/// Below a shared folder the name may be taken by somebody else: compiled code is only ever run from a folder of ours.
std::string obstacle_in_shared(const fs::path& folder)
{
    struct stat status {};
    ::mkdir(folder.c_str(), 0700);
    if (::lstat(folder.c_str(), &status) != 0) return std::strerror(errno);
    if (!S_ISDIR(status.st_mode) || status.st_uid != ::getuid() || (status.st_mode & 022U) != 0)
        return "it is not a folder that this user alone can write";
    return obstacle_in(folder);
}

} // namespace

std::string runtime_folder()
{
    const std::string folder = first_with(
        {environment("LAGEN_INCLUDE"), prefix() / "include", fs::path(LAGEN_SOURCE_DIR) / "runtime" / "include"},
        "lagen/kernel.hpp");
    if (folder.empty())
        throw MachineError("the runtime's headers (lagen/kernel.hpp) were not found",
                           "set LAGEN_INCLUDE to the folder that holds lagen/");
    return folder;
}

std::string program_folder()
{
    const std::string folder =
        first_with({prefix() / "share" / "lagen" / "program", fs::path(LAGEN_SOURCE_DIR) / "runtime" / "program"},
                   "lagen_run/driver.hpp");
    if (folder.empty())
        throw MachineError("the program of `run` (lagen_run/driver.hpp) was not found",
                           "it is installed with lagen, in share/lagen/program beside bin/");
    return folder;
}

std::string eigen_folder()
{
    const std::string folder = first_with(
        {environment("LAGEN_EIGEN_INCLUDE"), LAGEN_EIGEN_DIR, "/usr/include/eigen3", "/usr/local/include/eigen3"},
        "Eigen/Core");
    if (folder.empty())
        throw MachineError("Eigen's headers (Eigen/Core) were not found",
                           "set LAGEN_EIGEN_INCLUDE to the folder that holds Eigen/");
    return folder;
}

std::string models_folder()
{
    return first_with(
        {environment("LAGEN_MODELS"), prefix() / "share" / "lagen" / "models", fs::path(LAGEN_SOURCE_DIR) / "models"},
        "heavy_top.toml");
}

std::string model_path(const std::string& given)
{
    std::error_code ignored;
    const bool bare = !given.empty() && given.find_first_of("/.") == std::string::npos;
    if (!bare || fs::exists(given, ignored) || fs::exists(given + ".toml", ignored)) return given;
    const std::string folder = models_folder();
    if (folder.empty()) return given;
    const fs::path example = fs::path(folder) / (given + ".toml");
    if (!fs::is_regular_file(example, ignored)) return given;
    write_standard_error(fmt::format("note: '{}' is the example model {}\n", given, example.string()));
    return example.string();
}

std::string cache_folder()
{
    const fs::path wanted = wanted_cache();
    const std::string obstacle = wanted.empty() ? "none is named" : obstacle_in(wanted);
    if (obstacle.empty()) return wanted.string();
    const std::string found =
        wanted.empty() ? "there is no folder for compiled scenes: LAGEN_CACHE, XDG_CACHE_HOME and HOME are not set"
                       : fmt::format("'{}' is no folder for compiled scenes: {}", wanted.string(), obstacle);
    const fs::path shared = fs::path(shared_temporary_folder()) / fmt::format("lagen-{}", ::getuid());
    const std::string other = obstacle_in_shared(shared);
    if (!other.empty())
        throw MachineError(fmt::format("{}\nand neither is '{}': {}", found, shared.string(), other),
                           "set LAGEN_CACHE");
    static bool told = false;
    if (!told) write_standard_error(fmt::format("note: {}; they go to '{}'\n", found, shared.string()));
    told = true;
    return shared.string();
}

} // namespace lagen
