// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/plot/labels.hpp"
#include "commands/plot/page.hpp"
#include "commands/plot/panel.hpp"
#include "commands/plot/styles.hpp"
#include "commands/plot/thinned.hpp"

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

constexpr double hardly = 1e-4; // of the ordinates

bool hardly_differ(const std::vector<SampledCurve>& curves)
{
    Box box = empty_box();
    for (const SampledCurve& curve : curves) extend(box, pieces_of(curve));
    return box.height() > 0 && box.height() < hardly * std::max(std::fabs(box.low.y), std::fabs(box.high.y));
}

SampledCurve change_of(SampledCurve curve)
{
    const double start = curve.empty() ? 0 : curve[0][1];
    for (auto& point : curve) point[1] -= start;
    return curve;
}

/// Of a motion that does not move, a point; of many steps over time, a line: their points would hide one another.
Pen pen_of(const SampledCurve& curve, Pen pen, bool over_time)
{
    constexpr std::size_t many = 1000;
    if (curve.size() == 1) return Pen::points;
    return pen == Pen::steps && over_time && curve.size() > many ? Pen::line : pen;
}

void label_axes(Drawing& drawing, const PanelRequest& request, bool changes)
{
    const std::vector<Symbol> ordinates = symbols_along(request, 1);
    const bool together =
        !request.ordinate.empty() && request.curves.size() > std::max<std::size_t>(request.runs.size(), 1);
    drawing.x_label = axis_label(symbols_along(request, 0), longest_x_label, true);
    const std::string before = changes ? "change of " : "";
    drawing.y_label = before + (together ? panel_label(request.ordinate, ordinates)
                                         : axis_label(ordinates, longest_y_label - text_width(before), !changes));
}

} // namespace

std::vector<Symbol> symbols_along(const PanelRequest& request, std::size_t axis)
{
    std::vector<Symbol> symbols;
    for (const auto& curve : request.symbols) symbols.push_back(curve[axis]);
    return symbols;
}

void add_legend(Drawing& drawing, const PanelRequest& request)
{
    const std::size_t count = request.curves.size(), each = count / std::max<std::size_t>(request.runs.size(), 1);
    const auto first = request.symbols.begin();
    const std::vector<std::string> legends = legends_of({first, first + static_cast<std::ptrdiff_t>(each)});
    for (std::size_t k = 0; k < count && count > 1; ++k) {
        std::string text = legends[k % each];
        if (!request.runs.empty()) text += (text.empty() ? "" : ", ") + request.runs[k / each];
        drawing.legend.emplace_back(request.pen == Pen::line ? line_style(k, 1.6) : point_style(k, 0.6), text);
    }
}

Drawing draw_in_plane(const PanelRequest& request)
{
    Drawing drawing;
    drawing.over_time = std::ranges::all_of(request.symbols, [](const auto& curve) { return curve[0].name == "t"; });
    drawing.equal = request.equal && !drawing.over_time;
    drawing.box = empty_box();
    const bool changes = drawing.over_time && hardly_differ(request.curves);
    for (std::size_t k = 0; k < request.curves.size(); ++k) {
        const SampledCurve& curve = request.curves[k];
        const std::vector<Polyline> pieces = pieces_of(changes ? change_of(curve) : curve);
        extend(drawing.box, pieces);
        const Pen pen = pen_of(curve, request.pen, drawing.over_time);
        for (Stroke& stroke : strokes_of(pieces, false, k, pen)) drawing.strokes.push_back(std::move(stroke));
        if (!drawing.over_time && pen == Pen::line && !pieces.empty())
            drawing.strokes.push_back(start_of(pieces[0][0], k));
    }
    if (drawing.box.low.x > drawing.box.high.x) drawing.box = {{0, 0}, {1, 1}};
    label_axes(drawing, request, changes);
    add_legend(drawing, request);
    return drawing;
}

} // namespace lagen
