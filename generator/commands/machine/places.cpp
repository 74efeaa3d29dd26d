// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/machine/places.hpp"

#include "commands/machine/write_file.hpp"
#include "diagnostic.hpp"

#include <fmt/core.h>

#include <cstdlib>
#include <filesystem>
#include <sys/stat.h>
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

bool writable(const fs::path& folder)
{
    std::error_code error;
    fs::create_directories(folder, error);
    return !error && ::access(folder.c_str(), W_OK) == 0;
}

} // namespace

std::string runtime_folder()
{
    const std::string folder = first_with(
        {environment("LAGEN_INCLUDE"), prefix() / "include", fs::path(LAGEN_SOURCE_DIR) / "runtime" / "include"},
        "lagen/kernel.hpp");
    if (folder.empty())
        throw MachineError("error: the runtime's headers (lagen/kernel.hpp) were not found\nhint: set LAGEN_INCLUDE to "
                           "the folder that holds lagen/");
    return folder;
}

std::string program_folder()
{
    const std::string folder =
        first_with({prefix() / "share" / "lagen" / "program", fs::path(LAGEN_SOURCE_DIR) / "runtime" / "program"},
                   "lagen_run/driver.hpp");
    if (folder.empty())
        throw MachineError(
            "error: the program of `run` (lagen_run/driver.hpp) was not found\nhint: it is installed with "
            "lagen, in share/lagen/program beside bin/");
    return folder;
}

std::string eigen_folder()
{
    const std::string folder = first_with(
        {environment("LAGEN_EIGEN_INCLUDE"), LAGEN_EIGEN_DIR, "/usr/include/eigen3", "/usr/local/include/eigen3"},
        "Eigen/Core");
    if (folder.empty())
        throw MachineError("error: Eigen's headers (Eigen/Core) were not found\nhint: set LAGEN_EIGEN_INCLUDE to the "
                           "folder that holds Eigen/");
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
    const std::string own = environment("LAGEN_CACHE");
    const std::string xdg = environment("XDG_CACHE_HOME");
    const std::string home = environment("HOME");
    std::vector<fs::path> candidates;
    if (!own.empty()) candidates.emplace_back(own);
    if (!xdg.empty()) candidates.emplace_back(fs::path(xdg) / "lagen");
    if (!home.empty()) candidates.emplace_back(fs::path(home) / ".cache" / "lagen");
    for (const fs::path& candidate : candidates)
        if (writable(candidate)) return candidate.string();

    // Below a shared folder the name may be taken by somebody else: compiled code is only ever run from a folder of
    // ours.
    std::error_code ignored;
    const fs::path shared = fs::temp_directory_path(ignored) / fmt::format("lagen-{}", ::getuid());
    struct stat status {};
    ::mkdir(shared.c_str(), 0700);
    if (::lstat(shared.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == ::getuid() &&
        (status.st_mode & 022U) == 0)
        return shared.string();
    throw MachineError(
        fmt::format("error: no folder for compiled scenes can be written (tried {} and '{}')\nhint: set LAGEN_CACHE",
                    candidates.empty() ? "none" : fmt::format("'{}'", candidates.front().string()), shared.string()));
}

} // namespace lagen
