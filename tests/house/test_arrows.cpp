// SPDX-License-Identifier: GPL-2.0-or-later
/// Arrows between rooms point one way: the include graph is read from the files and compared with the plan. A shared
/// include root would let a backward include build.
#include "source_tree.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <iostream>
#include <regex>
#include <sstream>

using namespace lagen::house;

namespace {

/// The runtime's own headers are "lagen/...", those of the programs around headers "lagen_run/...", "lagen_sweep/...".
std::string room_included(const std::string& target)
{
    if (target.starts_with("lagen/")) return "runtime";
    return target.starts_with("lagen_") ? "program" : room_of("generator/" + target);
}

/// "path:line includes X (room r)", one a line, for every include that no arrow allows.
std::vector<std::string> backward_includes(const std::vector<SourceText>& files, const Arrows& arrows)
{
    std::vector<std::string> found;
    for (const SourceText& file : files) {
        const std::set<std::string> allowed = reachable_rooms(arrows, room_of(file.path));
        for (const Include& include : includes_of(file)) {
            if (!include.quoted) continue;
            const std::string room = room_included(include.target);
            if (!allowed.contains(room))
                found.push_back(file.path + ":" + std::to_string(include.line) + " includes \"" + include.target +
                                "\" of " + room);
        }
    }
    return found;
}

/// The same for the folders inside of rooms.
std::vector<std::string> backward_folder_includes(const std::vector<SourceText>& files)
{
    std::vector<std::string> found;
    for (const SourceText& file : files) {
        const std::set<std::string> allowed = reachable_rooms(planned_folder_arrows(), folder_of(file.path));
        for (const Include& include : includes_of(file)) {
            const std::string target = "generator/" + include.target;
            if (include.quoted && room_of(target) == room_of(file.path) && !allowed.contains(folder_of(target)))
                found.push_back(file.path + ":" + std::to_string(include.line) + " includes \"" + include.target +
                                "\"");
        }
    }
    return found;
}

/// A library's headers and the rooms that may know it.
struct Library {
    const char* pattern; ///< of the include's target
    std::set<std::string> rooms;
};

const std::vector<Library>& libraries()
{
    static const std::vector<Library> known{
        {"ginac/.*|cln/.*", {"symbolic", "equations"}},
        {"toml.*", {"model"}},
        {"arb.*\\.h|arf\\.h|acb.*\\.h|mag\\.h|flint/.*|fmpq.*\\.h|fmpz.*\\.h", {"proof"}},
        {"mpfr\\.h", {"expression", "graph", "proof", "emit"}}, // rounds literals, functions and enclosures
        {"boost/program_options.*", {"commands"}},
        {"Eigen/.*", {"runtime", "program", "linear"}},
    };
    return known;
}

std::vector<std::string> misplaced_libraries(const std::vector<SourceText>& files)
{
    std::vector<std::string> found;
    for (const SourceText& file : files)
        for (const Include& include : includes_of(file))
            for (const Library& library : libraries())
                if (std::regex_match(include.target, std::regex(library.pattern)) &&
                    !library.rooms.contains(room_of(file.path)))
                    found.push_back(file.path + ":" + std::to_string(include.line) + " includes " + include.target);
    return found;
}

/// The arrows that the files have, without those inside a room.
Arrows actual_arrows(const std::vector<SourceText>& files)
{
    Arrows arrows;
    for (const SourceText& file : files)
        for (const Include& include : includes_of(file))
            if (include.quoted && !file.path.starts_with("runtime")) {
                const std::string from = room_of(file.path);
                const std::string to = room_of("generator/" + include.target);
                if (from != to) arrows[from].insert(to);
            }
    return arrows;
}

/// The headers of the runtime that a header includes, through others too, itself among them.
std::set<std::string> reached_headers(const std::vector<SourceText>& files, const std::string& header)
{
    std::set<std::string> reached{header};
    std::vector<std::string> next{header};
    while (!next.empty()) {
        const std::string path = "runtime/include/" + next.back();
        next.pop_back();
        for (const SourceText& file : files) {
            if (file.path != path) continue;
            for (const Include& include : includes_of(file))
                if (include.quoted && reached.insert(include.target).second) next.push_back(include.target);
        }
    }
    return reached;
}

} // namespace

