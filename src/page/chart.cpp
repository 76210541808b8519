#include "page/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace bookspin {
namespace {

using Json = nlohmann::json;

constexpr int most_buckets = 180;  // of time in a curve, each with at most two points
constexpr double log_from = 30.0;  // growth from which the axis is logarithmic
constexpr int colors = 5;
constexpr double most_shown = 1e100;  // so that an axis of the largest numbers does not overflow

struct Curve {
  std::string label;
  int color = 0;
  std::vector<double> values;  // shown, one a drawn frame; NaN: none
};

struct Axis {
  double low = 0.0;
  double high = 1.0;
  bool log = false;
  double step = 1.0;  // between ticks; decades when log

  // 0 at low, 1 at high.
  [[nodiscard]] double place(double value) const {
    return log ? std::log10(value / low) / std::log10(high / low) : (value - low) / (high - low);
  }
};

std::vector<std::string> split(std::string_view text, char at) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t end = text.find(at);
    std::string_view part = text.substr(0, end);
    while (part.starts_with(' ')) part.remove_prefix(1);
    while (part.ends_with(' ')) part.remove_suffix(1);
    if (!part.empty()) parts.emplace_back(part);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  }
  return parts;
}

const FilmRecord::Quantity& quantity_of(const FilmRecord& film, const std::string& name) {
  for (const FilmRecord::Quantity& q : film.quantities) {
    if (q.name == name) return q;
  }
  throw std::invalid_argument(fmt::format("chart: found quantity '{}', which the film does not have", name));
}

Curve curve_of(const FilmRecord& film, const FilmRecord::Book& book, const FilmRecord::Quantity& q) {
  const int first = film.first_frame;
  const int end = std::min(book.exploded_frame.value_or(film.frames), first + film.drawn_frames);
  Curve curve;
  curve.values.assign(static_cast<std::size_t>(film.drawn_frames), std::nan(""));
  const auto values = book.data.find(q.name);
  if (values == book.data.end()) return curve;
  for (int n = first; n < end; ++n) {
    const double value = values->second[static_cast<std::size_t>(n)] * q.scale;
    curve.values[static_cast<std::size_t>(n - first)] =
        std::isnan(value) ? value : std::clamp(value, -most_shown, most_shown);
  }
  return curve;
}

