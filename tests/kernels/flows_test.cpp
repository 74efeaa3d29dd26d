// SPDX-License-Identifier: GPL-2.0-or-later
/// Exact flows of parts of H: each is a flow, their fields add up to Hamilton's equations, and each is a Poisson map.
#include "models.hpp"

#include "emit/print_header.hpp"
#include "geometry/algebroid.hpp"
#include "support/tolerances.hpp"

using namespace lagen;
using namespace lagen::testing;

namespace {

const char* const length = "length of a flow";

KernelModule with_flows(const Model& model)
{
    KernelRequest request;
    request.form = "hamilton";
    request.only = {"rhs", "flows"};
    return kernels_of(model, request);
}

/// All lanes of a sparse column of nodes.
std::vector<NodeId> column_of(const KernelModule& module, const std::string& name)
{
    const KernelOutput& output = find_kernel(module, name).outputs.at(0);
    std::vector<NodeId> nodes(output.shape.rows, module.graph->constant(0));
    for (const KernelEntry& entry : output.entries) nodes[entry.row] = entry.node;
    return nodes;
}

std::vector<double> lanes_at(const KernelModule& module, const Values& point)
{
    std::vector<double> state;
    for (const Quantity& lane : lanes_of(module)) state.push_back(point.at(lane.name));
    return state;
}

Values moved_by(const KernelModule& module, const std::vector<NodeId>& flow, Values point, double h)
{
    point[length] = h;
    const std::vector<double> change = evaluate<double>(*module.graph, flow, point);
    std::size_t k = 0;
    for (const Quantity& lane : lanes_of(module)) point[lane.name] += change[k++];
    return point;
}

/// {x^i, mu_a} = rho^i_a, {mu_a, mu_b} = -mu_c C^c_ab, shape (n + r, n + r).
std::vector<std::vector<double>> poisson_tensor(const System& system, const Values& point)
{
    const Algebroid& E = system.algebroid;
    const std::size_t n = E.n(), r = E.r();
    const auto value = [&](NodeId node) { return evaluate<double>(system.graph, std::array{node}, point)[0]; };
    std::vector<std::vector<double>> P(n + r, std::vector<double>(n + r, 0));
    for (std::size_t a = 0; a < r; ++a) {
        for (const ColumnEntry& rho : E.anchor[a]) {
            P[rho.index][n + a] += value(rho.value);
            P[n + a][rho.index] -= value(rho.value);
        }
        for (std::size_t b = 0; b < r; ++b)
            for (const ColumnEntry& C : E.C(a, b)) P[n + a][n + b] -= value(system.mu[C.index]) * value(C.value);
    }
    return P;
}

/// The largest entry of J P J^T - P' with J = 1 + d change/d s, relative to the largest of P'.
double poisson_defect(const KernelModule& module, const System& system, const std::vector<NodeId>& flow,
                      const Values& point)
{
    std::vector<NodeId> lanes;
    for (const Quantity& lane : lanes_of(module)) lanes.push_back(lane.input);
    const auto slopes = jacobian(*module.graph, flow, lanes);
    std::vector<std::vector<double>> J;
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        J.push_back(evaluate<double>(*module.graph, slopes[i], point));
        J[i][i] += 1;
    }
    const auto before = poisson_tensor(system, point);
    const auto behind = poisson_tensor(system, moved_by(module, flow, point, point.at(length)));
    double defect = 0, size = 0;
    for (std::size_t i = 0; i < J.size(); ++i)
        for (std::size_t j = 0; j < J.size(); ++j) {
            double carried = 0;
            for (std::size_t k = 0; k < J.size(); ++k)
                for (std::size_t l = 0; l < J.size(); ++l) carried += J[i][k] * before[k][l] * J[j][l];
            defect = std::max(defect, std::abs(carried - behind[i][j]));
            size = std::max(size, std::abs(behind[i][j]));
        }
    REQUIRE(size > 0);
    return defect / size;
}

void check_flows(const Model& model, std::size_t count)
{
    const KernelModule module = with_flows(model);
    const System system = elaborate(model);
    INFO(model.name << ": " << module.flows.obstacle);
    REQUIRE(module.flows.count == count);
    const NodeId h = module.graph->input(length);
    for (const unsigned seed : {1U, 2U, 3U}) {
        Values point = random_point(module, seed);
        point[length] = 0.3;
        std::vector<double> sum(lanes_of(module).size(), 0.0);
        for (std::size_t part = 0; part < count; ++part) {
            const std::vector<NodeId> flow = column_of(module, "flow_" + std::to_string(part));
            const auto once = lanes_at(module, moved_by(module, flow, point, 0.7));
            const auto twice = lanes_at(module, moved_by(module, flow, moved_by(module, flow, point, 0.4), 0.3));
            const auto back = lanes_at(module, moved_by(module, flow, moved_by(module, flow, point, 0.4), -0.4));
            std::vector<NodeId> rates;
            for (const NodeId node : flow) rates.push_back(gradient(*module.graph, node, std::array{h})[0]);
            Values start = point;
            start[length] = 0;
            const std::vector<double> slope = evaluate<double>(*module.graph, rates, start);
            for (std::size_t k = 0; k < sum.size(); ++k) {
                sum[k] += slope[k];
                CHECK(once[k] == Approx(twice[k]).epsilon(1e-13).margin(1e-13));
                CHECK(back[k] == Approx(lanes_at(module, point)[k]).epsilon(1e-13).margin(1e-13));
            }
            CHECK(poisson_defect(module, system, flow, point) < 1e-13);
        }
        const std::vector<double> rates = values_of(module, "rhs", point);
        for (std::size_t k = 0; k < sum.size(); ++k) CHECK(sum[k] == Approx(rates[k]).epsilon(1e-13).margin(1e-13));
    }
}

