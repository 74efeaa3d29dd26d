// SPDX-License-Identifier: GPL-2.0-or-later
/// Symbols that stand for longer expressions in derived equations: definitions of the model, their partial derivatives,
/// and other long terms. A derivative of what is written in them is a total one, by the chain rule.
#pragma once

#include "expression/tree_identity.hpp"
#include "model/model.hpp"
#include "symbolic/ginac_door.hpp"
#include "typeset/equation_set.hpp"

#include <exception>
#include <functional>
#include <optional>
#include <set>

namespace lagen {

/// How a derivation treats the definitions of the model.
enum class Definitions {
    expanded, ///< all are written out in coordinates and parameters
    kept,     ///< those that pay for their names stay symbols, where the derivation can
};

/// Which definitions stay symbols.
struct DefinitionChoice {
    bool kept = false;                       ///< false: none, everything is written out in coordinates and parameters
    std::set<std::string> dropped = {};      ///< names that are written out all the same
    std::size_t longest = std::string::npos; ///< characters of equations, above which the derivation is given up
};

/// A derivation throws this that would need more names than anybody reads, or grows above its `longest`.
class TooMuchToRead : public std::exception {};

/// `derivation` with the definitions that pay for their names: those that stand twice in one block or three times in
/// all, or are long. Others are written out; so are those made of sines and cosines where that leaves less than two
/// thirds, and all where that is shorter than a long form with symbols or the derivation does not go through with them.
[[nodiscard]] EquationSet with_definitions(const Model& model, Definitions definitions,
                                           const std::function<EquationSet(const DefinitionChoice&)>& derivation);

/// Nodes of a tree when it is written out, counted to some thousand.
[[nodiscard]] std::size_t written_nodes(const Tree& tree);

/// Every tree of a block.
void for_each_tree(const EquationBlock& block, const std::function<void(const Tree&)>& visit);

/// True where the operation of the node is not differentiated: a comparison, a selection, a function with kinks or
/// jumps.
[[nodiscard]] bool is_rough(const TreeNode& node);

class KeptSymbols {
  public:
    /// Definitions that depend on a name in `substituted` are written out: the derivation replaces it. `prepared` is
    /// what lowering does to a tree first. Keeps references.
    KeptSymbols(const Model& model, const DefinitionChoice& choice, const std::set<std::string>& substituted,
                std::function<Tree(const Tree&)> prepared, SymbolTable& symbols, Order& order);

    [[nodiscard]] bool declares(const std::string& name) const { return index_.contains(name); }

    /// The tree with names for what is equal to a definition.
    [[nodiscard]] Tree folded(const Tree& tree);
    /// df/dsymbol
    [[nodiscard]] GiNaC::ex derivative(const GiNaC::ex& f, const GiNaC::ex& symbol);
    /// y^a df/dy^a; of a symbol that is homogeneous of degree k in y it is k times the symbol.
    [[nodiscard]] GiNaC::ex along_fibre(const GiNaC::ex& f, const GiNaC::exvector& y);
    [[nodiscard]] bool depends_on(const GiNaC::ex& f, const GiNaC::ex& symbol);
    /// A function in the shorter of two forms: as it is, or with definitions that move with `moving` written out and
    /// the coefficients of these in terms of those that do not: I w^2/2 for (J + m a^2) w^2/2 where I = J + m a^2.
    [[nodiscard]] GiNaC::ex reduced(const GiNaC::ex& whole, const GiNaC::exvector& moving);
    /// True where it is plainly zero when all symbols are written out.
    [[nodiscard]] bool vanishes(GiNaC::ex f);
    /// A symbol for `value` where that is long, else `value`.
    [[nodiscard]] GiNaC::ex named(const std::string& name, const GiNaC::ex& value);

    /// The values of the symbols in `equations`, and of those in these.
    [[nodiscard]] std::vector<WhereEntry> where(const EquationSet& equations);
    /// LaTeX of derivatives by symbols that have one.
    void append_latex(EquationSet& equations) const;

  private:
    struct Kept {
        std::string stem, index;     ///< name = stem + index
        std::size_t family = 1;      ///< entries of its vector
        std::size_t root = 0;        ///< the definition that it is a derivative of, else itself
        std::vector<std::string> by; ///< what this one is derived by
        Tree tree;                   ///< of a definition
        std::optional<GiNaC::ex> value;
        GiNaC::ex symbol;
        std::string behind;    ///< where it stands in the order of terms
        bool of_points = true; ///< depends on points of the base, time and parameters alone

        [[nodiscard]] std::string name() const { return stem + index; }
    };

    void take_definitions(const std::set<std::string>& substituted);
    void append(Kept kept);
    [[nodiscard]] Tree name_of(const Tree& tree, std::optional<std::size_t> own);
    [[nodiscard]] std::vector<std::size_t> symbols_in(const GiNaC::ex& f) const;
    [[nodiscard]] GiNaC::ex value_of(std::size_t k);
    [[nodiscard]] GiNaC::ex rate(std::size_t k, const GiNaC::ex& symbol);
    [[nodiscard]] const Tree& slope_of(std::size_t k, const GiNaC::ex& symbol);
    [[nodiscard]] bool has_long_slope(std::size_t k, const GiNaC::ex& symbol);
    [[nodiscard]] std::optional<GiNaC::ex> known_as(const GiNaC::ex& value);
    [[nodiscard]] GiNaC::ex along_fibre(std::size_t k, const GiNaC::exvector& y);
    [[nodiscard]] std::vector<std::pair<GiNaC::ex, GiNaC::ex>> pivots();
    [[nodiscard]] GiNaC::ex without_moving(GiNaC::ex f);
    [[nodiscard]] GiNaC::ex without_parts(GiNaC::ex f);
    [[nodiscard]] GiNaC::ex shortened(GiNaC::ex sum, const std::vector<std::pair<GiNaC::ex, GiNaC::ex>>& rules) const;
    [[nodiscard]] std::size_t cost_of(const GiNaC::ex& f) const;
    [[nodiscard]] std::size_t cost_with_definitions(const GiNaC::ex& f);
    [[nodiscard]] std::string free_stem(std::string stem, const std::string& index) const;

    const Model& model_;
    DefinitionChoice choice_;
    std::function<Tree(const Tree&)> prepared_;
    SymbolTable& symbols_;
    Order& order_;
    TreeIdentity identity_;
    std::vector<Kept> kept_;
    std::map<std::string, std::size_t> index_;       ///< by name
    std::map<std::size_t, std::size_t> by_tree_;     ///< by the number of the definition's tree
    std::map<std::size_t, std::size_t> by_negative_; ///< by that of what the definition is -1 times
    std::map<std::string, GiNaC::ex> rates_;         ///< by root and symbols
    std::map<std::pair<std::size_t, std::string>, Tree> slopes_;
    std::map<std::size_t, GiNaC::ex> along_fibre_;
    std::size_t derivatives_ = 0; ///< that have names
};

} // namespace lagen
