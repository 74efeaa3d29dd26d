// SPDX-License-Identifier: GPL-2.0-or-later
/// How long a fraction becomes over its common denominator.
#include "symbolic/shortest_form.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace lagen {
namespace {

constexpr double most_fraction_terms = 2000; ///< of numerator and denominator together

/// A bound of the number of terms of numerator and denominator over a common denominator, before anything cancels.
struct FractionTerms {
    double above = 1;
    std::map<GiNaC::ex, std::pair<double, int>, GiNaC::ex_is_less> below; ///< terms and exponent of each divisor

    void multiply_below(const GiNaC::ex& divisor, double terms, int exponent)
    {
        below.try_emplace(divisor, terms, 0).first->second.second += exponent;
    }
    [[nodiscard]] double total() const
    {
        double product = 1;
        for (const auto& [divisor, power] : below) product *= std::pow(power.first, power.second);
        return above + product;
    }
};

FractionTerms fraction_terms(const GiNaC::ex& e)
{
    FractionTerms result;
    if (GiNaC::is_a<GiNaC::add>(e)) {
        std::vector<FractionTerms> parts;
        for (std::size_t k = 0; k < e.nops(); ++k) {
            parts.push_back(fraction_terms(e.op(k)));
            for (const auto& [divisor, power] : parts.back().below) {
                auto& common = result.below.try_emplace(divisor, power).first->second;
                common.second = std::max(common.second, power.second);
            }
        }
        result.above = 0;
        for (const FractionTerms& part : parts) {
            double terms = part.above;
            for (const auto& [divisor, power] : result.below) {
                const auto own = part.below.find(divisor);
                terms *= std::pow(power.first, power.second - (own == part.below.end() ? 0 : own->second.second));
            }
            result.above += terms;
        }
    } else if (GiNaC::is_a<GiNaC::mul>(e)) {
        for (std::size_t k = 0; k < e.nops(); ++k) {
            const FractionTerms part = fraction_terms(e.op(k));
            result.above *= part.above;
            for (const auto& [divisor, power] : part.below) result.multiply_below(divisor, power.first, power.second);
        }
    } else if (GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::integer)) {
        const FractionTerms base = fraction_terms(e.op(0));
        const int exponent = GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_int();
        for (const auto& [divisor, power] : base.below) {
            if (exponent > 0)
                result.multiply_below(divisor, power.first, exponent * power.second);
            else
                result.above *= std::pow(power.first, -exponent * power.second);
        }
        if (exponent > 0)
            result.above *= std::pow(base.above, exponent);
        else
            result.multiply_below(e.op(0), base.above, -exponent);
    }
    return result;
}

} // namespace

bool has_short_fraction(const GiNaC::ex& expression)
{
    return fraction_terms(expression).total() <= most_fraction_terms;
}

} // namespace lagen
