// SPDX-License-Identifier: GPL-2.0-or-later
/// Bases of the named Lie algebras, in the order of docs/algebroids.md, and their commutators.
#include "geometry/named_algebra.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace lagen {
namespace {

using Position = std::pair<std::size_t, std::size_t>;
using MatrixMap = std::map<Position, Rational>;

SparseMatrix matrix(std::initializer_list<MatrixEntry> entries)
{
    SparseMatrix result(entries);
    std::sort(result.begin(), result.end(), [](const MatrixEntry& a, const MatrixEntry& b) {
        return std::pair(a.row, a.column) < std::pair(b.row, b.column);
    });
    return result;
}

/// target += sign * A B
void add_product(MatrixMap& target, const SparseMatrix& a, const SparseMatrix& b, int sign)
{
    for (const MatrixEntry& left : a)
        for (const MatrixEntry& right : b)
            if (left.column == right.row) target[{left.row, right.column}] += sign * left.value * right.value;
}

/// E_ij - E_ji with i < j: lexicographic basis of so(n).
NamedAlgebra so_lexicographic(std::size_t n)
{
    NamedAlgebra algebra{"so(" + std::to_string(n) + ")", n, {}, {}};
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j) algebra.basis.push_back(matrix({{j, i, 1}, {i, j, -1}}));
    return algebra;
}

/// hat(e_a) v = e_a x v, in the upper left corner of a matrix of `size`.
std::vector<SparseMatrix> hats()
{
    return {matrix({{2, 1, 1}, {1, 2, -1}}), matrix({{0, 2, 1}, {2, 0, -1}}), matrix({{1, 0, 1}, {0, 1, -1}})};
}

NamedAlgebra so3()
{
    return {"so(3)", 3, hats(), {}};
}

/// Left multiplication by i/2, j/2, k/2 on quaternions (w, x, y, z).
NamedAlgebra su2()
{
    const Rational h(1, 2);
    const Rational m(-1, 2);
    return {"su(2)",
            4,
            {matrix({{1, 0, h}, {0, 1, m}, {3, 2, h}, {2, 3, m}}), matrix({{2, 0, h}, {3, 1, m}, {0, 2, m}, {1, 3, h}}),
             matrix({{3, 0, h}, {2, 1, h}, {1, 2, m}, {0, 3, m}})},
            {}};
}

NamedAlgebra se2()
{
    return {"se(2)", 3, {matrix({{1, 0, 1}, {0, 1, -1}}), matrix({{0, 2, 1}}), matrix({{1, 2, 1}})}, {}};
}

NamedAlgebra se3()
{
    NamedAlgebra algebra{"se(3)", 4, hats(), {}};
    for (std::size_t i = 0; i < 3; ++i) algebra.basis.push_back(matrix({{i, 3, 1}}));
    return algebra;
}

NamedAlgebra so21()
{
    return {"so(2,1)",
            3,
            {matrix({{0, 2, 1}, {2, 0, 1}}), matrix({{1, 2, 1}, {2, 1, 1}}), matrix({{1, 0, 1}, {0, 1, -1}})},
            {}};
}

NamedAlgebra sl2()
{
    return {"sl(2)", 2, {matrix({{0, 0, 1}, {1, 1, -1}}), matrix({{0, 1, 1}}), matrix({{1, 0, 1}})}, {}};
}

NamedAlgebra heis3()
{
    return {"heis(3)", 3, {matrix({{0, 1, 1}}), matrix({{1, 2, 1}}), matrix({{0, 2, 1}})}, {}};
}

NamedAlgebra aff1()
{
    return {"aff(1)", 2, {matrix({{0, 0, 1}}), matrix({{0, 1, 1}})}, {}};
}

NamedAlgebra gl(std::size_t n)
{
    NamedAlgebra algebra{"gl(" + std::to_string(n) + ")", n, {}, {}};
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) algebra.basis.push_back(matrix({{i, j, 1}}));
    return algebra;
}

NamedAlgebra translations(std::size_t n)
{
    NamedAlgebra algebra{"R^" + std::to_string(n), n + 1, {}, {}};
    for (std::size_t i = 0; i < n; ++i) algebra.basis.push_back(matrix({{i, n, 1}}));
    return algebra;
}

