// SPDX-License-Identifier: GPL-2.0-or-later
/// One name, one type: two types of the same name in one namespace are one type to the linker, which keeps one of their
/// destructors and one of their vectors, whichever comes first.
#include "source_tree.hpp"

#include <catch2/catch.hpp>

#include <map>
#include <regex>
#include <set>

using namespace lagen::house;

namespace {

std::string joined(const std::vector<std::string>& parts)
{
    std::string text;
    for (const std::string& part : parts) text += part + "::";
    return text;
}

/// Appends path to each type that is defined outside of anonymous namespaces, by its full name.
void collect_types(const SourceText& text, std::map<std::string, std::set<std::string>>& types)
{
    static const std::regex opening(R"(^(?:inline )?namespace ?([\w:]*) ?\{.*)");
    static const std::regex definition(
        R"(^(?:struct|class|enum class|enum) (?:\[\[nodiscard\]\] )?(\w+)(?: final)?(?: ?(?::[^:]|\{).*)?$)");
    std::vector<std::string> spaces;
    for (const std::string& line : text.lines) {
        std::smatch match;
        if (line.starts_with("} // namespace")) {
            if (!spaces.empty()) spaces.pop_back();
        } else if (std::regex_match(line, match, opening)) {
            spaces.push_back(match[1].length() > 0 ? match[1].str() : "(anonymous)");
        } else if (std::regex_match(line, match, definition) &&
                   joined(spaces).find("(anonymous)") == std::string::npos) {
            types[joined(spaces) + match[1].str()].insert(text.path);
        }
    }
}

} // namespace

TEST_CASE("no two types of the generator have the same name")
{
    std::map<std::string, std::set<std::string>> types;
    for (const SourceText& text : read_tree({"generator"}))
        if (text.path.ends_with(".hpp") || text.path.ends_with(".cpp")) collect_types(text, types);
    CHECK(types.contains("lagen::Graph"));
    CHECK(types.contains("lagen::proof::Ring"));
    CHECK(types.size() > 150);
    for (const auto& [name, files] : types) {
        INFO(name << " in " << *files.begin() << " and " << *files.rbegin());
        CHECK(files.size() == 1);
    }
}