// 1, 2 or 5 times a power of ten, so that at most `most` steps cover the span.
double round_step(double span, int most) {
  const double power = std::pow(10.0, std::floor(std::log10(span / most)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (span / (factor * power) <= most + 1e-9) return factor * power;
  }
  return 10.0 * power;
}

Axis axis_for(const std::vector<Curve>& curves, double low, double high, double most) {
  double least_positive = HUGE_VAL;
  for (const Curve& curve : curves) {
    for (const double value : curve.values) {
      if (std::isnan(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
      if (value > 0.0) least_positive = std::min(least_positive, value);
    }
  }
  Axis axis;
  if (!(high > low)) high = low + 1.0;
  axis.log = low > 0.0 && high > log_from && high / low > log_from;
  if (axis.log) {
    const double first = std::floor(std::log10(least_positive) + 0.05);  // a dip of a tenth is not worth a decade
    const double last = std::ceil(std::log10(high) - 1e-9);
    axis.step = std::max(1.0, std::ceil((last - first) / 4.0));
    axis.low = std::pow(10.0, first);
    axis.high = std::pow(10.0, last);
  } else {
    const bool whole = most > 0.0 && high > most / 2.0;
    axis.step = whole ? most / 2.0 : round_step(high - low, 4);
    axis.low = axis.step * std::floor(low / axis.step + 1e-9);
    axis.high = whole ? most : axis.step * std::ceil(high / axis.step - 1e-9);
  }
  return axis;
}

// One decimal of a thousandth of the plot, without a useless ".0".
std::string coordinate(double value) {
  std::string text = fmt::format("{:.1f}", value);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

std::string path_of(const Curve& curve, const Axis& axis) {
  const auto count = static_cast<int>(curve.values.size());
  const int buckets = std::min(count, most_buckets);
  std::string path;
  bool open = false;
  const auto point = [&](int n) {
    const double y = 1000.0 * (1.0 - std::clamp(axis.place(curve.values[static_cast<std::size_t>(n)]), 0.0, 1.0));
    path += open ? ' ' : 'M';
    path += coordinate(1000.0 * n / count) + ',' + coordinate(y);
    open = true;
  };
  for (int b = 0; b < buckets; ++b) {
    int smallest = -1;
    int largest = -1;
    for (int n = b * count / buckets; n < (b + 1) * count / buckets; ++n) {
      const double value = curve.values[static_cast<std::size_t>(n)];
      if (std::isnan(value)) continue;
      if (smallest < 0 || value < curve.values[static_cast<std::size_t>(smallest)]) smallest = n;
      if (largest < 0 || value > curve.values[static_cast<std::size_t>(largest)]) largest = n;
    }
    if (smallest < 0) {
      open = false;
      continue;
    }
    point(std::min(smallest, largest));
    if (smallest != largest) point(std::max(smallest, largest));
  }
  return path;
}

std::string tick_label(double value, const Axis& axis) {
  const bool zero = !axis.log && std::abs(value) < axis.step * 1e-6;
  const double size = std::abs(value);
  return zero                         ? "0"
         : size >= 1e6 || size < 1e-4 ? fmt::format("{:.0e}", value)
                                      : fmt::format("{:.6g}", std::round(value * 1e4) / 1e4);
}

Json ticks_of(const Axis& axis) {
  Json ticks = Json::array();
  const double span = axis.log ? std::log10(axis.high / axis.low) : axis.high - axis.low;
  for (int i = 0; i * axis.step <= span * (1.0 + 1e-9); ++i) {
    const double value = axis.log ? axis.low * std::pow(10.0, i * axis.step) : axis.low + i * axis.step;
    ticks.push_back({{"at", coordinate(100.0 * axis.place(value))}, {"label", tick_label(value, axis)}});
  }
  return ticks;
}

Json panel_of(const FilmRecord& film, const std::string& names) {
  std::vector<Curve> curves;
  const std::vector<std::string> quantities = split(names, '+');
  const bool many_books = film.books.size() > 1;
  Json panel{{"title", ""}, {"unit", ""}};
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  double most = 0.0;
  std::string title;
  for (const std::string& name : quantities) {
    const FilmRecord::Quantity& q = quantity_of(film, name);
    low = std::min(low, q.low);
    high = std::max(high, q.high);
    title += (title.empty() ? "" : ", ") + q.title;
    panel["unit"] = q.unit;
    most = q.most;
    int index = many_books ? 0 : static_cast<int>(curves.size());
    for (const FilmRecord::Book& book : film.books) {
      Curve curve = curve_of(film, book, q);
      curve.color = index++ % colors;
      curve.label = many_books ? book.name : q.title;
      if (many_books && quantities.size() > 1) curve.label += ", " + q.title;
      // The exact book's own error is no news.
      const bool dull = name == "angle_error" && book.method == "exact";
      const bool empty = std::all_of(curve.values.begin(), curve.values.end(), [](double v) { return std::isnan(v); });
      if (!dull && !empty) curves.push_back(std::move(curve));
    }
  }
  const Axis axis = axis_for(curves, low, high, most);
  panel["title"] = title;
  panel["low"] = axis.low;
  panel["high"] = axis.high;
  panel["log"] = axis.log;
  panel["ticks"] = ticks_of(axis);
  panel["tick_unit"] = panel["unit"] == "%" ? " %" : panel["unit"] == "°" ? "°" : "";
  panel["many"] = curves.size() > 1;
  panel["heading"] = many_books ? title : "";
  panel["curves"] = Json::array();
  for (const Curve& curve : curves) {
    panel["curves"].push_back({{"label", curve.label}, {"color", curve.color}, {"path", path_of(curve, axis)}});
  }
  return panel;
}

}  // namespace

Json chart_of(const FilmRecord& film, std::string_view panels) {
  if (panels.empty())
    panels = film.books.size() > 1 ? "tilt, energy_ratio" : "tilt, energy_ratio+angular_momentum_ratio, stretch";
  const double from = film.first_frame * film.time_per_frame;
  const double span = film.drawn_frames * film.time_per_frame;
  Json chart{{"seconds", film.seconds()}, {"from", from},           {"span", span},
             {"panels", Json::array()},   {"times", Json::array()}, {"marks", Json::array()}};
  for (const std::string& names : split(panels, ',')) chart["panels"].push_back(panel_of(film, names));
  const double step = round_step(span, 9);
  for (double n = std::ceil(from / step - 1e-9); n * step <= from + span * (1.0 + 1e-9); ++n) {
    chart["times"].push_back(
        {{"at", coordinate(100.0 * (n * step - from) / span)}, {"label", fmt::format("{:.6g}", n * step + 0.0)}});
  }
  for (const FilmRecord::Book& book : film.books) {
    if (!book.exploded_frame) continue;
    const double share = static_cast<double>(*book.exploded_frame - film.first_frame) / film.drawn_frames;
    if (share < 0.0 || share >= 1.0) continue;
    chart["marks"].push_back({{"at", coordinate(100.0 * share)},
                              {"late", share > 0.8},
                              {"label", film.books.size() > 1 ? book.name + " explodes" : "explodes"}});
  }
  return chart;
}

}  // namespace bookspin
