// SPDX-License-Identifier: GPL-2.0-or-later
/// Reading a file whole, with a bound.
#include "model/read_file.hpp"

#include "text/diagnostic.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>

namespace lagen {

std::string read_file(const std::string& path)
{
    constexpr std::size_t most_bytes = std::size_t{16} << 20U;
    const auto refuse = [&](const std::string& why, const char* hint) {
        throw ModelError(fmt::format("the model file '{}' {}", path, why), {}, hint);
    };
    if (path.find('\0') != std::string::npos) refuse("has a zero byte in its name", "");
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found)
        refuse("does not exist", "give the path of a .toml file");
    if (status.type() == std::filesystem::file_type::directory)
        refuse("is a folder", "give the path of a .toml file in it");
    std::ifstream in(path, std::ios::binary);
    if (!in) refuse(fmt::format("cannot be opened: {}", std::strerror(errno)), "");
    std::string text;
    std::array<char, 65536> block{};
    while (in.read(block.data(), block.size()) || in.gcount() > 0) {
        text.append(block.data(), static_cast<std::size_t>(in.gcount()));
        if (text.size() > most_bytes) refuse("is larger than 16 MiB", "");
    }
    if (in.bad()) refuse("cannot be read to its end", "");
    return text;
}

} // namespace lagen