void check_file(const std::string& name, std::size_t count)
{
    check_flows(read_model(std::string(LAGEN_SOURCE_DIR) + "/models/" + name + ".toml"), count);
}

std::string body_text(const std::string& lagrangian, const std::string& more = "")
{
    return "name = \"body\"\n[parameters]\nm = 2\nk = 3\n[fibre]\ncoordinates = [\"a\", \"b\", \"c\"]\n"
           "[algebroid]\nkind = \"lie_algebra\"\nalgebra = \"so(3)\"\n" +
           more + "[lagrangian]\nL = \"" + lagrangian + "\"\n";
}

std::string plane_text(const std::string& lagrangian, const std::string& more = "")
{
    return "name = \"plane\"\n[parameters]\nm = 2\nk = 3\n[base]\ncoordinates = [\"q\", \"x\"]\n[fibre]\n"
           "coordinates = [\"u\", \"v\"]\n[algebroid]\nkind = \"tangent\"\n" +
           more + "[lagrangian]\nL = \"" + lagrangian + "\"\n";
}

std::string flows_obstacle(const std::string& text)
{
    KernelRequest request;
    request.form = "hamilton";
    request.flows = true;
    const KernelModule module = kernels_of(read_model_text("test.toml", text), request);
    CHECK(module.flows.count == 0);
    CHECK(print_header(module).find("flow_0") == std::string::npos);
    return module.flows.obstacle;
}

Flows with_flows_of_file(const std::string& name)
{
    KernelRequest request;
    request.form = "hamilton";
    request.flows = true;
    return kernels_of(read_model(std::string(LAGEN_SOURCE_DIR) + "/models/" + name + ".toml"), request).flows;
}

} // namespace

TEST_CASE("heavy tops are a kick and three rotations", "[kernels]")
{
    check_file("heavy_top", 4);
    check_file("heavy_top_quaternion", 4);
    check_file("kovalevskaya", 4);
}

TEST_CASE("bodies without a potential are flows of momenta alone, those that commute in one", "[kernels]")
{
    check_file("rigid_body", 3);
    check_file("kirchhoff", 3);
    check_file("gyrostat", 3);
    check_file("planar_body", 2);
    check_file("heisenberg", 2);
}

TEST_CASE("a field that depends on the place is integrated along it, as are growth and rotations that add up",
          "[kernels]")
{
    check_file("charged_particle", 3);
    check_file("half_plane", 2);
    check_file("elroys_beanie", 2);
}

TEST_CASE("a rotation whose rate is a function of what stays has Stumpff's functions", "[kernels]")
{
    check_flows(read_model_text("test.toml", R"text(name = "bundle"
[parameters]
k = 3
[base]
coordinates = ["q"]
domain = ["k > 0"]
[fibre]
coordinates = ["a", "b", "c"]
[algebroid.bracket]
"a,b" = { c = "k*(1 + q^2)" }
"c,a" = { b = "1" }
[hamiltonian]
H = "p_a^2/2 + p_b^2 + 2*p_c^2 + q^2/2"
)text"),
                2);
}

TEST_CASE("canonical momenta make one part, and T may couple them", "[kernels]")
{
    check_flows(read_model_text("test.toml", plane_text("m*(u^2 + v^2)/2 + u*v/3 - k*q^4*x - q*sin(t)")), 2);
    check_flows(read_model_text("test.toml", plane_text("m*(u^2 + v^2)/2", "[forces]\nu = \"k*q*cos(t)\"\n")), 2);
}

TEST_CASE("what is no sum of exact flows says why", "[kernels]")
{
    CHECK(flows_obstacle(body_text("a^2 + a*b/2 + b^2 + k*c^2")) ==
          "the kinetic energy couples a and b, whose bracket is not "
          "zero");
    CHECK(flows_obstacle(body_text("a^2 + b^2 + k*c^2", "[forces]\nb = \"-a\"\n")) == "the force on b depends on p_a");
    CHECK(flows_obstacle(body_text("a^2 + b^2 + k*c^4 + c^2")) == "the velocities are solved for in every call");
    CHECK(flows_obstacle(body_text("(1 + t^2)*a^2 + b^2 + c^2")) == "a depends on t");
    CHECK(flows_obstacle(plane_text("m*(1 + x^2)*u^2/2 + v^2/2")) == "u depends on x");
    CHECK(with_flows_of_file("heavy_top_quasivelocities").obstacle ==
          "where w1 alone is not 0, the motion of ph is not known in closed form");
}

TEST_CASE("flows are printed on request, and of themselves only where the equations do not separate", "[kernels]")
{
    KernelRequest request;
    request.form = "hamilton";
    const Model separable = read_model_text("test.toml", plane_text("m*(u^2 + v^2)/2 - k*q^4*x"));
    request.flows = true;
    CHECK(kernels_of(separable, request).flows.count == 0);
    request.with = {"flows"};
    CHECK(kernels_of(separable, request).flows.count == 2);
    const Model coupled = read_model_text("test.toml", body_text("a^2 + a*b/2 + b^2 + k*c^2"));
    CHECK_THROWS_WITH(kernels_of(coupled, request),
                      Catch::Contains("model 'body' is no sum of exact flows: the kinetic energy couples a and b"));
}
