// SPDX-License-Identifier: GPL-2.0-or-later
/// What scripts/cross compiles for a processor with floats alone: kernels in float, which must call no operation of
/// doubles.
#include "cart_pole.hpp"
#include "double_pendulum.hpp"
#include "heavy_top.hpp"
#include "kepler.hpp"
#include "snakeboard.hpp"

namespace lagen {

template <class M>
int compute(const M& model, const typename M::State& s, typename M::State& ds,
            std::array<float, M::jacobian_rows.size()>& values, TaylorSeries<float, M::dimension, 12>& series)
{
    if (model.rhs(0, s, ds) != Status::ok) return 1;
    model.jacobian_values(0, s, values);
    return model.taylor(0, s, 12, series) == Status::ok ? 0 : 1;
}

template <class M>
using Computed = int(const M&, const typename M::State&, typename M::State&,
                     std::array<float, M::jacobian_rows.size()>&, TaylorSeries<float, M::dimension, 12>&);

extern Computed<models::heavy_top<float>>* const heavy_top = &compute<models::heavy_top<float>>;
extern Computed<models::double_pendulum<float>>* const double_pendulum = &compute<models::double_pendulum<float>>;
extern Computed<models::kepler<float>>* const kepler = &compute<models::kepler<float>>;
extern Computed<models::snakeboard<float>>* const snakeboard = &compute<models::snakeboard<float>>;
extern Computed<models::cart_pole<float>>* const cart_pole = &compute<models::cart_pole<float>>;

} // namespace lagen
