// SPDX-License-Identifier: GPL-2.0-or-later
/// The doors between closed trees and GiNaC. GiNaC orders terms and chooses signs by hashes of addresses, so what comes
/// back is sorted by content and its signs are chosen anew: the content-first term of a sum is positive, -1 is pulled
/// out through products, integer powers, even and odd functions. Equal expressions come back as the same text on every
/// run. GiNaC counts references without atomics: one thread only.
#pragma once

#include "expression/tree.hpp"

#include <ginac/ginac.h>

#include <map>
#include <new>

namespace lagen {

/// Names and their GiNaC symbols, all real.
class SymbolTable {
  public:
    /// The symbol called `name`, made at its first use.
    GiNaC::realsymbol symbol(const std::string& name);
    /// The name of a symbol of this table; InternalError for any other.
    [[nodiscard]] const std::string& name_of(const GiNaC::symbol& symbol) const;

  private:
    std::map<std::string, GiNaC::realsymbol> symbols_;
    std::map<GiNaC::ex, std::string, GiNaC::ex_is_less> names_; ///< looked up, never iterated: its order is GiNaC's
};

/// The order in which names are written: parameters stand before variables in a product, each as declared.
struct Order {
    std::vector<std::string> parameters;
    std::vector<std::string> variables;
};

/// What a tree may cost when it is written out without sharing.
inline constexpr std::size_t symbolic_size_limit = 50'000;

/// What `work` gives. GiNaC reports poles, functions that it does not have and sizes that it cannot hold by
/// std::exceptions of many kinds: each becomes a MathematicsError, "`failure`: " and its text.
template <class Work>
auto with_ginac(const std::string& failure, const Work& work)
{
    try {
        return work();
    } catch (const Error&) { // says itself what is wrong
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw MathematicsError(failure + ": " + error.what());
    }
}

/// A closed, smooth tree in GiNaC. Throws MathematicsError where it has more than `symbolic_size_limit` nodes without
/// sharing, where it has a function or comparison that is not smooth, and where GiNaC finds a pole (division by zero).
[[nodiscard]] GiNaC::ex to_ginac(const Tree& tree, SymbolTable& symbols);

/// The tree of a real expression. Throws MathematicsError where the expression holds a number that is not a real
/// rational.
[[nodiscard]] Tree from_ginac(const GiNaC::ex& expression, const SymbolTable& symbols, const Order& order);

} // namespace lagen
