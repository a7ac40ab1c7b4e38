// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace mlsmesh::apps {

// Plots as SVG elements, with the classes and variables of the page's style. A series is told from others by
// the shape and the number of its marks as well as by its colour.

/// A method in a plot.
struct Series {
  int number = 0;  ///< from 1; decides shape and colour
  struct Point {
    double x = 0;
    double y = 0;
  };
  std::vector<Point> points;  ///< of positive numbers; joined by lines in that order
};

/// Both axes logarithmic. Values below `y_floor` are drawn there. Empty if there is no point.
std::string scatterPlot(const std::string& title, const std::string& x_label, const std::string& y_label,
                        double y_floor, const std::vector<Series>& series);

/// A horizontal bar in two parts.
struct Bar {
  int number = 0;
  std::string label;
  double first = 0;
  double second = 0;
};

/// Bars on a linear axis from 0. Empty if there is none.
std::string barPlot(const std::string& title, const std::string& first_name, const std::string& second_name,
                    const std::string& unit, const std::vector<Bar>& bars);

/// The mark of a series, as an element of its own for legends.
std::string markIcon(int number);

/// `text` with what HTML would take for markup replaced.
std::string escaped(const std::string& text);

}  // namespace mlsmesh::apps
