// SPDX-License-Identifier: GPL-2.0-or-later
/// Equations of models as they are written, compared with their components in numbers.
#pragma once

#include "elaborate/make_frame.hpp"
#include "equations/written_meaning.hpp"
#include "model/read_model.hpp"
#include "model/scene_form.hpp"
#include "support/model_equations.hpp"
#include "typeset/print_equations.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace lagen {

inline EquationSet kept_equations(Model model, std::string form = {})
{
    if (form.empty()) form = default_form(model);
    const System system = elaborate(model);
    return with_written_blocks(derive(form, model, system, verify(system), {}, Definitions::kept), model);
}

inline EquationSet of_file(const std::string& path)
{
    return kept_equations(read_model(LAGEN_SOURCE_DIR "/" + path, {}, choosers()));
}

inline EquationSet of_text(const std::string& text)
{
    return kept_equations(read_model_text("test.toml", text));
}

/// Blocks that are written otherwise than by components; each says the same.
inline std::size_t checked_blocks(const EquationSet& set)
{
    std::size_t blocks = 0;
    const auto compare = [&](const std::vector<Equation>& equations, const std::vector<Equation>& written) {
        ++blocks;
        CHECK(written.size() <= equations.size());
        const std::vector<long double> expected = WrittenMeaning(set).values(equations);
        const std::vector<long double> found = WrittenMeaning(set).values(written);
        REQUIRE(found.size() == expected.size());
        for (std::size_t k = 0; k < found.size(); ++k)
            CHECK((std::abs(found[k] - expected[k]) <= 1e-13L * (1 + std::abs(expected[k])) ||
                   (std::isnan(found[k]) && std::isnan(expected[k]))));
    };
    for (const auto* list : {&set.given, &set.blocks})
        for (const EquationBlock& block : *list) {
            if (block.written.empty()) continue;
            INFO(set.model << ", " << block.title);
            compare(block.equations, block.written);
        }
    if (set.written_where.empty()) return blocks;
    INFO(set.model << ", where");
    std::vector<Equation> where;
    for (const WhereEntry& entry : set.where)
        where.push_back({LeftSide::symbol, entry.symbol, {}, {{"", entry.value}}});
    compare(where, set.written_where);
    return blocks;
}

inline std::string block_text(const EquationSet& set, const std::string& title)
{
    const std::string text = print_text(set) + "\n";
    const std::size_t begin = text.find("\n" + title + ":");
    REQUIRE(begin != std::string::npos);
    const std::size_t line = text.find('\n', begin + 1) + 1;
    return text.substr(line, text.find("\n\n", line) + 1 - line);
}

} // namespace lagen