/// Supports of the basis matrices are disjoint in every algebra above, so the coefficient of E_c is read off at its
/// first entry; the rest of the commutator is checked to agree.
void compute_constants(NamedAlgebra& algebra)
{
    std::map<Position, std::pair<std::size_t, const MatrixEntry*>> owner;
    for (std::size_t c = 0; c < algebra.basis.size(); ++c)
        for (const MatrixEntry& entry : algebra.basis[c]) owner[{entry.row, entry.column}] = {c, &entry};
    for (std::size_t a = 0; a < algebra.basis.size(); ++a) {
        for (std::size_t b = a + 1; b < algebra.basis.size(); ++b) {
            MatrixMap commutator;
            add_product(commutator, algebra.basis[a], algebra.basis[b], 1);
            add_product(commutator, algebra.basis[b], algebra.basis[a], -1);
            std::map<std::size_t, Rational> coefficients;
            for (const auto& [position, value] : commutator) {
                if (value == 0) continue;
                const auto found = owner.find(position);
                if (found == owner.end()) throw InternalError("the commutators of " + algebra.name + " leave its span");
                const Rational coefficient = value / found->second.second->value;
                const auto [slot, fresh] = coefficients.emplace(found->second.first, coefficient);
                if (!fresh && slot->second != coefficient)
                    throw InternalError("the commutators of " + algebra.name + " leave its span");
            }
            for (const auto& [c, value] : coefficients) algebra.constants.push_back({a, b, c, value});
        }
    }
}

/// The integer in "prefix17suffix", or nothing. At most three digits: larger ranks are beyond the limit anyway.
std::optional<std::size_t> size_between(std::string_view text, std::string_view prefix, std::string_view suffix)
{
    if (text.size() <= prefix.size() + suffix.size() || !text.starts_with(prefix) || !text.ends_with(suffix)) return {};
    const std::string_view digits = text.substr(prefix.size(), text.size() - prefix.size() - suffix.size());
    const bool plain = std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!plain || digits.size() > 3 || digits.front() == '0') return {};
    std::size_t value = 0;
    for (const char c : digits) value = 10 * value + static_cast<std::size_t>(c - '0');
    return value;
}

std::optional<NamedAlgebra> summand(const std::string& text)
{
    static constexpr std::pair<const char*, NamedAlgebra (*)()> fixed[] = {
        {"so(3)", so3},    {"su(2)", su2}, {"se(2)", se2},     {"se(3)", se3},
        {"so(2,1)", so21}, {"sl(2)", sl2}, {"heis(3)", heis3}, {"aff(1)", aff1}};
    for (const auto& [spelling, make] : fixed)
        if (text == spelling) return make();
    const auto so = size_between(text, "so(", ")");
    if (so && *so >= 2 && *so * (*so - 1) / 2 <= named_algebra_rank_limit) return so_lexicographic(*so);
    const auto general = size_between(text, "gl(", ")");
    if (general && *general * *general <= named_algebra_rank_limit) return gl(*general);
    const auto space = text == "R" ? std::optional<std::size_t>(1) : size_between(text, "R^", "");
    if (space && *space <= named_algebra_rank_limit) return translations(*space);
    return {};
}

/// Block diagonal: the matrices and constants of `other` follow those of `algebra`.
void append_summand(NamedAlgebra& algebra, const NamedAlgebra& other)
{
    const std::size_t shift = algebra.basis.size();
    for (SparseMatrix block : other.basis) {
        for (MatrixEntry& entry : block) {
            entry.row += algebra.size;
            entry.column += algebra.size;
        }
        algebra.basis.push_back(std::move(block));
    }
    for (const StructureConstant& entry : other.constants)
        algebra.constants.push_back({entry.a + shift, entry.b + shift, entry.c + shift, entry.value});
    algebra.size += other.size;
    algebra.name += (algebra.name.empty() ? "" : " + ") + other.name;
}

} // namespace

std::optional<NamedAlgebra> named_algebra(std::string_view name)
{
    std::string compact;
    for (const char c : name)
        if (c != ' ') compact += c;
    NamedAlgebra result;
    for (std::size_t begin = 0; begin <= compact.size();) {
        const std::size_t end = std::min(compact.find('+', begin), compact.size());
        std::optional<NamedAlgebra> part = summand(compact.substr(begin, end - begin));
        if (!part || result.basis.size() + part->basis.size() > named_algebra_rank_limit) return {};
        compute_constants(*part);
        append_summand(result, *part);
        begin = end + 1;
    }
    return result;
}

const std::vector<std::string>& named_algebra_names()
{
    static const std::vector<std::string> names = {"so(3)",   "su(2)",  "se(2)", "se(3)", "so(2,1)", "sl(2)",
                                                   "heis(3)", "aff(1)", "so(4)", "gl(2)", "R^2"};
    return names;
}

std::optional<NamedAlgebra> algebra_of_group(std::string_view name)
{
    std::string spelled;
    for (const char c : name) {
        if (c >= 'a' && c <= 'z') return {}; // that is the name of an algebra
        spelled += c >= 'A' && c <= 'Z' && c != 'R' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return named_algebra(spelled);
}

const std::vector<std::string>& named_group_names()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> capitals = named_algebra_names();
        for (std::string& name : capitals)
            for (char& c : name)
                if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
        return capitals;
    }();
    return names;
}

std::vector<Rational> dense(const SparseMatrix& matrix, std::size_t size)
{
    std::vector<Rational> entries(size * size);
    for (const MatrixEntry& entry : matrix) entries[entry.row * size + entry.column] = entry.value;
    return entries;
}

} // namespace lagen
