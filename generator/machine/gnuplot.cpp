// SPDX-License-Identifier: GPL-2.0-or-later
#include "machine/gnuplot.hpp"

#include "machine/process.hpp"
#include "machine/temporary_folder.hpp"
#include "machine/write_file.hpp"
#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <filesystem>

namespace lagen {

std::string gnuplot_text(const std::string& text)
{
    // In single quotes all stands for itself, but the titles of some commands end at a doubled quote.
    const bool plain = text.find('\'') == std::string::npos;
    const char quote = plain ? '\'' : '"';
    std::string result(1, quote);
    for (const char c : text) {
        if (c == '\n' || c == '\r') continue;
        if (!plain && (c == '"' || c == '\\' || c == '`'))
            result += fmt::format("\\{:03o}", static_cast<unsigned>(static_cast<unsigned char>(c)));
        else
            result += c;
    }
    return result + quote;
}

std::string picture_extension(const std::string& path)
{
    return std::filesystem::path(path).extension().string();
}

std::string gnuplot_terminal(const std::string& extension, int width, int height)
{
    if (extension == ".svg")
        return fmt::format("set terminal svg size {},{} noenhanced font 'sans,13' background rgb 'white'\n", width,
                           height);
    // The same 13 pixels in points, of which there are 72 an inch.
    if (extension == ".png")
        return fmt::format("set terminal pngcairo size {},{} noenhanced font 'sans,9.75'\n", width, height);
    return fmt::format("set terminal pdfcairo size {:.2f},{:.2f} noenhanced font 'sans,9.36'\n", width / 100.0,
                       height / 100.0);
}

void draw_picture(const std::string& path, const std::function<std::string(const std::string& picture)>& script)
{
    std::string content;
    {
        // gnuplot works in a folder of its own.
        const TemporaryFolder folder(shared_temporary_folder(), "lagen-plot");
        const std::string picture = folder.file("picture" + picture_extension(path)), file = folder.file("script.gp");
        write_file(file, script(picture));
        const ProcessResult result = run_process({"gnuplot", file});
        if (result.interrupted) throw InterruptedError("lagen: interrupted while drawing");
        if (!result.started || result.exit_code != 0)
            throw MachineError(fmt::format("gnuplot failed with exit code {}\n{}", result.exit_code, result.error));
        content = content_of_file(picture);
    }
    write_file(path, content);
}

} // namespace lagen
