// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/machine/precompiled_header.hpp"

#include "commands/machine/write_file.hpp"
#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <filesystem>

namespace lagen {

namespace {

namespace fs = std::filesystem;

constexpr const char* precompiled = "lagen/export_model.hpp";

/// KEY.hpp beside a precompiled header of this length.
std::string text_beside(std::uintmax_t length)
{
    return fmt::format("// precompiled in {} bytes\n#include \"{}\"\n", length, precompiled);
}

} // namespace

PrecompiledHeader::PrecompiledHeader(const std::string& cache, const std::string& key)
    : header_(fmt::format("{}/{}.hpp", cache, key))
{
}

bool PrecompiledHeader::is_ready() const
try {
    std::error_code error;
    const std::uintmax_t length = fs::file_size(header_ + ".gch", error);
    if (error || !fs::is_regular_file(header_, error) || content_of_file(header_) != text_beside(length)) return false;
    for (const std::string& file : {header_, header_ + ".gch"})
        fs::last_write_time(file, fs::file_time_type::clock::now(), error);
    return true;
} catch (const MachineError&) {
    return false; // it cannot be read
}

std::vector<std::string> PrecompiledHeader::arguments() const
{
    return {"-include", header_};
}

std::vector<std::string> PrecompiledHeader::making(const std::string& scratch) const
{
    // clang asks for the file that was read to be where it was: an empty one that every system has.
    return {"-include", precompiled, "-x", "c++-header", "/dev/null", "-o", scratch + "/precompiled.gch"};
}

void PrecompiledHeader::keep(const std::string& scratch) const
try {
    std::error_code error;
    const std::uintmax_t length = fs::file_size(scratch + "/precompiled.gch", error);
    if (!error) fs::rename(scratch + "/precompiled.gch", header_ + ".gch", error);
    if (!error) write_file(header_, text_beside(length));
} catch (const MachineError&) {
    // The next command makes it again.
}

void PrecompiledHeader::discard() const
{
    std::error_code error;
    fs::remove(header_, error);
}

} // namespace lagen
