// SPDX-License-Identifier: GPL-2.0-or-later
/// Models that are compiled as shared objects and loaded.
#include "compile/generated_program.hpp"

#include <fstream>

using namespace lagen::testing;

namespace {

/// Makes NAME.so in `folder` of a source.
void make_object(const std::string& folder, const std::string& name, const std::string& source)
{
    std::ofstream(folder + name + ".cpp") << source;
    compile("-fPIC -shared -fvisibility=hidden -DEIGEN_MAX_ALIGN_BYTES=16", {.first = "lagen/export_model.hpp"},
            folder + name + ".cpp", folder, folder + name + ".so");
}

/// Bytes of the same object, but for some.
void copy_changed(const std::string& from, const std::string& to, std::size_t size, std::size_t place, char byte)
{
    std::string bytes = read_text(from).substr(0, size);
    if (place < bytes.size()) bytes[place] = byte;
    std::ofstream(to, std::ios::binary) << bytes;
}

/// The folder of a program, with heavy_top.so in it.
std::string folder_with_top(const std::string& program)
{
    const std::string folder = std::string(LAGEN_BINARY_DIR) + "/compiled/" + program + "/";
    std::filesystem::create_directories(folder);
    const Shell made = run_shell("'" LAGEN_PROGRAM "' compile '" LAGEN_SOURCE_DIR "/models/heavy_top.toml' -o '" +
                                 folder + "heavy_top.so' 2>&1");
    INFO(made.output);
    REQUIRE(made.status == 0);
    return folder;
}

} // namespace

TEST_CASE("a compiled model has the bits of its header, takes no memory in a step, and is refused where it is none")
{
    const std::string folder = folder_with_top("compiled_model"), object = folder + "heavy_top.so";
    make_object(folder, "other_version",
                "#include \"lagen/compiled_model.h\"\nextern \"C\" {\n"
                "extern __attribute__((visibility(\"default\"))) const char lagen_compiled_model_machine[];\n"
                "const char lagen_compiled_model_machine[] = \"base\";\n"
                "__attribute__((visibility(\"default\"))) const lagen_compiled_model* lagen_compiled_model_of();\n"
                "const lagen_compiled_model* lagen_compiled_model_of()\n{\n"
                "    static lagen_compiled_model table{};\n    table.version = 999;\n    return &table;\n}\n}\n");
    std::ofstream(folder + "text.so") << "no shared object\n";
    copy_changed(object, folder + "cut.so", 3000, 3000, 0);
    copy_changed(object, folder + "other_machine.so", std::string::npos, 18, 0x28); // 32-bit ARM

    CHECK(run_on_headers("compiled_model", {"models/heavy_top.toml"}, "", quickly) ==
          "load missing.so not_found\n"
          "load text.so not_a_model\n"
          "load cut.so not_a_model\n"
          "load other_machine.so other_machine\n"
          "load other_version.so other_version\n"
          "load heavy_top.so ok\n"
          "model heavy_top 6 w1 I1\n"
          "bits euler same\n"
          "bits rk4 same\n"
          "bits tsit5 same\n"
          "bits dop853 same\n"
          "bits verner98 same\n"
          "memory rk4 0 ok\n"
          "memory dop853 0 ok\n"
          "bits parameters same\n"
          "nystrom refused not_separable\n");
}

TEST_CASE("a program in C calls a compiled model, whose scene keeps the values and the hash of the model")
{
    const std::string folder = std::string(LAGEN_BINARY_DIR) + "/compiled/in_c/";
    std::filesystem::create_directories(folder);
    const std::string page = read_text(LAGEN_SOURCE_DIR "/docs/compiled_models.md");
    const std::size_t begin = page.find("```c\n") + 5;
    std::ofstream(folder + "top.c") << page.substr(begin, page.find("```", begin) - begin);
    const std::string lagen = "'" LAGEN_PROGRAM "' compile '" LAGEN_SOURCE_DIR "/models/heavy_top.toml' ";
    const Shell made =
        run_shell("cd '" + folder +
                  "' && cc -std=c99 -Wall -Wextra -Wpedantic -Werror -I'" LAGEN_SOURCE_DIR "/runtime/include' top.c " +
                  "-o top -ldl 2>&1 && " + lagen + "-o top.so 2>&1 && ./top ./top.so && " + lagen +
                  "--scene drop -o top.so 2>&1 && ./top ./top.so");
    INFO(made.output);
    REQUIRE(made.status == 0);
    const std::string half = made.output.substr(made.output.size() / 2);
    CHECK_THAT(half, Catch::StartsWith("heavy_top ") && Catch::EndsWith("mgl = 1.7, status 0, dw1/dt = -0.136\n"));
    CHECK(made.output == half + half);
    CHECK_THAT(half, !Catch::Contains(" 0000000000000000 "));
}

