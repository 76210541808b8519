// Plots of the report, drawn by gnuplot as SVG with a transparent ground.
//
// A series is a line with points in the colours of Okabe and Ito; a method keeps its colour, dash and point in every
// plot, and no two methods share all three. Throws std::runtime_error with gnuplot's own words when it fails, and when the
// file cannot be written.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace bookspin {

enum class Mark { line_and_points, line, points, rings, cross };  // rings: concentric, one size a series

struct Series {
  std::string name;                               // of the method: decides the style
  std::vector<std::pair<double, double>> points;  // those that are not finite are left out
  Mark mark = Mark::line_and_points;
  std::string title;  // in the key; empty: the name; "-": not in the key
};

struct Plot {
  std::string x_label;
  std::string y_label;
  bool log_x = true;
  bool log_y = true;
  std::string x_range = "";  // gnuplot's, such as "[1:1e5]"; empty: automatic
  std::string y_range = "";
  std::vector<std::string> more{};  // further gnuplot commands
  std::vector<Series> series{};
};

void require_gnuplot();  // throws std::runtime_error that says what to install

void draw_plot(const std::filesystem::path& svg, const Plot& plot);

}  // namespace bookspin
