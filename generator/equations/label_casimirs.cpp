// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/label_casimirs.hpp"

#include "expression/rewrite.hpp"

namespace lagen {
namespace {

/// An expansion keeps the place of the definition: what the user wrote out a second time stands elsewhere.
bool is_expansion(const Tree& tree, const Tree& value)
{
    const SourceRange& here = tree->where;
    const SourceRange& there = value->where;
    return there.file != nullptr && here.file == there.file && here.begin == there.begin && here.end == there.end &&
           same_tree(tree, value);
}

} // namespace

Tree label_casimirs(const Tree& tree, const std::vector<NamedTree>& casimirs)
{
    return rewrite(tree, [&](const Tree& node) {
        Tree label;
        for (const NamedTree& casimir : casimirs)
            if (is_expansion(node, casimir.value)) label = name(casimir.name, node->where);
        return label;
    });
}

} // namespace lagen
