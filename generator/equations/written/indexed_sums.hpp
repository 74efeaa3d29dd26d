// SPDX-License-Identifier: GPL-2.0-or-later
/// Sums of terms that differ by an index of families, written once: m[1] v[1]^2/2 + m[2] v[2]^2/2 + .. is
/// sum_i m[i] v[i]^2/2; also over pairs, without one value of the index, and inside other terms.
#pragma once

#include "equations/written/index_shape.hpp"
#include "equations/written/term_keys.hpp"

namespace lagen {

class SumWriting {
  public:
    /// `names` are all that there are: no index runs on to others.
    explicit SumWriting(std::set<std::string> names) : names_(std::move(names)) {}

    /// From here on some guesses are made, whatever those before have cost.
    void begin_equation();

    /// Every sum in the tree with what can be joined joined, even two terms; finished() writes out again what is no
    /// shorter. Letters are "#1", "#2", .., of an inner sum smaller than of the one around it. Every sum that is
    /// written is tried: at each value of its index its terms are some of the given ones, and each is taken once.
    Tree joined(const Tree& tree);
    std::vector<Tree> joined_terms(std::vector<Tree> terms);

    /// Sums without the terms at their ends that are 0 or have no value, and with constant factors in front; written
    /// out where that is not much longer.
    Tree finished(const Tree& tree);

    TermKeys& keys() { return keys_; }
    [[nodiscard]] bool knows_names(const Tree& tree) const;

  private:
    struct Item {
        Tree tree;
        Keys keys;
    };
    struct Candidate {
        Tree sum;
        Keys keys;
        std::size_t members = 0;
    };
    /// A pattern is one of these at a value of its letter.
    enum class Instance { term, zero, other, no_value, no_names };

    std::vector<IndexPattern> patterns_of(const std::vector<Item>& items, bool from_one);
    std::optional<Candidate> extended(const IndexPattern& pattern, const Keys& available);
    Instance try_at(const IndexPattern& pattern, long value, const Keys& available, Keys& taken);
    static bool replace(std::vector<Item>& items, const Candidate& candidate);

    std::set<std::string> names_;
    TermKeys keys_;
    std::size_t in_vain_ = 0; ///< characters that were expanded for guesses that failed, less what others were worth
};

} // namespace lagen
