// SPDX-License-Identifier: BSD-3-Clause
#include "compare/plots.h"

#include "common/number_text.h"
#include "compare/columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mlsmesh::apps {
namespace {

constexpr double kWidth = 480, kHeight = 360;
constexpr double kLeft = 58, kRight = 22, kTop = 34, kBottom = 48;
constexpr double kMarkSize = 5.5;
constexpr double kBarStep = 22, kBarHeight = 14, kBarLabel = 200;

/// Okabe and Ito's colours, told apart with any colour vision; the page has two shades of each (light, dark).
constexpr int kColors = 7;

/// Outlines around (0, 0), to be filled.
constexpr std::array<const char*, 6> kShapes{{
    "M1 0A1 1 0 1 1-1 0A1 1 0 1 1 1 0Z",                            // disc
    "M-.9-.9H.9V.9H-.9Z",                                           // square
    "M0-1.15L1.1.8H-1.1Z",                                          // triangle
    "M0-1.25L1.05 0L0 1.25L-1.05 0Z",                               // diamond
    "M-.35-1.1H.35V-.35H1.1V.35H.35V1.1H-.35V.35H-1.1V-.35H-.35Z",  // plus
    "M0 1.15L1.1-.8H-1.1Z",                                         // triangle, upside down
}};

std::string number(double value) {
  return numberText(std::round(value * 100) / 100, 8);
}

std::string markAt(int series, double x, double y) {
  const int index = series - 1;
  return "<path class=\"c" + std::to_string(index % kColors) + "\" transform=\"translate(" + number(x) + " " +
         number(y) + ") scale(" + number(kMarkSize) + ")\" d=\"" +
         kShapes.at(static_cast<std::size_t>(index) % kShapes.size()) + "\"/>";
}

std::string textAt(double x, double y, const std::string& text, const std::string& attributes = "") {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\"" + (attributes.empty() ? "" : " ") +
         attributes + ">" + escaped(text) + "</text>";
}

std::string lineFrom(double x1, double y1, double x2, double y2, const std::string& name) {
  return "<path class=\"" + name + "\" d=\"M" + number(x1) + " " + number(y1) + "L" + number(x2) + " " +
         number(y2) + "\"/>";
}

std::string openSvg(const std::string& title, double height) {
  return "<svg class=\"plot\" viewBox=\"0 0 " + number(kWidth) + " " + number(height) +
         "\" role=\"img\" aria-label=\"" + escaped(title) + "\">" +
         textAt(kWidth / 2, 18, title, "class=\"title\" text-anchor=\"middle\"");
}

/// A logarithmic axis over `low` .. `high`, which it widens to have room around what is there.
class LogAxis {
 public:
  LogAxis(double low, double high, double begin, double end) : begin_(begin), end_(end) {
    low_ = std::log10(low);
    high_ = std::log10(high);
    const double margin = std::max(0.08 * (high_ - low_), 0.15);
    low_ -= margin;
    high_ += margin;
  }

  double place(double value) const {
    return begin_ + (std::log10(value) - low_) / (high_ - low_) * (end_ - begin_);
  }
  /// Powers of ten, and 2 and 5 times them where there are few.
  std::vector<double> ticks() const {
    std::vector<double> ticks;
    const bool few = high_ - low_ < 2.8;
    for (int power = static_cast<int>(std::floor(low_)); power <= static_cast<int>(std::ceil(high_));
         ++power) {
      for (const int step : {1, 2, 5}) {
        const double value = step * std::pow(10.0, power);
        const double at = std::log10(value);
        if ((step == 1 || few) && at >= low_ && at <= high_) ticks.push_back(value);
      }
    }
    return ticks;
  }

 private:
  double begin_, end_;
  double low_ = 0, high_ = 0;
};

std::string tickText(double value) {
  if (value >= 1e6) return numberText(value / 1e6, 3) + "M";
  if (value >= 1e3) return numberText(value / 1e3, 3) + "k";
  return numberText(value, 3);
}

/// Puts numbers beside marks, where no other mark or number is if there is such a place.
class NumberPlaces {
 public:
  void addMark(double x, double y) { taken_.push_back({x, y, kMarkSize, kMarkSize}); }

  std::string put(const std::string& text, double x, double y) {
    const double half = 3.6 * static_cast<double>(text.size());
    const double away = kMarkSize + 2 + half;
    const std::array<Box, 8> places{{{x + away, y, half, 6},
                                     {x - away, y, half, 6},
                                     {x, y - 13, half, 6},
                                     {x, y + 13, half, 6},
                                     {x + away, y - 11, half, 6},
                                     {x + away, y + 11, half, 6},
                                     {x - away, y - 11, half, 6},
                                     {x - away, y + 11, half, 6}}};
    const auto* free =
        std::find_if(places.begin(), places.end(), [&](const Box& box) { return isFree(box); });
    const Box& box = free == places.end() ? places.front() : *free;
    taken_.push_back(box);
    return textAt(box.x, box.y + 4, text, "class=\"number\" text-anchor=\"middle\"");
  }

