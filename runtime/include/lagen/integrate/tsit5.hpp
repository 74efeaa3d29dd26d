// SPDX-License-Identifier: MIT
/// `lagen::Tsit5{.tolerance = 1e-8}`: the pair 5(4) of Tsitouras [Comput. Math. Appl. 62 (2011) 770] with its free
/// interpolant of order 4. The coefficients are roots of the order conditions (40 digits), the interpolant's are
/// published to 16 to 20 digits.
#pragma once

#include "lagen/integrate/embedded.hpp"

namespace lagen {

namespace tableau {

struct Tsit5 {
    static constexpr std::size_t stages = 7;
    static constexpr int order = 5;
    // clang-format off
    static constexpr std::array<Decimal, 21> a{{
        {0.161L},
        {-0.8480655492356988544426874250230774675e-2L}, {0.3354806554923569885444268742502307746751L},
        {2.897153057105493432130432594192938764925L},
        {-6.359448489975074843148159912383825625953L},
        {4.362295432869581411017727318190886861028L},
        {5.325864828439256604428877920840511317836L},
        {-11.74888356406282787774717033978577296189L},
        {7.495539342889836208304604784564358155659L},
        {-0.9249506636175524925650207933207191611350e-1L},
        {5.861455442946420028659251486982647890394L},
        {-12.92096931784710929170611868178335939542L},
        {8.159367898576158643180400794539253485182L},
        {-0.7158497328140099722453054252582973869127e-1L},
        {-0.2826905039406838290900305721271224146718e-1L},
        {0.9646076681806522951816731316512876333712e-1L},
        {0.01L},
        {0.4798896504144995747752495322905965199130L},
        {1.379008574103741893192274821856872770756L},
        {-3.290069515436080679901047585711363850116L},
        {2.324710524099773982415355918398765796109L},
    }};
    static constexpr std::array<Decimal, 7> b{{a[15], a[16], a[17], a[18], a[19], a[20], {0.0L}}};
    static constexpr std::array<Decimal, 7> c{{
        {0.0L}, {0.161L}, {0.327L}, {0.9L}, {0.9800255409045096857298102862870245954942L}, {1.0L}, {1.0L},
    }};
    static constexpr std::array<Decimal, 7> error{{
        {-1.780011052225771443378550607539534775945e-3L},
        {-8.164344596567469032236360633546862401863e-4L},
        {7.880878010261996010314727672526304238629e-3L},
        {-1.447110071732629075371651479726351167209e-1L},
        {5.823571654525552250199376106520421794261e-1L},
        {-4.580821059291869466616365188325542974428e-1L},
        {1.0L / 66.0L},
    }};
    /// b_i(theta) = sum_k r(i, k) theta^(k+1), by rows i, k = 0..3.
    static constexpr std::array<Decimal, 28> r{{
        {1.0L},
        {-2.763706197274825911336735930481400260916L},
        {2.91325546182191274375068099306808L},
        {-1.0530884977290216L},
        {0.0L}, {0.1317L}, {-0.2234L}, {0.1017L},
        {0.0L},
        {3.93029623689475152850687446709813398L},
        {-5.94103387213150473470249202589458001L},
        {2.490627285651252793L},
        {0.0L},
        {-12.411077166933676983734381540685453484102L},
        {30.3381886302823215981729903691836576L},
        {-16.54810288924490272L},
        {0.0L},
        {37.50931341651103919496903965334519631242L},
        {-88.1789048947664011014276693541209817L},
        {47.37952196281928122L},
        {0.0L},
        {-27.896526289197287805948263144598643896L},
        {65.09189467479367152629021928716553658L},
        {-34.87065786149660974L},
        {0.0L}, {1.5L}, {-4.0L}, {2.5L},
    }};
    // clang-format on

    template <class Real>
    static void dense(Real theta, std::array<Real, stages>& weights) noexcept
    {
        for (std::size_t i = 0; i < stages; ++i) {
            Real sum = Real(0);
            for (std::size_t k = 4; k-- > 0;) sum = theta * (r[4 * i + k].template as<Real>() + sum);
            weights[i] = sum;
        }
    }
};

} // namespace tableau

/// Order 5(4); Hairer's controller with beta = 0.04.
struct Tsit5Family {
    static constexpr StepControl defaults{};
    template <class M>
    using Stepper = EmbeddedStepper<tableau::Tsit5, M>;
};

using Tsit5 = AdaptiveMethod<Tsit5Family>;

} // namespace lagen
