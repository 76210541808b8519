#include "report/plots.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "scene/any_book.h"

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

std::string rest_of(std::FILE* file) {
  std::string text;
  char part[4096];
  for (std::size_t n = 0; (n = std::fread(part, 1, sizeof part, file)) > 0;) text.append(part, n);
  return text;
}

// What gnuplot draws of the script. Script and errors go by nameless files: neither side ever waits for the other.
std::string drawn_by_gnuplot(const std::string& name, const std::string& script) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::tmpfile(), std::fclose),
      errors(std::tmpfile(), std::fclose);
  if (!in || !errors || std::fwrite(script.data(), 1, script.size(), in.get()) != script.size() ||
      std::fflush(in.get()) != 0)
    throw std::runtime_error(name + ": a temporary file for gnuplot cannot be written");
  std::rewind(in.get());
  std::FILE* pipe =
      popen(fmt::format("gnuplot /dev/fd/{} 2>/dev/fd/{}", fileno(in.get()), fileno(errors.get())).c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error(name + ": a shell for gnuplot cannot be started");
  std::string drawn = rest_of(pipe);
  const int status = pclose(pipe);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
    throw std::runtime_error("gnuplot: not found; the package gnuplot-nox has it, and the report's plots need it");
  if (status != 0 || (!script.empty() && drawn.find("</svg>") == std::string::npos)) {
    std::rewind(errors.get());
    throw std::runtime_error(fmt::format("{}: gnuplot (status {}): {}", name, status, rest_of(errors.get())));
  }
  return drawn;
}

bool is_given(const std::array<double, 2>& range) {
  return range[0] < range[1];
}

// A label for each line, beside that one of its points which leaves most room to all other points and labels.
std::string names_at_lines(const Plot& plot) {
  struct Box {
    Eigen::Array2d middle, half;  // pixels
  };
  const auto along = [](double value, const std::array<double, 2>& range, bool log) {
    return log ? std::log(value / range[0]) / std::log(range[1] / range[0])
               : (value - range[0]) / (range[1] - range[0]);
  };
  const auto place = [&](const std::pair<double, double>& p) {
    return Eigen::Array2d(850.0 * along(p.first, plot.x_range, plot.log_x),
                          470.0 * along(p.second, plot.y_range, plot.log_y));
  };
  std::vector<Box> taken;
  for (const Series& series : plot.series) {
    for (const auto& point : series.points) taken.push_back({place(point), {5.0, 5.0}});
  }
  std::string labels;
  for (const Series& series : plot.series) {
    if (series.title.empty() || series.points.empty()) continue;
    const Eigen::Array2d half(3.8 * static_cast<double>(series.title.size()), 8.0);
    Box best{};
    std::string label;
    double most = -none;
    for (const auto& point : series.points) {
      for (const auto& [side, rise] : {std::pair{1, 1}, {-1, 1}, {1, -1}, {-1, -1}}) {
        const Box name{place(point) + Eigen::Array2d(side * (half.x() + 9.0), rise * 10.0), half};
        const bool inside = (name.middle - half).minCoeff() > 8.0 && name.middle.x() + half.x() < 850.0;
        double room = inside ? none : -1e3;
        for (const Box& other : taken) {
          const bool own = (other.middle - place(point)).abs().maxCoeff() < 1.0;
          const Eigen::Array2d gap = (other.middle - name.middle).abs() - other.half - half;
          if (!own) room = std::min(room, gap.maxCoeff() < 0.0 ? gap.maxCoeff() : gap.max(0.0).matrix().norm());
        }
        if (room <= most) continue;
        most = room;
        best = name;
        label = fmt::format("at {}, {} {} offset character {}, {}", point.first, point.second,
                            side > 0 ? "left" : "right", 0.9 * side, rise > 0 ? 0.6 : -0.6);
      }
    }
    if (most < -3.0) continue;  // no room: its color says what it is
    taken.push_back(best);
    labels += fmt::format("set label {} {} noenhanced font ',13' tc rgb '{}'\n", quoted(series.title), label,
                          series.pen.color);
  }
  return labels;
}

}  // namespace

void require_gnuplot() {
  (void)drawn_by_gnuplot("nothing to plot", "");
}

// A color for each order, in it a point for each row of the table; Odeint's and the paper's are thinner and dashed.
Pen pen_of(const Solver& solver) {
  using namespace color;
  if (solver.method == Method::exact) return {black, 1, 9, 3.0};
  if (solver.as_in_the_paper) return {vermillion, 2, 6, 1.5};
  if (solver.odeint) {
    constexpr std::array<Pen, 4> pens{
        {{blue, 3, 6, 1.5}, {purple, 3, 4, 1.5}, {purple, 1, 11, 2.0}, {purple, 2, 12, 1.5}}};
    return pens.at(static_cast<std::size_t>(*solver.odeint));
  }
  const auto color_of = [](const IntegratorInfo& row) {
    return row.order < 2 ? vermillion : row.order < 4 ? sky : row.order < 6 ? blue : green;
  };
  Pen pen{color_of(info_of(solver.integrator)), solver.method == Method::matrix ? 2 : 1, 4};
  for (const IntegratorInfo& row : integrators)
    pen.point += row.id < solver.integrator && color_of(row) == pen.color ? 1 : 0;
  return pen;
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
  for (const auto& [axis, range] : {std::pair{'x', plot.x_range}, std::pair{'y', plot.y_range}}) {
    if (is_given(range)) script += fmt::format("set {}range [{}:{}]\n", axis, range[0], range[1]);
  }
  if (is_given(plot.x_range) && is_given(plot.y_range)) script += "set key off\n" + names_at_lines(plot);
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
  return drawn_by_gnuplot(name, script + plots + "\n");
}

}  // namespace bookspin
