// SPDX-License-Identifier: GPL-2.0-or-later
/// [scene.NAME.plot]: panels, vectors, and what is taken from other scenes.
#include "model/read_curve.hpp"
#include "model/read_model.hpp"

#include <catch2/catch.hpp>

using lagen::Model;
using lagen::Plot;
using Strings = std::vector<std::string>;

namespace {

const std::string bodies = R"toml(
[base]
coordinates = ["q[1..2]", "z"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "(dot(v_q, v_q) + v_z^2)/2"
[scene.default]
initial = { q = [1, 2], z = 0 }
rest = true
duration = 1
)toml";

Model read_bodies(const std::string& text)
{
    return lagen::read_model_text("test.toml", bodies + text);
}

/// "x:y" of each curve, those of a panel in one string.
Strings curve_texts(const Plot& plot)
{
    Strings out;
    for (const auto& panel : plot.panels) {
        std::string text;
        for (const lagen::PlotCurve& curve : panel) {
            text += text.empty() ? "" : ", ";
            for (std::size_t i = 0; i < curve.coordinates.size(); ++i)
                text += (i == 0 ? "" : ":") + curve.coordinates[i].name;
        }
        out.push_back(text);
    }
    return out;
}

} // namespace

TEST_CASE("a string is a panel and so is a list, and vectors make a curve an entry")
{
    const Model model =
        read_bodies("[scene.default.plot]\n"
                    "curves = ['t : sin(z)', ['q:v_q', 'z : energy'], 'q:z:t', 'q[2]:z']\nequal = true\n");
    const Plot& plot = model.scenes[0].plot.value();
    CHECK(curve_texts(plot) ==
          Strings{"t:sin(z)", "q[1]:v_q[1], q[2]:v_q[2], z:energy", "q[1]:z:t, q[2]:z:t", "q[2]:z"});
    CHECK(to_text(plot.panels[0][0].coordinates[1].value) == "sin(z)");
    CHECK((plot.equal && !plot.points && !plot.sphere));
    CHECK(lagen::is_in_space(plot.panels[2]));
    CHECK_FALSE(lagen::is_in_space(plot.panels[1]));
    // t is no column of the program.
    CHECK(lagen::plot_coordinates(model.scenes[0]).size() == 1 + 6 + 4 + 2);
}

TEST_CASE("a scene that is like another one has its picture, and a picture may be like that of any scene")
{
    const Model model = read_bodies("[scene.default.plot]\nlike = 'late'\nequal = true\n"
                                    "[scene.copy]\nlike = 'default'\nduration = 2\n"
                                    "[scene.late]\nlike = 'default'\n"
                                    "[scene.late.plot]\ncurves = ['z:v_z']\npoints = true\n"
                                    "[scene.other]\nlike = 'default'\n[scene.other.plot]\nlike = 'default'\n"
                                    "curves = ['q:z:t']\nsphere = false\n");
    REQUIRE(model.scenes.size() == 4);
    for (const std::size_t k : {0U, 1U, 2U}) CHECK(curve_texts(model.scenes[k].plot.value()) == Strings{"z:v_z"});
    CHECK((model.scenes[0].plot->equal && model.scenes[0].plot->points));
    CHECK((model.scenes[1].plot->equal && !model.scenes[2].plot->equal));
    const Plot& other = model.scenes[3].plot.value();
    CHECK(curve_texts(other) == Strings{"q[1]:z:t, q[2]:z:t"});
    CHECK((other.equal && other.points && other.sphere == false));
    CHECK_FALSE(read_bodies("").scenes[0].plot);
}
