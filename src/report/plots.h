// Plots of the report, drawn by gnuplot as SVG with a transparent ground.
//
// A series is a line with points in the colors of Okabe and Ito; a solver keeps its color, dash and point in every
// plot, and no two solvers share all three. Throws std::runtime_error with gnuplot's own words when it fails.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "report/runs.h"

namespace bookspin {

enum class Mark { line_and_points, line, points, cross };

namespace color {
inline constexpr const char* black = "#000000";
inline constexpr const char* orange = "#E69F00";
inline constexpr const char* sky = "#56B4E9";
inline constexpr const char* green = "#009E73";
inline constexpr const char* blue = "#0072B2";
inline constexpr const char* vermillion = "#D55E00";
inline constexpr const char* purple = "#CC79A7";
}  // namespace color

struct Pen {
  const char* color = color::black;
  int dash = 1;   // gnuplot's dashtype
  int point = 7;  // gnuplot's pointtype
  double width = 2.0;
};

[[nodiscard]] Pen pen_of(const Solver& solver);

using Points = std::vector<std::pair<double, double>>;  // those that are not finite are left out of a plot

// (x, y) of those rows that `where` takes; x and y: members of a row, or functions of it.
template <class Rows, class Where, class X, class Y>
[[nodiscard]] Points points(const Rows& rows, Where&& where, X&& x, Y&& y) {
  Points result;
  for (const auto& row : rows) {
    if (where(row)) result.emplace_back(std::invoke(x, row), std::invoke(y, row));
  }
  return result;
}

struct Series {
  std::string title;  // in the key; empty: not in the key
  Points points;
  Pen pen;
  Mark mark = Mark::line_and_points;
};

struct Plot {
  std::string x_label;
  std::string y_label;
  bool log_x = true;
  bool log_y = true;
  std::array<double, 2>
      x_range{};  // none: automatic. With both, each line's name stands at the line, and there is no key
  std::array<double, 2> y_range{};
  std::vector<std::string> more{};  // further gnuplot commands
  std::vector<Series> series{};
};

// Two series of the rows that `where` takes: a line of what is predicted, points of what is measured.
template <class Row, class Where, class X>
void add_predicted_and_measured(Plot& plot, const std::string& title, const Pen& pen, const std::vector<Row>& rows,
                                Where&& where, X&& x) {
  plot.series.push_back({title, points(rows, where, x, &Row::predicted), pen, Mark::line});
  plot.series.push_back({"  measured", points(rows, where, x, &Row::measured), pen, Mark::points});
}

void require_gnuplot();  // throws std::runtime_error that says what to install

[[nodiscard]] std::string svg_of(const std::string& name, const Plot& plot);  // `name` for messages

}  // namespace bookspin
