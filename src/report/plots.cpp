#include "report/plots.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "files/files.h"
#include "report/program.h"

namespace bookspin {
namespace {

struct Look {
  const char* name;
  const char* color;
  int dash;   // gnuplot's dashtype
  int point;  // gnuplot's pointtype
  double width;
};

constexpr const char* black = "#000000";
constexpr const char* orange = "#E69F00";
constexpr const char* sky = "#56B4E9";
constexpr const char* green = "#009E73";
constexpr const char* blue = "#0072B2";
constexpr const char* vermillion = "#D55E00";
constexpr const char* purple = "#CC79A7";

constexpr std::array looks{
    Look{"exact", black, 1, 9, 3.0},
    Look{"theory", black, 1, 9, 2.0},
    Look{"Euler, matrix", vermillion, 1, 5, 2.0},
    Look{"Euler, quaternion", orange, 1, 7, 2.0},
    Look{"rk4", blue, 1, 7, 2.0},
    Look{"splitting2", sky, 2, 4, 2.0},
    Look{"splitting4", sky, 1, 5, 2.0},
    Look{"dmv2", green, 3, 6, 2.0},
    Look{"dmv6", green, 2, 8, 2.0},
    Look{"dmv10", green, 1, 9, 2.5},
    Look{"odeint rk4", blue, 3, 6, 1.5},
    Look{"odeint dopri5", purple, 3, 4, 1.5},
    Look{"odeint fehlberg78", purple, 1, 11, 2.0},
    Look{"odeint bulirsch_stoer", purple, 2, 12, 1.5},
    Look{"explicit Euler", vermillion, 1, 5, 2.0},
    Look{"semi-implicit Euler", orange, 2, 7, 2.0},
    Look{"velocity Verlet", sky, 1, 5, 2.0},
    Look{"composition8", green, 1, 9, 2.5},
    Look{"springs", vermillion, 2, 6, 1.5},
};

Look look_of(const std::string& name) {
  const Look* best = nullptr;
  for (const Look& look : looks) {
    const std::string_view prefix = look.name;
    if (name.starts_with(prefix) && (best == nullptr || prefix.size() > std::string_view(best->name).size()))
      best = &look;
  }
  return best == nullptr ? Look{"", black, 2, 1, 1.5} : *best;
}

std::string quoted(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return '"' + out + '"';
}

Finished run_gnuplot(const std::vector<std::string>& arguments, std::string_view script) {
  Finished gnuplot = run_program("gnuplot", arguments, script);
  if (gnuplot.status == program_not_found)
    throw std::runtime_error("gnuplot: not found; the package gnuplot-nox has it, and the report's plots need it");
  return gnuplot;
}

}  // namespace

void require_gnuplot() {
  const Finished gnuplot = run_gnuplot({"--version"}, "");
  if (gnuplot.status != 0)
    throw std::runtime_error(fmt::format("gnuplot --version: exit status {}: {}", gnuplot.status, gnuplot.errors));
}

void draw_plot(const std::filesystem::path& svg, const Plot& plot) {
  std::string script =
      "set term svg size 960,560 dynamic enhanced font 'system-ui,sans-serif,15'\n"
      "set encoding utf8\nset border 3 lw 0.8\nset tics nomirror out scale 0.6\n"
      "set grid lc rgb '#9aa3ad' lw 0.4 dt 1\nset key outside right top Left reverse noenhanced samplen 3 spacing "
      "1.15\n"
      "set format '10^{%T}'\n";
  script += "set xlabel " + quoted(plot.x_label) + "\nset ylabel " + quoted(plot.y_label) + "\n";
  script += plot.log_x ? "set logscale x\n" : "set format x '%g'\n";
  script += plot.log_y ? "set logscale y\n" : "set format y '%g'\n";
  if (!plot.x_range.empty()) script += "set xrange " + plot.x_range + "\n";
  if (!plot.y_range.empty()) script += "set yrange " + plot.y_range + "\n";
  for (const std::string& command : plot.more) script += command + "\n";
  std::string plots;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    std::string data;
    for (const auto& [x, y] : series.points) {
      if (std::isfinite(x) && std::isfinite(y)) data += fmt::format("{:.9g} {:.9g}\n", x, y);
    }
    if (data.empty()) continue;
    script += fmt::format("$d{} << EOD\n{}EOD\n", i, data);
    const Look look = look_of(series.name);
    const std::string title =
        series.title == "-" ? "notitle" : "title " + quoted(series.title.empty() ? series.name : series.title);
    const std::string line = fmt::format("lc rgb '{}' lw {} dt {}", look.color, look.width, look.dash);
    const std::string point = fmt::format("pt {} ps 0.55", look.point);
    std::string style = fmt::format("with linespoints {} {}", line, point);
    if (series.mark == Mark::line) style = "with lines " + line;
    if (series.mark == Mark::points)
      style = fmt::format("with points lc rgb '{}' pt {} ps 0.9", look.color, look.point);
    if (series.mark == Mark::rings)
      style = fmt::format("with points lc rgb '{}' pt 6 ps {} lw 1.6", look.color, 0.2 * static_cast<double>(i + 1));
    if (series.mark == Mark::cross) style = fmt::format("with points lc rgb '{}' pt 2 ps 0.8 lw 1.5", look.color);
    plots += fmt::format("{}$d{} using 1:2 {} {}", plots.empty() ? "plot " : ", \\\n  ", i, style, title);
  }
  script += plots + "\n";

  const Finished gnuplot = run_gnuplot({}, script);
  if (gnuplot.status != 0 || gnuplot.out.find("</svg>") == std::string::npos) {
    throw std::runtime_error(
        fmt::format("{}: gnuplot (exit status {}): {}", svg.string(), gnuplot.status, gnuplot.errors));
  }
  write_file(svg, gnuplot.out);
}

}  // namespace bookspin
