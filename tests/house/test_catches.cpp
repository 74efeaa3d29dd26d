// SPDX-License-Identifier: GPL-2.0-or-later
/// What the generator catches: an alarm of its own defects passes every handler but that of the command.
#include "source_tree.hpp"

#include <catch2/catch.hpp>

#include <map>
#include <set>

using namespace lagen::house;

namespace {

/// Handlers that take more than one kind of error, by the files that may have them: the commands, which end there, and
/// the door to GiNaC, which reports by all kinds.
const std::map<std::string, std::set<std::string>>& wide_handlers()
{
    static const std::map<std::string, std::set<std::string>> allowed{
        {"...", {}},
        {"InternalError", {"generator/lagen.cpp"}},
        {"Error", {"generator/lagen.cpp", "generator/commands/check.cpp", "generator/symbolic/ginac_door.hpp"}},
        {"std::exception", {"generator/lagen.cpp", "generator/symbolic/ginac_door.hpp"}},
        {"std::runtime_error", {}},
        {"std::logic_error", {}}};
    return allowed;
}

/// "const Error& error" as "Error".
std::string caught_type(const std::string& line)
{
    const std::size_t begin = line.find("catch (") + 7;
    std::string text = line.substr(begin, line.find_first_of("&)", begin) - begin);
    if (text.starts_with("const ")) text.erase(0, 6);
    if (text.starts_with("lagen::")) text.erase(0, 7);
    return text;
}

} // namespace

TEST_CASE("each handler of the generator names the error that it means")
{
    std::size_t handlers = 0;
    for (const SourceText& text : read_tree({"generator"}))
        for (const std::string& line : text.lines) {
            if (line.find("catch (") == std::string::npos) continue;
            ++handlers;
            INFO(text.path << ": " << line);
            const auto wide = wide_handlers().find(caught_type(line));
            if (wide != wide_handlers().end()) CHECK(wide->second.contains(text.path));
        }
    CHECK(handlers > 20);
}
