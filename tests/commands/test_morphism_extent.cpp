// SPDX-License-Identifier: GPL-2.0-or-later
/// What `lagen check MORPHISM` says its claims are about: points that the map takes into the target's domain, forces,
/// bounds and parameters of both sides, and motions that cannot be compared.
#include "program.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

/// A folder with two models on lines, q and Q, and a map with these keys.
class LineMap {
  public:
    LineMap(const std::string& source, const std::string& target, const std::string& map) : folder_(fresh_folder())
    {
        write_text(folder_ + "/source.toml", "[algebroid]\nkind = \"tangent\"\n" + source);
        write_text(folder_ + "/target.toml", "[algebroid]\nkind = \"tangent\"\n" + target);
        add("map", map);
    }

    void add(const std::string& name, const std::string& map) const
    {
        write_text(folder_ + "/" + name + ".toml",
                   "[morphism]\nsource = \"source.toml\"\ntarget = \"target.toml\"\n" + map);
    }

    [[nodiscard]] json::Value checked(const std::string& name = "map") const
    {
        return json::parse(call({"check", path(name), "--format", "json"}).out);
    }

    [[nodiscard]] std::string path(const std::string& name = "map") const { return folder_ + "/" + name + ".toml"; }

  private:
    std::string folder_;
};

std::string line_of(const std::string& name, const std::string& more)
{
    return "[base]\ncoordinates = [\"" + name + "\"]\n" + more;
}

} // namespace

TEST_CASE("a map that is not defined everywhere, or leaves the target's domain, says where it holds")
{
    const std::string same = "base = { Q = \"q\" }\nfibre = { v_Q = \"v_q\" }\n";
    const LineMap kept(line_of("q", "[lagrangian]\nL = \"v_q^2/2 + q\"\n"),
                       line_of("Q", "domain = [\"Q > 0\"]\n[lagrangian]\nL = \"v_Q^2/2 + sqrt(Q^2)\"\n"), same);
    CHECK(kept.checked()["verdict"].text == "valid");
    CHECK(kept.checked()["domain"]["where"].texts() == std::vector<std::string>{"q > 0"});
    CHECK(
        call({"check", kept.path()})
            .out.find("  domain          where q > 0: there the map is continuous and reaches the target's domain\n") !=
        std::string::npos);

    const LineMap logarithm(line_of("q", "[lagrangian]\nL = \"v_q^2/(2*q^2)\"\n"),
                            line_of("Q", "[lagrangian]\nL = \"v_Q^2/2\"\n"),
                            "base = { Q = \"log(q)\" }\nfibre = { v_Q = \"v_q/q\" }\n");
    CHECK(logarithm.checked()["domain"]["where"].texts() == std::vector<std::string>{"q > 0"});

    const LineMap inside(line_of("q", "domain = [\"q > 1\"]\n[lagrangian]\nL = \"v_q^2/2\"\n"),
                         line_of("Q", "domain = [\"Q > 0\"]\n[lagrangian]\nL = \"v_Q^2/2\"\n"), same);
    CHECK_FALSE(inside.checked().has("domain"));
}

TEST_CASE("a map that jumps says where it does not")
{
    const LineMap turned(line_of("q", "[lagrangian]\nL = \"v_q^2/2\"\n"),
                         line_of("Q", "[lagrangian]\nL = \"v_Q^2/2\"\n"),
                         "base = { Q = \"q + atan2(q, -1) + atan(q)\" }\nfibre = { v_Q = \"v_q\" }\n");
    CHECK(turned.checked()["verdict"].text == "valid");
    CHECK(turned.checked()["domain"]["where"].texts() == std::vector<std::string>{"q != 0"});
}