TEST_CASE("every include between rooms follows an arrow of the house")
{
    const std::vector<SourceText> files = cpp_files(read_tree({"generator", "runtime"}));
    REQUIRE(files.size() > 30);
    CHECK(backward_includes(files, planned_arrows()) == std::vector<std::string>{});

    std::cout << "arrows (room: rooms that it includes)\n";
    for (const auto& [room, targets] : actual_arrows(files)) {
        std::cout << "  " << room << ":";
        for (const std::string& target : targets) std::cout << ' ' << target;
        std::cout << '\n';
    }
}

TEST_CASE("a backward include is found")
{
    const SourceText backward{"generator/graph/graph.cpp",
                              {"#include \"graph/graph.hpp\"", "#include \"model/model.hpp\""}};
    const SourceText runtime{
        "runtime/include/lagen/x.hpp",
        {"#include \"lagen/status.hpp\"", " # include \"emit/header.hpp\"", "#include \"lagen_run/driver.hpp\""}};
    const SourceText generator{"generator/emit/header.cpp", {"#include \"lagen/status.hpp\""}};
    CHECK(backward_includes({backward, runtime, generator}, planned_arrows()) ==
          std::vector<std::string>{"generator/graph/graph.cpp:2 includes \"model/model.hpp\" of model",
                                   "runtime/include/lagen/x.hpp:2 includes \"emit/header.hpp\" of emit",
                                   "runtime/include/lagen/x.hpp:3 includes \"lagen_run/driver.hpp\" of program",
                                   "generator/emit/header.cpp:1 includes \"lagen/status.hpp\" of runtime"});
}

TEST_CASE("every include between the folders of a room follows an arrow of the room")
{
    const std::vector<SourceText> files = cpp_files(read_tree({"generator"}));
    CHECK(backward_folder_includes(files) == std::vector<std::string>{});
    std::set<std::string> folders;
    for (const SourceText& file : files)
        if (const std::string folder = folder_of(file.path); !folder.empty()) folders.insert(folder);
    std::set<std::string> planned;
    for (const auto& [folder, targets] : planned_folder_arrows()) planned.insert(folder);
    CHECK(folders == planned);

    const SourceText backward{
        "generator/graph/core/graph.cpp",
        {"#include \"graph/core/graph.hpp\"", "#include \"graph/simplify/form.hpp\"", "#include \"diagnostic.hpp\""}};
    const SourceText forward{"generator/graph/kernel.hpp", {"#include \"graph/unknowns/implicit.hpp\""}};
    const SourceText other{"generator/emit/header.cpp", {"#include \"graph/kernel.hpp\""}};
    CHECK(backward_folder_includes({backward, forward, other}) ==
          std::vector<std::string>{"generator/graph/core/graph.cpp:2 includes \"graph/simplify/form.hpp\""});
}

TEST_CASE("the arrows of the house have no cycle")
{
    for (const Arrows& arrows : {planned_arrows(), planned_folder_arrows()})
        for (const auto& [room, targets] : arrows)
            for (const std::string& target : targets) CHECK_FALSE(reachable_rooms(arrows, target).contains(room));
}

TEST_CASE("commands call the rooms below, and include no header of the graph")
{
    for (const SourceText& file : cpp_files(read_tree({"generator/commands"})))
        for (const Include& include : includes_of(file)) {
            INFO(file.path << ":" << include.line);
            CHECK_FALSE(include.target.starts_with("graph/"));
        }
}

TEST_CASE("a library is known only to the rooms that stand on it")
{
    CHECK(misplaced_libraries(cpp_files(read_tree({"generator", "runtime"}))) == std::vector<std::string>{});
    const SourceText wrong{"generator/geometry/verify.cpp", {"#include <ginac/ginac.h>", "#include <vector>"}};
    CHECK(misplaced_libraries({wrong}) ==
          std::vector<std::string>{"generator/geometry/verify.cpp:1 includes ginac/ginac.h"});
}

