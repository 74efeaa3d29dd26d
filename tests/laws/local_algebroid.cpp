// SPDX-License-Identifier: GPL-2.0-or-later
/// The constructions, each by its formula and with symbolic derivatives of formulas.
#include "local_algebroid.hpp"

#include <algorithm>

namespace lagen::laws {

LocalAlgebroid::LocalAlgebroid(std::vector<std::string> base_names, std::vector<std::string> fibre_names)
    : base(std::move(base_names)), fibre(std::move(fibre_names))
{
    rho.resize(n() * r());
    C.resize(r() * r() * r());
}

void LocalAlgebroid::set_bracket(std::size_t c, std::size_t a, std::size_t b, const Formula& value)
{
    C[(c * r() + a) * r() + b] = value;
    C[(c * r() + b) * r() + a] = -value;
}

Formula LocalAlgebroid::along(std::size_t a, const Formula& f) const
{
    Formula sum;
    for (std::size_t i = 0; i < n(); ++i)
        if (!anchor(i, a).is_zero()) sum = sum + anchor(i, a) * derivative(f, base[i]);
    return sum;
}

std::vector<std::string> numbered(const std::string& prefix, std::size_t count)
{
    std::vector<std::string> names;
    for (std::size_t k = 1; k <= count; ++k) names.push_back(prefix + std::to_string(k));
    return names;
}

LocalAlgebroid in_frame(const LocalAlgebroid& old, const Frame& frame)
{
    const std::size_t n = old.n(), r = old.r();
    LocalAlgebroid result = old;
    const auto A = [&](std::size_t a, std::size_t b) -> const Formula& { return frame.A[a * r + b]; };
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t a = 0; a < r; ++a) {
            Formula sum;
            for (std::size_t b = 0; b < r; ++b) sum = sum + A(a, b) * old.anchor(i, b);
            result.anchor(i, a) = sum;
        }
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = a + 1; b < r; ++b) {
            std::vector<Formula> inner(r);
            for (std::size_t d = 0; d < r; ++d) {
                inner[d] = result.along(a, A(b, d)) - result.along(b, A(a, d));
                for (std::size_t p = 0; p < r; ++p)
                    for (std::size_t q = 0; q < r; ++q)
                        if (p != q) inner[d] = inner[d] + A(a, p) * A(b, q) * old.bracket(d, p, q);
            }
            for (std::size_t c = 0; c < r; ++c) {
                Formula sum;
                for (std::size_t d = 0; d < r; ++d) sum = sum + frame.inverse[d * r + c] * inner[d];
                result.set_bracket(c, a, b, sum);
            }
        }
    return result;
}

LocalAlgebroid in_coordinate(const LocalAlgebroid& old, std::size_t i, const Formula& forward, const Formula& backward)
{
    LocalAlgebroid result = old;
    for (std::size_t a = 0; a < old.r(); ++a) result.anchor(i, a) = old.along(a, forward);
    const std::map<std::string, Formula> values{{old.base[i], backward}};
    for (std::vector<Formula>* list : {&result.rho, &result.C, &result.constraints, &result.positive})
        for (Formula& entry : *list) entry = substitute(entry, values);
    return result;
}

LocalAlgebroid direct_product(const LocalAlgebroid& one, const LocalAlgebroid& two)
{
    LocalAlgebroid result(numbered("x", one.n() + two.n()), numbered("e", one.r() + two.r()));
    for (const LocalAlgebroid* factor : {&one, &two}) {
        const std::size_t shift = factor == &two ? one.n() : 0, shift_e = factor == &two ? one.r() : 0;
        std::map<std::string, Formula> names;
        for (std::size_t i = 0; i < factor->n(); ++i) names.emplace(factor->base[i], result.coordinate(shift + i));
        for (std::size_t i = 0; i < factor->n(); ++i)
            for (std::size_t a = 0; a < factor->r(); ++a)
                result.anchor(shift + i, shift_e + a) = substitute(factor->anchor(i, a), names);
        for (std::size_t a = 0; a < factor->r(); ++a)
            for (std::size_t b = a + 1; b < factor->r(); ++b)
                for (std::size_t c = 0; c < factor->r(); ++c)
                    result.set_bracket(shift_e + c, shift_e + a, shift_e + b,
                                       substitute(factor->bracket(c, a, b), names));
        for (const Formula& h : factor->constraints) result.constraints.push_back(substitute(h, names));
        for (const Formula& g : factor->positive) result.positive.push_back(substitute(g, names));
        for (const SolvedCoordinate& s : factor->solved)
            result.solved.push_back({names.at(s.coordinate).text(), substitute(s.value, names), s.either_sign});
    }
    result.parameters = one.parameters;
    for (const std::string& name : two.parameters)
        if (std::find(result.parameters.begin(), result.parameters.end(), name) == result.parameters.end())
            result.parameters.push_back(name);
    return result;
}

LocalAlgebroid prolongation(const LocalAlgebroid& old, bool dual)
{
    std::vector<std::string> base = old.base, fibre;
    for (const std::string& name : old.fibre) base.push_back((dual ? "p_" : "") + name);
    for (const std::string& name : old.fibre) fibre.push_back("X_" + name);
    for (const std::string& name : old.fibre) fibre.push_back((dual ? "P_" : "V_") + name);
    LocalAlgebroid result(base, fibre);
    result.parameters = old.parameters;
    result.constraints = old.constraints;
    result.solved = old.solved;
    result.positive = old.positive;
    for (std::size_t a = 0; a < old.r(); ++a) {
        for (std::size_t i = 0; i < old.n(); ++i) result.anchor(i, a) = old.anchor(i, a);
        result.anchor(old.n() + a, old.r() + a) = 1;
        for (std::size_t b = a + 1; b < old.r(); ++b)
            for (std::size_t c = 0; c < old.r(); ++c) result.set_bracket(c, a, b, old.bracket(c, a, b));
    }
    return result;
}

LocalAlgebroid atiyah(const LocalAlgebroid& structure, const std::vector<std::string>& base,
                      const std::vector<Formula>& connection)
{
    const std::size_t n = base.size(), s = structure.r();
    LocalAlgebroid result(base, numbered("e", n + s));
    const auto A = [&](std::size_t i, std::size_t c) -> const Formula& { return connection[i * s + c]; };
    for (std::size_t i = 0; i < n; ++i) {
        result.anchor(i, i) = 1;
        for (std::size_t j = i + 1; j < n; ++j)
            for (std::size_t c = 0; c < s; ++c) {
                Formula curvature = derivative(A(j, c), base[i]) - derivative(A(i, c), base[j]);
                for (std::size_t a = 0; a < s; ++a)
                    for (std::size_t b = 0; b < s; ++b)
                        curvature = curvature - A(i, a) * A(j, b) * structure.bracket(c, a, b);
                result.set_bracket(n + c, i, j, -curvature);
            }
        for (std::size_t b = 0; b < s; ++b)
            for (std::size_t c = 0; c < s; ++c) {
                Formula sum;
                for (std::size_t a = 0; a < s; ++a) sum = sum - A(i, a) * structure.bracket(c, a, b);
                result.set_bracket(n + c, i, n + b, sum);
            }
    }
    for (std::size_t a = 0; a < s; ++a)
        for (std::size_t b = a + 1; b < s; ++b)
            for (std::size_t c = 0; c < s; ++c) result.set_bracket(n + c, n + a, n + b, structure.bracket(c, a, b));
    return result;
}

} // namespace lagen::laws