TEST_CASE("Taylor's method over compiled models has the bits of their classes, and takes no memory in a step")
{
    const std::string folder = std::string(LAGEN_BINARY_DIR) + "/compiled/compiled_series/";
    std::filesystem::create_directories(folder);
    for (const auto& [name, with] : {std::pair("heavy_top", " --with taylor"), std::pair("without", "")}) {
        const Shell made = run_shell("'" LAGEN_PROGRAM "' compile '" LAGEN_SOURCE_DIR "/models/heavy_top.toml'" +
                                     std::string(with) + " -o '" + folder + name + ".so' 2>&1");
        INFO(made.output);
        REQUIRE(made.status == 0);
    }
    const std::pair<const char*, const char*> models[] = {{"prey", "Prey"},         {"sway", "Swaying"},
                                                          {"capped", "CappedSway"}, {"falling", "Falling"},
                                                          {"bounded", "Bounded"},   {"growing", "Growing"}};
    for (const auto& [name, type] : models)
        make_object(folder, name,
                    "#include \"lagen/export_model.hpp\"\n#include \"compile/programs/compiled_series_models.hpp\"\n"
                    "LAGEN_EXPORT_MODEL(lagen::testing::" +
                        std::string(type) + ")\n");
    CHECK(run_on_headers("compiled_series", {"models/heavy_top.toml"}, "--with taylor", quickly) ==
          "heavy_top ok same, 0 events\n"
          "heavy_top ok same, 0 events\n"
          "heavy_top ok same, 0 events\n"
          "prey ok same, 0 events\n"
          "sway ok same, 18 events\n"
          "capped ok same, 0 events\n"
          "capped left_domain same, 0 events\n"
          "falling ok same, 0 events\n"
          "falling non_finite same, 0 events\n"
          "bounded left_domain same, 0 events\n"
          "growing ok same, 0 events\n"
          "memory heavy_top 0 ok\n"
          "memory sway 0 ok\n"
          "memory capped 0 ok\n"
          "memory bounded 0 ok\n"
          "memory of a watch same\n"
          "without series invalid_input\n");
}

TEST_CASE("implicit methods have the bits of the header on compiled models, and take no memory in a step")
{
    const std::string folder = folder_with_top("compiled_implicit");
    for (const std::string name : {"relaxation", "van_der_pol", "lattice", "decay"})
        make_object(folder, name,
                    "#include \"lagen/export_model.hpp\"\n#include \"compile/programs/implicit_models.hpp\"\n"
                    "LAGEN_EXPORT_MODEL(lagen::models::" +
                        name + ")\n");
    CHECK(run_on_headers("compiled_implicit", {"models/heavy_top.toml"}, "", quickly) ==
          "heavy_top gauss2 ok same 0 ok\n"
          "heavy_top gauss4 ok same 0 ok\n"
          "heavy_top gauss8 ok same 0 ok\n"
          "heavy_top gauss12 ok same 0 ok\n"
          "heavy_top radau5 ok same 0 ok\n"
          "relaxation gauss4 ok same 0 ok\n"
          "relaxation radau3_fixed ok same 0 ok\n"
          "relaxation radau5 ok same 0 ok\n"
          "van_der_pol gauss6 newton_diverged same 0 ok\n"
          "van_der_pol radau5_fixed newton_diverged same 0 ok\n"
          "van_der_pol radau5 ok same 0 ok\n"
          "lattice gauss4 ok same 0 ok\n"
          "lattice gauss8 ok same 0 ok\n"
          "lattice radau5 ok same 0 ok\n"
          "without a Jacobian invalid_input\n"
          "without a Jacobian invalid_input\n"
          "without a Jacobian invalid_input\n");
}

TEST_CASE("what cannot be compiled as a shared object is refused with a sentence")
{
    const std::string lagen = "'" LAGEN_PROGRAM "' compile '" LAGEN_SOURCE_DIR "/models/";
    const Shell unnamed = run_shell(lagen + "heavy_top.toml' 2>&1");
    CHECK(unnamed.output == "lagen compile: the shared object needs a name: -o FILE.so\n");
    CHECK(unnamed.status / 256 == 4);
    const Shell discrete = run_shell(lagen + "moser_veselov.toml' -o '" LAGEN_BINARY_DIR "/compiled/none.so' 2>&1");
    CHECK(discrete.output ==
          "lagen compile: the discrete form of model 'moser_veselov' makes steps, and a compiled model is a "
          "right-hand side\nhint: `lagen generate` writes its header; --form takes another form\n");
    CHECK(discrete.status / 256 == 4);
    CHECK(run_shell(lagen + "heavy_top.toml' -o /nowhere/top.so 2>&1").status / 256 == 5);
}