TEST_CASE("the runtime includes nothing but itself, Eigen, the standard library and the compiler's own instructions")
{
    // Libraries that a chart compares with where they are installed.
    const std::set<std::string> peers{"odeint", "gsl", "sundials"};
    std::size_t own = 0;
    for (const SourceText& file : cpp_files(read_tree({"runtime"})))
        for (const Include& include : includes_of(file)) {
            INFO(file.path << ":" << include.line << " includes " << include.target);
            if (include.target == "lagen/that_is_all") continue; // no file: it ends a compilation that was refused
            if (include.quoted) {
                const bool program = include.target.starts_with("lagen_");
                CHECK(std::filesystem::exists(std::filesystem::path(LAGEN_SOURCE_DIR) /
                                              (program ? "runtime/program" : "runtime/include") / include.target));
                ++own;
            } else {
                const bool instructions = include.target == "immintrin.h" || include.target == "emmintrin.h" ||
                                          include.target == "arm_neon.h";
                const bool standard = include.target.find('.') == std::string::npos;
                const bool peer = file.path.starts_with("runtime/program/lagen_chart/") &&
                                  peers.contains(std::filesystem::path(file.path).stem().string());
                // What loads shared objects, and tells a damaged one.
                const bool loader =
                    file.path == "runtime/include/lagen/loaded_library.hpp" &&
                    (include.target == "dlfcn.h" || include.target == "elf.h" || include.target == "link.h");
                CHECK((include.target.starts_with("Eigen/") || standard || instructions || peer || loader));
            }
        }
    CHECK(own > 0);
}

TEST_CASE("a header of a method brings integrate(), and nothing that methods are made of knows a method")
{
    const std::vector<SourceText> files = cpp_files(read_tree({"runtime"}));
    const std::string run = "lagen/run.hpp", umbrella = "lagen/integrate.hpp";
    const std::set<std::string> no_methods{"lagen/ode.hpp", "lagen/print_status.hpp"};
    std::size_t methods = 0, parts = 0;
    for (const SourceText& file : files) {
        INFO(file.path);
        if (!file.path.starts_with("runtime/include/")) continue;
        const std::string header = file.path.substr(std::string("runtime/include/").size());
        for (const char* room : {"lagen/lanes/", "lagen/integrate/"})
            if (header.starts_with(room)) {
                CHECK_FALSE(reached_headers(files, header).contains(run));
                ++parts;
            }
        if (header == umbrella || header == "lagen/ensemble.hpp" || header == "lagen/lagen.hpp") continue;
        CHECK_FALSE(reached_headers(files, header).contains(umbrella));
    }
    for (const SourceText& file : files)
        if (file.path == "runtime/include/" + umbrella)
            for (const Include& include : includes_of(file)) {
                INFO(include.target);
                if (no_methods.contains(include.target)) continue;
                CHECK(reached_headers(files, include.target).contains(run));
                ++methods;
            }
    CHECK(methods > 10);
    CHECK(parts > 40);
}

TEST_CASE("the libraries of the build are linked along the arrows of the house")
{
    Arrows linked;
    for (const SourceText& text : read_tree({"generator"})) {
        if (text.path != "generator/CMakeLists.txt") continue;
        static const std::regex pattern(R"(^\s*lagen_room\((\w+)( DEPENDS(( \w+)+?))?( LIBRARIES .*)?\)\s*$)");
        for (const std::string& line : text.lines) {
            std::smatch match;
            if (!std::regex_match(line, match, pattern)) continue;
            std::istringstream names(match[3]);
            std::set<std::string>& targets = linked[match[1]];
            for (std::string name; names >> name;) targets.insert(name);
        }
    }
    REQUIRE(linked.size() == 23);
    for (const auto& [room, targets] : linked) {
        INFO(room);
        CHECK(planned_arrows().at(room) == targets);
    }
}
