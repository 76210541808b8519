#include "report/plots.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "report/program.h"

namespace bookspin {
namespace {

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

Pen pen_of(const Solver& solver) {
  using namespace color;
  if (solver.method == Method::exact) return {black, 1, 9, 3.0};
  if (solver.as_in_the_paper) return {vermillion, 2, 6, 1.5};
  if (solver.odeint) {
    switch (*solver.odeint) {
      case Odeint::rk4:
        return {blue, 3, 6, 1.5};
      case Odeint::dopri5:
        return {purple, 3, 4, 1.5};
      case Odeint::fehlberg78:
        return {purple, 1, 11, 2.0};
      case Odeint::bulirsch_stoer:
        return {purple, 2, 12, 1.5};
    }
  }
  switch (solver.integrator) {
    case Integrator::explicit_euler:
      return solver.method == Method::quaternion ? Pen{orange, 1, 7, 2.0} : Pen{vermillion, 1, 5, 2.0};
    case Integrator::semi_implicit_euler:
      return {orange, 2, 7, 2.0};
    case Integrator::velocity_verlet:
      return {sky, 1, 5, 2.0};
    case Integrator::rk4:
      return {blue, 1, 7, 2.0};
    case Integrator::composition8:
      return {green, 1, 9, 2.5};
    case Integrator::splitting2:
      return {sky, 2, 4, 2.0};
    case Integrator::splitting4:
      return {sky, 1, 5, 2.0};
    case Integrator::dmv2:
      return {green, 3, 6, 2.0};
    case Integrator::dmv6:
      return {green, 2, 8, 2.0};
    case Integrator::dmv10:
      return {green, 1, 9, 2.5};
  }
  return {};
}

std::string svg_of(const std::string& name, const Plot& plot) {
  std::string script =
      "set term svg size 960,560 dynamic enhanced font 'system-ui,sans-serif,15'\n"
      "set encoding utf8\nset border 3 lw 0.8\nset tics nomirror out scale 0.6\n"
      "set grid lc rgb '#9aa3ad' lw 0.4 dt 1\n"
      "set key outside right top Left reverse noenhanced samplen 3 spacing 1.15\n"
      "set format '10^{%T}'\n";
  script += "set xlabel " + quoted(plot.x_label) + "\nset ylabel " + quoted(plot.y_label) + "\n";
  script += plot.log_x ? "set logscale x\n" : "set format x '%g'\n";
  script += plot.log_y ? "set logscale y\n" : "set format y '%g'\n";
  if (!plot.x_range.empty()) script += "set xrange " + plot.x_range + "\n";
  if (!plot.y_range.empty()) script += "set yrange " + plot.y_range + "\n";
  for (const std::string& command : plot.more) script += command + "\n";
  std::string plots;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const auto& [title, points, pen, mark] = plot.series[i];
    std::string data;
    for (const auto& [x, y] : points) {
      if (std::isfinite(x) && std::isfinite(y)) data += fmt::format("{:.9g} {:.9g}\n", x, y);
    }
    if (data.empty()) continue;
    script += fmt::format("$d{} << EOD\n{}EOD\n", i, data);
    const std::string line = fmt::format("lc rgb '{}' lw {} dt {}", pen.color, pen.width, pen.dash);
    std::string with = fmt::format("linespoints {} pt {} ps 0.55", line, pen.point);
    if (mark == Mark::line) with = "lines " + line;
    if (mark == Mark::points) with = fmt::format("points lc rgb '{}' pt {} ps 0.9", pen.color, pen.point);
    if (mark == Mark::cross) with = fmt::format("points lc rgb '{}' pt 2 ps 0.8 lw 1.5", pen.color);
    plots += fmt::format("{}$d{} using 1:2 with {} {}", plots.empty() ? "plot " : ", \\\n  ", i, with,
                         title.empty() ? "notitle" : "title " + quoted(title));
  }
  Finished gnuplot = run_gnuplot({}, script + plots + "\n");
  if (gnuplot.status != 0 || gnuplot.out.find("</svg>") == std::string::npos)
    throw std::runtime_error(fmt::format("{}: gnuplot (exit status {}): {}", name, gnuplot.status, gnuplot.errors));
  return std::move(gnuplot.out);
}

}  // namespace bookspin