 private:
  struct Box {
    double x, y, half_width, half_height;
  };
  bool isFree(const Box& box) const {
    return std::none_of(taken_.begin(), taken_.end(), [&](const Box& other) {
      return std::abs(box.x - other.x) < box.half_width + other.half_width &&
             std::abs(box.y - other.y) < box.half_height + other.half_height;
    });
  }
  std::vector<Box> taken_;
};

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = 0;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

std::string axes(const LogAxis& x, const LogAxis& y, const std::string& x_label, const std::string& y_label,
                 double y_floor) {
  const double right = kWidth - kRight, bottom = kHeight - kBottom;
  std::string svg;
  for (const double tick : x.ticks()) {
    svg += lineFrom(x.place(tick), kTop, x.place(tick), bottom, "grid");
    svg += textAt(x.place(tick), bottom + 17, tickText(tick), "text-anchor=\"middle\"");
  }
  for (const double tick : y.ticks()) {
    svg += lineFrom(kLeft, y.place(tick), right, y.place(tick), "grid");
    svg += textAt(kLeft - 6, y.place(tick) + 4, (tick <= y_floor ? "≤ " : "") + tickText(tick),
                  "text-anchor=\"end\"");
  }
  svg += lineFrom(kLeft, bottom, right, bottom, "axis") + lineFrom(kLeft, kTop, kLeft, bottom, "axis");
  svg += textAt((kLeft + right) / 2, kHeight - 10, x_label, "text-anchor=\"middle\"");
  svg += "<text transform=\"translate(14 " + number((kTop + bottom) / 2) +
         ") rotate(-90)\" text-anchor=\"middle\">" + escaped(y_label) + "</text>";
  return svg;
}

std::string polyline(const Series& series, const LogAxis& x, const LogAxis& y, double y_floor) {
  if (series.points.size() < 2) return {};
  std::string path;
  for (const Series::Point& point : series.points)
    path += (path.empty() ? "M" : "L") + number(x.place(point.x)) + " " +
            number(y.place(std::max(point.y, y_floor)));
  return "<path class=\"line l" + std::to_string((series.number - 1) % kColors) + "\" d=\"" + path + "\"/>";
}

/// A step of 1, 2 or 5 times a power of ten that divides the range into a few parts.
double tickStep(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range)));
  for (const double step : {0.2, 0.5, 1.0, 2.0})
    if (range / (step * power) <= 5) return step * power;
  return 5 * power;
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string markIcon(int number) {
  return "<svg class=\"icon\" viewBox=\"-8 -8 16 16\" aria-hidden=\"true\">" + markAt(number, 0, 0) +
         "</svg>";
}

std::string scatterPlot(const std::string& title, const std::string& x_label, const std::string& y_label,
                        double y_floor, const std::vector<Series>& series) {
  Extent x_extent, y_extent;
  for (const Series& one : series) {
    for (const Series::Point& point : one.points) {
      x_extent.add(point.x);
      y_extent.add(std::max(point.y, y_floor));
    }
  }
  if (x_extent.high == 0) return {};
  const LogAxis x(x_extent.low, x_extent.high, kLeft, kWidth - kRight);
  const LogAxis y(y_extent.low, y_extent.high, kHeight - kBottom, kTop);
  std::string svg = openSvg(title, kHeight) + axes(x, y, x_label, y_label, y_floor);
  std::string marks, numbers;
  NumberPlaces places;
  for (const Series& one : series) {
    svg += polyline(one, x, y, y_floor);
    for (const Series::Point& point : one.points) {
      const double at_x = x.place(point.x), at_y = y.place(std::max(point.y, y_floor));
      marks += markAt(one.number, at_x, at_y);
      places.addMark(at_x, at_y);
    }
  }
  for (const Series& one : series) {
    if (one.points.empty()) continue;
    const Series::Point& last = one.points.back();
    numbers += places.put(std::to_string(one.number), x.place(last.x), y.place(std::max(last.y, y_floor)));
  }
  return svg + marks + numbers + "</svg>";
}

std::string barPlot(const std::string& title, const std::string& first_name, const std::string& second_name,
                    const std::string& unit, const std::vector<Bar>& bars) {
  double most = 0;
  for (const Bar& bar : bars) most = std::max(most, bar.first + bar.second);
  if (most <= 0) return {};
  const double right = kWidth - 54, top = 52;
  const double bottom = top + kBarStep * static_cast<double>(bars.size());
  const double scale = (right - kBarLabel) / most;
  const auto rectangle = [](double x, double y, double width, double height, const char* name) {
    return "<rect class=\"" + std::string(name) + "\" x=\"" + number(x) + "\" y=\"" + number(y) +
           "\" width=\"" + number(std::max(width, 0.0)) + "\" height=\"" + number(height) + "\"/>";
  };
  std::string svg = openSvg(title, bottom + 34);
  svg += rectangle(kBarLabel, 28, 12, 12, "first") + textAt(kBarLabel + 17, 38, first_name);
  svg += rectangle(kBarLabel + 120, 28, 12, 12, "second") + textAt(kBarLabel + 137, 38, second_name);
  const double step = tickStep(most);
  for (double tick = 0; tick <= most * 1.0001; tick += step) {
    svg += lineFrom(kBarLabel + tick * scale, top, kBarLabel + tick * scale, bottom, "grid");
    svg += textAt(kBarLabel + tick * scale, bottom + 16, readableText(tick), "text-anchor=\"middle\"");
  }
  svg += textAt(kBarLabel - 8, bottom + 16, unit, "text-anchor=\"end\"");
  double y = top + (kBarStep - kBarHeight) / 2;
  for (const Bar& bar : bars) {
    svg += textAt(kBarLabel - 8, y + 11, std::to_string(bar.number) + " " + bar.label, "text-anchor=\"end\"");
    svg += rectangle(kBarLabel, y, bar.first * scale, kBarHeight, "first");
    svg += rectangle(kBarLabel + bar.first * scale, y, bar.second * scale, kBarHeight, "second");
    svg += textAt(kBarLabel + (bar.first + bar.second) * scale + 5, y + 11,
                  readableText(bar.first + bar.second));
    y += kBarStep;
  }
  return svg + "</svg>";
}

}  // namespace mlsmesh::apps