TEST_CASE("what follows of maps between Hamiltonians and between control problems")
{
    const auto follows = [](const LineMap& map) { return map.checked()["follows"].texts(); };
    using Names = std::vector<std::string>;
    const std::string twice = "base = { Q = \"2*q\" }\nfibre = { v_Q = \"2*v_q\" }\n";
    CHECK(follows({line_of("q", "[hamiltonian]\nH = \"p_v_q^2/2\"\n"),
                   line_of("Q", "[hamiltonian]\nH = \"2*p_v_Q^2\"\n"), twice}) == Names{"reduction", "reconstruction"});
    const auto control = [](const std::string& q, const std::string& u, const std::string& sigma) {
        return line_of(q, "[control]\ncontrols = [\"" + u + "\"]\nsigma = { v_" + q + " = \"" + sigma +
                              "\" }\ncost = \"" + u + "^2/2\"\n");
    };
    CHECK(follows({control("q", "u", "u"), control("Q", "w", "2*w"), twice + "controls = { w = \"u\" }\n"}) ==
          Names{"reduction", "reconstruction"});
    // dH/du = dH'/dw dw/du vanishes at u = 0 too, whatever H' is.
    CHECK(follows({line_of("q", "[control]\ncontrols = [\"u\"]\nsigma = { v_q = \"u^3\" }\ncost = \"u^6/2\"\n"),
                   control("Q", "w", "2*w"), twice + "controls = { w = \"u^3\" }\n"})
              .empty());
    // Not onto the momenta: those Phi* mu' alone.
    const LineMap pressed("[base]\ncoordinates = [\"q\", \"r\"]\n[hamiltonian]\nH = \"(p_v_q^2 + p_v_r^2)/2\"\n",
                          line_of("Q", "[hamiltonian]\nH = \"p_v_Q^2/2\"\n"),
                          "base = { Q = \"q\" }\nfibre = { v_Q = \"v_q\" }\n");
    CHECK(follows(pressed) == Names{"reduction"});
    CHECK(call({"check", pressed.path()})
              .out.find(
                  "  reduction       solutions of the source with momenta Φ*μ' project to solutions of the target\n") !=
          std::string::npos);
}

TEST_CASE("forces of Hamiltonian models are compared")
{
    const std::string same = "base = { Q = \"q\" }\nfibre = { v_Q = \"v_q\" }\n";
    const std::string H = "[hamiltonian]\nH = \"p_v_q^2/2\"\n", target_H = "[hamiltonian]\nH = \"p_v_Q^2/2\"\n";
    const LineMap forced(line_of("q", H + "[forces]\nv_q = \"-q^3\"\n"), line_of("Q", target_H), same);
    const json::Value report = forced.checked();
    CHECK(report["verdict"].text == "invalid");
    CHECK(report["checks"].entries.back()["indices"].texts() == std::vector<std::string>{"force", "v_q"});
    const LineMap both(line_of("q", H + "[forces]\nv_q = \"-q^3\"\n"),
                       line_of("Q", target_H + "[forces]\nv_Q = \"-Q^3\"\n"), same);
    CHECK(both.checked()["verdict"].text == "valid");

    const LineMap mixed(line_of("q", "[lagrangian]\nL = \"v_q^2/2 - q^4\"\n"), line_of("Q", target_H), same);
    CHECK(call({"check", mixed.path()}).out.find("  motions         not compared: one model has L, the other H;") !=
          std::string::npos);
}

TEST_CASE("controls that are the same on both sides have the same bounds, others are left open")
{
    const auto control = [](const std::string& name, const std::string& bounds) {
        return line_of(name, "[control]\ncontrols = [\"u\"]\ncost = \"u^2/2\"\nsigma = { v_" + name + " = \"u\" }\n" +
                                 bounds);
    };
    const std::string same = "base = { Q = \"q\" }\nfibre = { v_Q = \"v_q\" }\ncontrols = { u = \"u\" }\n";
    const std::string bounds = "bounds = { u = [-1, 1] }\n";
    CHECK(LineMap(control("q", bounds), control("Q", bounds), same).checked()["verdict"].text == "valid");
    const json::Value open = LineMap(control("q", bounds), control("Q", ""), same).checked();
    CHECK(open["verdict"].text == "undecided");
    CHECK(open["checks"].entries.back()["indices"].texts() == std::vector<std::string>{"bounds"});
}

TEST_CASE("maps that are claimed to be equal give the target's parameters the same values")
{
    const std::string same = "base = { Q = \"q\" }\nfibre = { v_Q = \"v_q\" }\n";
    const std::string m = "[parameters]\nm = 2\n";
    const LineMap map(line_of("q", "[lagrangian]\nL = \"m*v_q^2/2\"\n" + m),
                      line_of("Q", "[lagrangian]\nL = \"m*v_Q^2/2\"\n" + m), same + "equals = \"other.toml\"\n");
    map.add("other", same);
    CHECK(map.checked()["verdict"].text == "valid");
    map.add("other", same + "parameters = { m = \"2*m\" }\n");
    const json::Value report = map.checked();
    CHECK(report["verdict"].text == "invalid");
    CHECK(report["checks"].entries.back()["name"].text == "equals");
    CHECK(report["checks"].entries.back()["indices"].texts() == std::vector<std::string>{"m"});
}
