// SPDX-License-Identifier: GPL-2.0-or-later
/// The source tree as the house rules see it: files with their lines, includes and rooms.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace lagen::house {

struct Include {
    std::string target; ///< as written between the quotes or brackets
    bool quoted = false;
    std::size_t line = 0; ///< counted from 1
};

struct SourceText {
    std::string path; ///< relative to the source tree, with '/'
    std::vector<std::string> lines;
};

/// The text files below `folders` of the source tree (and, with "", the files at its top), sorted by path.
[[nodiscard]] std::vector<SourceText> read_tree(const std::vector<std::string>& folders);

/// C++ files (.hpp, .cpp) among `texts`.
[[nodiscard]] std::vector<SourceText> cpp_files(const std::vector<SourceText>& texts);

/// Every #include of a file, in order.
[[nodiscard]] std::vector<Include> includes_of(const SourceText& text);

/// "generator/graph/graph.hpp" is in room "graph", "generator/pipeline.cpp" in "pipeline", "generator/lagen.cpp" in
/// "commands", "runtime/..." in "runtime".
[[nodiscard]] std::string room_of(const std::string& path);

/// A room and the rooms that it may include directly.
using Arrows = std::map<std::string, std::set<std::string>>;

/// The arrows of the house (README, "The house").
[[nodiscard]] const Arrows& planned_arrows();

/// The arrows between the folders of a room that has some; the room's own name stands for the files beside these.
[[nodiscard]] const Arrows& planned_folder_arrows();

/// "generator/graph/core/graph.hpp" is in "graph/core", "generator/graph/kernel.hpp" in "graph"; empty for a file of a
/// room without folders.
[[nodiscard]] std::string folder_of(const std::string& path);

/// The rooms that `room` may include: itself and what its arrows reach.
[[nodiscard]] std::set<std::string> reachable_rooms(const Arrows& arrows, const std::string& room);

} // namespace lagen::house
